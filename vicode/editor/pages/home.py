"""The home page of a folder: designs as cards, unreadable files, dependencies, hand-written components."""

import contextlib
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from nicegui import ui

from vicode.diagram.dependency_graph import dependency_diagram
from vicode.diagram.palettes import css_variable_palette
from vicode.diagram.render import render_diagram
from vicode.diagram.svg import write_svg
from vicode.editor.pages.delivery import open_inbox
from vicode.editor.pages.shortcuts import register_shortcuts
from vicode.editor.pages.theme import Theme, apply_theme
from vicode.editor.panels.code.code_editor import CodeEditorFactory
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.commands.command_palette import CommandPalette
from vicode.editor.panels.designs.cards import broken_card, design_card, hand_written_row
from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.designs.folders import MANY_DESIGNS, Folder, group_by_folder
from vicode.editor.panels.toasts import show_toast
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.panels.widgets import icon_button, primary_button
from vicode.editor.session import Library, Workspace
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.project.overview import BrokenFile, DesignCard, ProjectOverview
from vicode.editor.session.search.search_index import SearchIndex, SearchTarget
from vicode.editor.view.page_urls import design_url

_SHEET = Path(__file__).parent / "home.css"


class HomePage:
    """One window on a folder, rebuilt when its content has changed."""

    def __init__(self, library: Library, index: SearchIndex, removed: str = "") -> None:
        """Build the page; `removed`, PROJECT/COMPONENT, is the deleted design that the window showed before."""
        self.library = library
        self.rendered_key: object = None
        self.search_text = ""
        self.folders_open: dict[tuple[str, str], bool] = {}
        theme = Theme(CodeEditorFactory(), apply_theme())
        ui.add_css(_SHEET.read_text(encoding="utf-8"))
        palette = CommandPalette(index, _navigate)
        self.commands = (
            Command(
                "find",
                "Find anything",
                palette.open,
                MenuGroup.VIEW,
                icon="search",
                keys=("Ctrl+K",),
                while_typing=True,
            ),
            Command("theme", "Theme", lambda: show_toast(theme.toggle(), "info"), MenuGroup.VIEW, icon="contrast"),
        )
        self.palette = palette
        with ui.element("div").classes("home"):
            self._head()
            self.body = ui.element("main").classes("home-body")
        self.undo = UndoBar()
        self.dialogs = DesignDialogs(show_toast=show_toast, offer_undo=self.undo.show)
        register_shortcuts(self.commands, open_inbox())
        self._refresh()
        self._offer_restore(removed)
        ui.timer(1.0, self._follow_disk)

    def _offer_restore(self, removed: str) -> None:
        """Offer to restore the design that was deleted while this window showed it."""
        key, _slash, component = removed.partition("/")
        workspace = self.library.workspace(key)
        trashed = workspace.trashed_designs.get(component) if workspace else None
        if workspace is not None and trashed is not None:
            self.dialogs.offer_restore(workspace, trashed)

    def _head(self) -> None:
        with ui.element("header").classes("head"):
            ui.link("vicode", "/").classes("brand").props('aria-label="vicode, all designs"')
            search = ui.input(placeholder="Search designs").props(
                "outlined dense clearable aria-label='Search designs'"
            )
            search.classes("home-search").on_value_change(lambda event: self._search(event.value or ""))
            ui.element("div").classes("spacer")
            for command in self.commands:
                icon_button(command.icon, command.label, command.handler)

    def _search(self, text: str) -> None:
        self.search_text = text.strip().casefold()
        self._refresh()

    def _follow_disk(self) -> None:
        with contextlib.suppress(OSError):
            self.library.find_new_projects()
        for workspace in self.library.workspaces:
            # The folder may be deleted while the editor is open.
            with contextlib.suppress(OSError):
                workspace.sync_from_disk()
        self._refresh()

    def _refresh(self) -> None:
        overviews = [self.library.overview(workspace) for workspace in self.library.workspaces]
        key = (
            self.search_text,
            [(each.cards(), each.broken_files(), each.workspace.project.components) for each in overviews],
        )
        if key == self.rendered_key:
            return
        self.rendered_key = key
        self.palette.commands = (*self.commands, *self._new_design_commands())
        self.body.clear()
        with self.body:
            if not overviews:
                self._empty()
            for overview in overviews:
                self._project(overview)

    def _new_design_commands(self) -> list[Command]:
        """Return a command per project that creates a design in it."""
        workspaces = self.library.workspaces
        if not workspaces:
            return [Command("new-design", "New design", self._create_first_design, MenuGroup.DESIGN, icon="add")]
        return [
            Command(
                f"new-design-{workspace.key}",
                "New design" if len(workspaces) == 1 else f"New design in {workspace.project.name}",
                partial(self.dialogs.ask_new, workspace),
                MenuGroup.DESIGN,
                icon="add",
            )
            for workspace in workspaces
        ]

    def _empty(self) -> None:
        with ui.column().classes("home-empty"):
            ui.label("No designs yet").classes("home-title").props('role="heading" aria-level="1"')
            ui.label("A design is a state machine in a YAML file.").classes("empty")
            with ui.row():
                primary_button("Create your first design", self._create_first_design, icon="add")
                sample = ui.button(
                    "Open the sample: a soccer player", icon="sports_soccer", on_click=self._open_sample, color=None
                )
                sample.props("outline no-caps").tooltip(
                    "A soccer player with a simulated field, copied to the folder 'forward'."
                )

    def _open_sample(self) -> None:
        try:
            workspace = self.library.add_sample()
        except OSError as error:
            show_toast(f"The sample was not copied to the folder 'forward': {error_reason(error)}", "negative")
            return
        ui.navigate.to(design_url(workspace.key, workspace.project.agents[0].root))

    def _create_first_design(self) -> None:
        self.dialogs.ask_new(self.library.ensure_project())

    def _project(self, overview: ProjectOverview) -> None:
        workspace, project = overview.workspace, overview.workspace.project
        cards = [card for card in overview.cards() if self._matches(card.component, card.doc)]
        broken = [each for each in overview.broken_files() if self._matches(each.file)]
        with ui.element("section").classes("home-project") as section:
            section.props["aria-label"] = project.name
            section.props["id"] = workspace.key
            with ui.row().classes("home-project-head"):
                ui.label(project.name).classes("home-title").props('role="heading" aria-level="1"')
                primary_button("New design", lambda: self.dialogs.ask_new(workspace), icon="add")
            if project.doc:
                ui.label(" ".join(project.doc.split())).classes("home-doc")
            self._cards(workspace, group_by_folder([*cards, *broken], lambda each: each.file))
            if not cards and not broken:
                self._nothing(bool(project.designs))
            if not self.search_text:
                self._uses(workspace)
                self._hand_written(overview)

    def _cards(self, workspace: Workspace, folders: Mapping[str, Sequence[DesignCard | BrokenFile]]) -> None:
        """Build the cards of the project and of its folders; those of large projects are closed until a search."""
        is_small = sum(map(len, folders.values())) <= MANY_DESIGNS
        for name, cards in folders.items():
            place: contextlib.AbstractContextManager[object] = contextlib.nullcontext()
            if name:
                is_open = self.folders_open.get((workspace.key, name), is_small) or bool(self.search_text)
                note = partial(self.folders_open.__setitem__, (workspace.key, name))
                place = Folder(name, len(cards), is_open=is_open, on_toggle=note).element
            with place, ui.element("div").classes("home-cards"):
                for card in cards:
                    if isinstance(card, BrokenFile):
                        broken_card(workspace, card)
                    else:
                        design_card(workspace, card, self.dialogs)

    def _nothing(self, has_designs: bool) -> None:
        text = (
            f"No designs match “{self.search_text}”" if has_designs else "No designs yet. Create one from a template."
        )
        ui.label(text).classes("empty")

    def _uses(self, workspace: Workspace) -> None:
        diagram = dependency_diagram(workspace.project, lambda component: design_url(workspace.key, component))
        if not diagram.edges:
            return
        _heading("Dependencies")
        with ui.row().classes("legend"):
            ui.label("requires: outputs are read").classes("legend-requires")
            ui.label("modulates: parameters are set").classes("legend-modulates")
        drawing = render_diagram(
            diagram, title=f"Components of {workspace.project.name}", palette=css_variable_palette()
        )
        # write_svg escapes all texts; the sanitizer would remove the links.
        ui.html(write_svg(drawing), sanitize=False).classes("home-uses").props('tabindex="0"')

    def _hand_written(self, overview: ProjectOverview) -> None:
        rows = overview.hand_written_components()
        if not rows:
            return
        _heading("Hand-written components")
        with ui.element("ul").classes("home-components"):
            for row in rows:
                hand_written_row(overview.workspace, row)

    def _matches(self, *texts: str) -> bool:
        return all(any(word in text.casefold() for text in texts) for word in self.search_text.split())


def _heading(text: str) -> None:
    ui.label(text).classes("home-heading").props('role="heading" aria-level="2"')


def _navigate(target: SearchTarget) -> None:
    ui.navigate.to(design_url(target.project, target.component, target.selected))
