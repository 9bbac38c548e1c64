"""The cards of the home page: designs with pictures and findings, files that cannot be read, hand-written parts."""

from nicegui import ui

from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.design_menu import add_design_menu
from vicode.editor.panels.thumbnails import thumbnail_address
from vicode.editor.session import Workspace
from vicode.editor.session.overview import BrokenFile, DesignCard, HandWrittenComponent
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import broken_file_url, design_url
from vicode.findings import Severity

_ICONS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "info"}


def design_card(workspace: Workspace, card: DesignCard, dialogs: DesignDialogs) -> None:
    """A design: the picture and the name lead to it."""
    address = design_url(workspace.key, card.component)
    with ui.element("article").classes("design-card") as whole:
        whole.props["aria-label"] = card.component
        with ui.link(target=address).classes("card-picture").props('tabindex="-1" aria-hidden="true"'):
            for theme in ("light", "dark"):
                picture = ui.element("img").classes(f"is-{theme}").props('alt="" loading="lazy"')
                picture.props["src"] = thumbnail_address(workspace, card.component, dark=theme == "dark")
        with ui.element("div").classes("card-text"):
            with ui.element("div").classes("card-line").props('role="heading" aria-level="2"'):
                ui.link(card.component, address).classes("card-name")
            ui.label(card.doc or "No doc yet").classes("card-doc")
            with ui.row().classes("card-facts"):
                _facts(card)
        add_design_menu(workspace, card.component, dialogs, whole)


def _facts(card: DesignCard) -> None:
    if card.is_unsaved:
        ui.label("● Unsaved").classes("fact unsaved")
    for severity, count in card.counts.items():
        with ui.row().classes(f"fact {severity}"):
            ui.icon(_ICONS[severity]).props('aria-hidden="true"')
            ui.label(f"{count} {severity}{'s' * (count != 1)}")
    if not card.counts:
        with ui.row().classes("fact sound"):
            ui.icon("check").props('aria-hidden="true"')
            ui.label("Sound")
    ui.label(f"{card.states} state{'s' * (card.states != 1)}").classes("fact")
    if card.is_root:
        ui.label("Starts here").classes("fact root")


def broken_card(workspace: Workspace, broken: BrokenFile) -> None:
    """A file that holds no design that can be read, with what is wrong first."""
    with ui.element("article").classes("design-card is-broken") as whole:
        whole.props["aria-label"] = broken.file
        with ui.element("div").classes("card-picture"):
            ui.icon("broken_image").props('aria-hidden="true"')
        with ui.element("div").classes("card-text"):
            with ui.element("div").classes("card-line").props('role="heading" aria-level="2"'):
                ui.label(broken.file).classes("card-name")
            line = f"Line {broken.line}: " if broken.line else ""
            ui.label(line + broken.reason).classes("card-doc")
            with ui.row().classes("card-facts"), ui.row().classes("fact error"):
                ui.icon("error").props('aria-hidden="true"')
                ui.label("Cannot be read")
            ui.link("Mend its text", broken_file_url(workspace.key, broken.file))


def hand_written_row(workspace: Workspace, row: HandWrittenComponent) -> None:
    """A component without a design, with the designs that use it."""
    with ui.element("li").classes("component-row"):
        ui.label(row.component).classes("component-name")
        ui.label(row.implementation).classes("mono small")
        ui.label(" ".join(row.doc.split())).classes("component-doc")
        with ui.row().classes("component-users"):
            ui.label("used by" if row.used_by else "not used").classes("small")
            for user in row.used_by:
                design = workspace.project.design(user)
                uses = design.uses if design else ()
                alias = next((use.alias for use in uses if use.component == row.component), "")
                ui.link(user, design_url(workspace.key, user, ItemRef(kind="components", id=alias)))
