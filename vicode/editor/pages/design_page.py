"""The page that edits a design: canvas in the middle, designs to the left, inspector to the right, findings below."""

import contextlib
from collections.abc import Callable
from urllib.parse import quote

from nicegui import core, ui

from vicode.editor.pages.autosave_ui import AutosaveControls
from vicode.editor.pages.design_view import DesignView
from vicode.editor.pages.docs_preview import docs_command
from vicode.editor.pages.navigation import HOME, Navigator, PageRequest
from vicode.editor.pages.page_commands import PageCommands
from vicode.editor.pages.presence import PresenceSync
from vicode.editor.pages.shortcuts import register_shortcuts
from vicode.editor.pages.side_panels import SidePanels
from vicode.editor.pages.theme import Theme, apply_theme
from vicode.editor.pages.user_identity import identify_user
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.designs_list import DesignsList
from vicode.editor.panels.export_dialog import ExportDialog
from vicode.editor.panels.finding_navigation import FindingNavigator
from vicode.editor.panels.header import Header
from vicode.editor.panels.help_dialog import show_help
from vicode.editor.panels.toasts import show_toast
from vicode.editor.panels.tour import Tour
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DocumentSession, Library, Workspace
from vicode.editor.session.autosave import AutosaveService
from vicode.editor.view.page_urls import design_url

# What others do is seen in the drawing first; the panels say it when there is time.
_CANVAS_DELAY_S = 0.02
_PANELS_DELAY_S = 0.1


class DesignPage:
    """One window on one design; everything in it can be rebuilt from the document."""

    def __init__(
        self,
        library: Library,
        workspace: Workspace,
        document: DocumentSession,
        way: PageRequest,
        keeper: AutosaveService | None,
    ) -> None:
        """Build the page for the browser that asks for it."""
        person = identify_user(library.users)
        hand = DocumentSession(document.shared, person.id)
        self.context = desk = WindowContext(workspace=workspace, document=hand, client=ui.context.client)
        theme = Theme(desk.code_editors, apply_theme())
        problems = FindingNavigator(desk)
        with ui.element("div").classes("shell"):
            skip = ui.element("a").classes("skip-link")
            desk.offer_undo = UndoBar().show
            dialogs = DesignDialogs(show_toast=show_toast, offer_undo=desk.offer_undo)
            head = ui.element("header").classes("head")
            self.designs = DesignsList(library, (workspace.key, document.design.component), dialogs)
            with ui.element("main").classes("design-view").props("tabindex=-1") as main:
                self.view = DesignView(desk)
            self.side_panels = SidePanels(desk, self.view.canvas_controller.canvas, problems)
        self.autosave = AutosaveControls(desk, keeper)
        self.tour = Tour(desk, lambda: self.view.is_table_shown, starts_automatically=way.tour)
        going = Navigator(desk, way.index, way.trail)
        new = Command("new-design", "New design", lambda: dialogs.ask_new(workspace), MenuGroup.DESIGN, icon="add")
        own = (new, *problems.commands(), *going.commands(), *self.autosave.commands(), *self.tour.commands())
        commands = self._commands(theme, own)
        going.palette.commands = commands
        with head:
            self.header = Header(desk, commands, way.trail)
        with skip.props(f"href=#{main.html_id}"):
            ui.label("Skip to the design")
        PresenceSync(desk, person, self.view.canvas_controller.canvas, self.header.presence_bar)
        register_shortcuts(commands)
        arrived = going.select_initial(way.select)
        desk.subscribe(self._refresh)
        self._refresh()
        self.view.canvas_controller.canvas.on_ready = self.side_panels.build
        if arrived:
            self.view.canvas_controller.scroll_to_initial(arrived)
        self._scheduled: set[Callable[[], None]] = set()
        ui.context.client.on_delete(hand.subscribe(self._on_change))
        ui.timer(1.0, self._follow_disk)

    def _commands(self, theme: Theme, others: tuple[Command, ...]) -> tuple[Command, ...]:
        """All that can be asked of this page, in the order in which it is listed."""
        actions = PageCommands(self.context, self.view.canvas_controller, theme)
        commands = (*actions.commands(), *others, *self.view.commands())
        commands += ExportDialog(self.context, lambda: actions.links_shown).commands()
        commands += (docs_command(self.context),)
        help_ = Command(
            "help", "Keys and gestures", lambda: show_help(commands), MenuGroup.VIEW, icon="help", keys=("?",)
        )
        commands += (*self.side_panels.commands(), help_)
        return (*commands, *self.view.canvas_controller.commands(commands))

    def _follow_disk(self) -> None:
        # The folder itself may go while the editor is open; what is open here stays, and can be saved elsewhere.
        with contextlib.suppress(OSError):
            self.context.workspace.poll_disk()
        self.designs.refresh()
        became = self.context.workspace.removed_components.get(self.context.design.component)
        if became is not None:
            key = self.context.workspace.key
            # The home offers to put back what was thrown away: the offer here goes with the page.
            away = f"{HOME}?gone={quote(key)}/{quote(self.context.design.component)}"
            ui.navigate.to(design_url(key, became) if became else away)

    def _on_change(self, by: DocumentSession) -> None:
        """Follow a change: at once if it was made here, else a moment later, so that many come as one."""
        if by is self.context.document:
            self._refresh_canvas()
            self._refresh_panels()
        else:
            self._schedule(_CANVAS_DELAY_S, self._refresh_canvas)
            self._schedule(_PANELS_DELAY_S, self._refresh_panels)

    def _schedule(self, pause_s: float, act: Callable[[], None]) -> None:
        if act not in self._scheduled and core.loop is not None:
            self._scheduled.add(act)
            # The more windows there are, the more edits each takes at once. Generating reads beside the event loop.
            pause_s *= max(1.0, len(self.context.presence.presences) / 12)
            core.loop.call_soon_threadsafe(core.loop.call_later, pause_s, act)

    def _refresh_canvas(self) -> None:
        self._scheduled.discard(self._refresh_canvas)
        if not self.view.canvas_controller.canvas.is_deleted:
            with self.view.canvas_controller.canvas.client:
                self.view.update()

    def _refresh_panels(self) -> None:
        self._scheduled.discard(self._refresh_panels)
        if not self.view.canvas_controller.canvas.is_deleted:
            with self.view.canvas_controller.canvas.client:
                self.side_panels.design_changed()
                self.context.notify_listeners()

    def _refresh(self) -> None:
        for panel in (self.view, self.header, self.side_panels, self.autosave, self.tour):
            panel.refresh()
