"""The home of a folder: its designs as cards, what they use, what is broken; the place to begin and to come back to."""

import contextlib
from functools import partial
from pathlib import Path

from nicegui import ui

from vicode.diagram.drawing import draw_figure
from vicode.diagram.palettes import from_properties
from vicode.diagram.svg import write_svg
from vicode.diagram.usage import usage_figure
from vicode.editor.pages.keys import listen_to_keys
from vicode.editor.pages.look import Theme, add_look
from vicode.editor.panels.cards import broken_card, design_card, hand_written_row
from vicode.editor.panels.code_editor import CodeEditors
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.messages import say
from vicode.editor.panels.palette import Palette
from vicode.editor.panels.rows import icon_button, primary_button
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.session import Library, Workspace
from vicode.editor.session.finding_things import Goal, Index
from vicode.editor.session.overview import Overview
from vicode.editor.view.address import design_address

_SHEET = Path(__file__).parent / "home.css"


class HomePage:
    """One window on a folder; built anew when something in it has changed."""

    def __init__(self, library: Library, index: Index, gone: str = "") -> None:
        """Build the page for the browser that asks for it; `gone`, PROJECT/COMPONENT, is what it came from."""
        self.library = library
        self.shape: object = None
        self.wanted = ""
        theme = Theme(CodeEditors(), add_look())
        ui.add_css(_SHEET.read_text(encoding="utf-8"))
        palette = Palette(index, _go)
        self.commands = (
            Command(
                "find", "Find anything", palette.open, Place.VIEW, icon="search", keys=("Ctrl+K",), while_typing=True
            ),
            Command(
                "theme",
                "Light, dark, or as the system",
                lambda: say(theme.toggle(), "info"),
                Place.VIEW,
                icon="contrast",
            ),
        )
        self.palette = palette
        with ui.element("div").classes("home"):
            self._head()
            self.body = ui.element("main").classes("home-body")
        self.undo = UndoBar()
        self.dialogs = DesignDialogs(say=say, offer_undo=self.undo.offer)
        listen_to_keys(self.commands)
        self._refresh()
        self._offer_back(gone)
        ui.timer(1.0, self._follow_disk)

    def _offer_back(self, gone: str) -> None:
        """Offer to put back the design that was thrown away while this window showed it."""
        key, _slash, component = gone.partition("/")
        workspace = self.library.workspace(key)
        thrown = workspace.thrown_away.get(component) if workspace else None
        if workspace is not None and thrown is not None:
            self.dialogs.offer_back(workspace, thrown)

    def _head(self) -> None:
        with ui.element("header").classes("head"):
            ui.link("vicode", "/").classes("brand").props('aria-label="vicode, all designs"')
            search = ui.input(placeholder="Search designs").props(
                "outlined dense clearable aria-label='Search designs'"
            )
            search.classes("home-search").on_value_change(lambda event: self._search(event.value or ""))
            ui.element("div").classes("spacer")
            for command in self.commands:
                icon_button(command.icon, command.label, command.act)

    def _search(self, text: str) -> None:
        self.wanted = text.strip().casefold()
        self._refresh()

    def _follow_disk(self) -> None:
        for workspace in self.library.workspaces:
            # A folder may go while the editor is open.
            with contextlib.suppress(OSError):
                workspace.follow_disk()
        self._refresh()

    def _refresh(self) -> None:
        overviews = [self.library.overview(workspace) for workspace in self.library.workspaces]
        shape = (
            self.wanted,
            [(each.cards(), each.broken(), each.workspace.project.components) for each in overviews],
        )
        if shape == self.shape:
            return
        self.shape = shape
        self.palette.commands = (*self.commands, *self._makers())
        self.body.clear()
        with self.body:
            if not overviews:
                self._empty()
            for overview in overviews:
                self._project(overview)

    def _makers(self) -> list[Command]:
        """A new design, in each of the projects."""
        workspaces = self.library.workspaces
        if not workspaces:
            return [Command("new-design", "New design", self._make_first, Place.DESIGN, icon="add")]
        return [
            Command(
                f"new-design-{workspace.key}",
                "New design" if len(workspaces) == 1 else f"New design in {workspace.project.name}",
                partial(self.dialogs.ask_new, workspace),
                Place.DESIGN,
                icon="add",
            )
            for workspace in workspaces
        ]

    def _empty(self) -> None:
        with ui.column().classes("home-empty"):
            ui.label("No designs here yet").classes("home-title").props('role="heading" aria-level="1"')
            ui.label("A design is a state machine in a YAML file; ten lines are enough to begin.").classes("empty")
            primary_button("Make the first design", self._make_first, icon="add")

    def _make_first(self) -> None:
        self.dialogs.ask_new(self.library.begin())

    def _project(self, overview: Overview) -> None:
        workspace, project = overview.workspace, overview.workspace.project
        cards = [card for card in overview.cards() if self._is_wanted(card.component, card.doc)]
        broken = [each for each in overview.broken() if self._is_wanted(each.file)]
        with ui.element("section").classes("home-project") as section:
            section.props["aria-label"] = project.name
            section.props["id"] = workspace.key
            with ui.row().classes("home-project-head"):
                ui.label(project.name).classes("home-title").props('role="heading" aria-level="1"')
                primary_button("New design", lambda: self.dialogs.ask_new(workspace), icon="add")
            if project.doc:
                ui.label(" ".join(project.doc.split())).classes("home-doc")
            with ui.element("div").classes("home-cards"):
                for card in cards:
                    design_card(workspace, card, self.dialogs)
                for each in broken:
                    broken_card(workspace, each)
            if not cards and not broken:
                self._nothing(bool(project.designs))
            if not self.wanted:
                self._uses(workspace)
                self._hand_written(overview)

    def _nothing(self, has_designs: bool) -> None:
        words = (
            f"Nothing here is called like “{self.wanted}”"
            if has_designs
            else "No designs yet: make one from a template"
        )
        ui.label(words).classes("empty")

    def _uses(self, workspace: Workspace) -> None:
        figure = usage_figure(workspace.project, lambda component: design_address(workspace.key, component))
        if not figure.arrows:
            return
        _heading("Who uses whom")
        with ui.row().classes("legend"):
            ui.label("requires: read by its user").classes("legend-requires")
            ui.label("modulates: steered by its user").classes("legend-modulates")
        drawing = draw_figure(figure, title=f"Components of {workspace.project.name}", palette=from_properties())
        # Written by us with every text escaped; a link of SVG would not outlive the sanitizer.
        ui.html(write_svg(drawing), sanitize=False).classes("home-uses").props('tabindex="0"')

    def _hand_written(self, overview: Overview) -> None:
        rows = overview.hand_written()
        if not rows:
            return
        _heading("Written by hand")
        with ui.element("ul").classes("home-components"):
            for row in rows:
                hand_written_row(overview.workspace, row)

    def _is_wanted(self, *texts: str) -> bool:
        return all(any(word in text.casefold() for text in texts) for word in self.wanted.split())


def _heading(text: str) -> None:
    ui.label(text).classes("home-heading").props('role="heading" aria-level="2"')


def _go(goal: Goal) -> None:
    ui.navigate.to(design_address(goal.project, goal.component, goal.selected))
