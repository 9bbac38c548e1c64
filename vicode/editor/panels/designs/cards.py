"""Cards and rows of the home page: designs, unreadable files, hand-written components."""

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.designs.design_menu import add_design_menu
from vicode.editor.panels.designs.thumbnails import thumbnail_address
from vicode.editor.session import Workspace
from vicode.editor.session.project.overview import BrokenFile, DesignCard, HandWrittenComponent
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import broken_file_url, design_url
from vicode.findings import Severity

_ICONS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "info"}


def design_card(workspace: Workspace, card: DesignCard, dialogs: DesignDialogs) -> None:
    """Build the card of a design. Picture and name link to it."""
    address = design_url(workspace.key, card.component)
    with ui.element("article").classes("design-card") as article:
        article.props["aria-label"] = card.component
        with ui.link(target=address).classes("card-picture").props('tabindex="-1" aria-hidden="true"'):
            for theme in ("light", "dark"):
                picture = ui.element("img").classes(f"is-{theme}").props('alt="" loading="lazy"')
                picture.props["src"] = thumbnail_address(workspace, card.component, dark=theme == "dark")
        with ui.element("div").classes("card-text"):
            with ui.element("div").classes("card-line").props('role="heading" aria-level="2"'):
                ui.link(card.component, address).classes("card-name")
            ui.label(card.doc or "No description").classes("card-doc")
            with ui.row().classes("card-facts"):
                _facts(card)
        add_design_menu(workspace, card.component, dialogs, article)


def _facts(card: DesignCard) -> None:
    if card.is_unsaved:
        ui.label("● Unsaved").classes("fact unsaved")
    for severity, count in card.counts.items():
        with ui.row().classes(f"fact {severity}"):
            ui.icon(_ICONS[severity]).props('aria-hidden="true"')
            ui.label(texts.pluralize(count, severity))
    if not card.counts:
        with ui.row().classes("fact sound"):
            ui.icon("check").props('aria-hidden="true"')
            ui.label(texts.NO_PROBLEMS)
    ui.label(texts.pluralize(card.states, "state")).classes("fact")
    if card.is_root:
        ui.label("Root of an agent").classes("fact root")


def broken_card(workspace: Workspace, file: BrokenFile) -> None:
    """Build the card of an unreadable file, with its first error."""
    with ui.element("article").classes("design-card is-broken") as article:
        article.props["aria-label"] = file.file
        with ui.element("div").classes("card-picture"):
            ui.icon("broken_image").props('aria-hidden="true"')
        with ui.element("div").classes("card-text"):
            with ui.element("div").classes("card-line").props('role="heading" aria-level="2"'):
                ui.label(file.file).classes("card-name")
            line = f"Line {file.line}: " if file.line else ""
            ui.label(line + file.reason).classes("card-doc")
            with ui.row().classes("card-facts"), ui.row().classes("fact error"):
                ui.icon("error").props('aria-hidden="true"')
                ui.label("Cannot be read")
            ui.link("Fix the file", broken_file_url(workspace.key, file.file))


def hand_written_row(workspace: Workspace, row: HandWrittenComponent) -> None:
    """Build the row of a component without a design, with links to the designs that use it."""
    with ui.element("li").classes("component-row"):
        ui.label(row.component).classes("component-name")
        ui.label(row.implementation or "Not implemented yet").classes("mono small")
        ui.label(" ".join(row.doc.split())).classes("component-doc")
        with ui.row().classes("component-users"):
            ui.label("used by" if row.used_by else "not used").classes("small")
            for user in row.used_by:
                design = workspace.project.design(user)
                uses = design.uses if design else ()
                alias = next((use.alias for use in uses if use.component == row.component), "")
                ui.link(user, design_url(workspace.key, user, ItemRef(kind="components", id=alias)))
