"""The page that edits a design: canvas in the middle, designs to the left, inspector to the right, findings below."""

import contextlib
from collections.abc import Callable
from urllib.parse import quote

from nicegui import core, ui

from vicode.editor.pages.actions import Actions
from vicode.editor.pages.beside import Beside
from vicode.editor.pages.going import HOME, Going, Way
from vicode.editor.pages.keeping import Keeping
from vicode.editor.pages.keys import listen_to_keys
from vicode.editor.pages.look import Theme, add_look
from vicode.editor.pages.meeting import Meeting
from vicode.editor.pages.site_pages import page_command
from vicode.editor.pages.stage import Stage
from vicode.editor.pages.visitor import greet_visitor
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.designs_list import DesignsList
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.export_dialog import ExportDialog
from vicode.editor.panels.header import Header
from vicode.editor.panels.help_dialog import show_help
from vicode.editor.panels.messages import say
from vicode.editor.panels.problems import Problems
from vicode.editor.panels.tour import Tour
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.session import Document, Library, Workspace
from vicode.editor.session.keeper import Keeper
from vicode.editor.view.address import design_address

# What others do is seen in the drawing first; the panels say it when there is time.
_DRAWING_S = 0.02
_PANELS_S = 0.1


class DesignPage:
    """One window on one design; everything in it can be rebuilt from the document."""

    def __init__(
        self, library: Library, workspace: Workspace, document: Document, way: Way, keeper: Keeper | None
    ) -> None:
        """Build the page for the browser that asks for it."""
        person = greet_visitor(library.people)
        hand = Document(document.sheet, person.id)
        self.desk = desk = Desk(workspace=workspace, document=hand, client=ui.context.client)
        theme = Theme(desk.code_editors, add_look())
        problems = Problems(desk)
        with ui.element("div").classes("shell"):
            skip = ui.element("a").classes("skip-link")
            desk.offer_undo = UndoBar().offer
            dialogs = DesignDialogs(say=say, offer_undo=desk.offer_undo)
            head = ui.element("header").classes("head")
            self.designs = DesignsList(library, (workspace.key, document.design.component), dialogs)
            with ui.element("main").classes("stage").props("tabindex=-1") as main:
                self.stage = Stage(desk)
            self.beside = Beside(desk, self.stage.drawing.canvas, problems)
        self.keeping = Keeping(desk, keeper)
        self.tour = Tour(desk, lambda: self.stage.shows_table, begins=way.tour)
        going = Going(desk, way.index, way.trail)
        new = Command("new-design", "New design", lambda: dialogs.ask_new(workspace), Place.DESIGN, icon="add")
        own = (new, *problems.commands(), *going.commands(), *self.keeping.commands(), *self.tour.commands())
        commands = self._commands(theme, own)
        going.palette.commands = commands
        with head:
            self.header = Header(desk, commands, way.trail)
        with skip.props(f"href=#{main.html_id}"):
            ui.label("Skip to the design")
        Meeting(desk, person, self.stage.drawing.canvas, self.header.people)
        listen_to_keys(commands)
        arrived = going.start(way.select)
        desk.listen(self._refresh)
        self._refresh()
        self.stage.drawing.canvas.on_shown = self.beside.begin
        if arrived:
            self.stage.drawing.arrive_at(arrived)
        self._is_due: set[Callable[[], None]] = set()
        ui.context.client.on_delete(hand.watch(self._hear))
        ui.timer(1.0, self._follow_disk)

    def _commands(self, theme: Theme, others: tuple[Command, ...]) -> tuple[Command, ...]:
        """All that can be asked of this page, in the order in which it is listed."""
        actions = Actions(self.desk, self.stage.drawing, theme)
        commands = (*actions.commands(), *others, *self.stage.commands())
        commands += ExportDialog(self.desk, lambda: actions.links_shown).commands()
        commands += (page_command(self.desk),)
        help_ = Command("help", "Keys and gestures", lambda: show_help(commands), Place.VIEW, icon="help", keys=("?",))
        commands += (*self.beside.commands(), help_)
        return (*commands, *self.stage.drawing.commands(commands))

    def _follow_disk(self) -> None:
        # The folder itself may go while the editor is open; what is open here stays, and can be saved elsewhere.
        with contextlib.suppress(OSError):
            self.desk.workspace.glance()
        self.designs.refresh()
        became = self.desk.workspace.gone.get(self.desk.design.component)
        if became is not None:
            key = self.desk.workspace.key
            # The home offers to put back what was thrown away: the offer here goes with the page.
            away = f"{HOME}?gone={quote(key)}/{quote(self.desk.design.component)}"
            ui.navigate.to(design_address(key, became) if became else away)

    def _hear(self, by: Document) -> None:
        """Follow a change: at once if it was made here, else a moment later, so that many come as one."""
        if by is self.desk.document:
            self._draw()
            self._tell()
        else:
            self._later(_DRAWING_S, self._draw)
            self._later(_PANELS_S, self._tell)

    def _later(self, pause_s: float, act: Callable[[], None]) -> None:
        if act not in self._is_due and core.loop is not None:
            self._is_due.add(act)
            # The more windows there are, the more edits each takes at once. Generating reads beside the event loop.
            pause_s *= max(1.0, len(self.desk.company.all) / 12)
            core.loop.call_soon_threadsafe(core.loop.call_later, pause_s, act)

    def _draw(self) -> None:
        self._is_due.discard(self._draw)
        if not self.stage.drawing.canvas.is_deleted:
            with self.stage.drawing.canvas.client:
                self.stage.follow()

    def _tell(self) -> None:
        self._is_due.discard(self._tell)
        if not self.stage.drawing.canvas.is_deleted:
            with self.stage.drawing.canvas.client:
                self.beside.design_changed()
                self.desk.tell()

    def _refresh(self) -> None:
        for panel in (self.stage, self.header, self.beside, self.keeping, self.tour):
            panel.refresh()
