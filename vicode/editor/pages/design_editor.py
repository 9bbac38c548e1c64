"""What a window shows of one design: header, diagram and table, panels. Replaced as a whole when it shows another."""

from collections.abc import Callable
from dataclasses import dataclass, field

from nicegui import core, ui

from vicode.editor.pages.autosave_ui import AutosaveControls
from vicode.editor.pages.design_view import DesignView
from vicode.editor.pages.docs_preview import docs_command
from vicode.editor.pages.extraction_commands import ExtractionCommands
from vicode.editor.pages.line_command import LineCommand
from vicode.editor.pages.navigation import Navigator
from vicode.editor.pages.outside_edit_notices import OutsideEditNotices
from vicode.editor.pages.page_commands import PageCommands
from vicode.editor.pages.presence import PresenceSync
from vicode.editor.pages.side_panels import SidePanels, SideTabs
from vicode.editor.pages.theme import Theme
from vicode.editor.panels.code.code_editor import CodeEditorFactory
from vicode.editor.panels.code.open_in_editor import editor_command
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.commands.command_palette import CommandPalette
from vicode.editor.panels.commands.help_dialog import show_help
from vicode.editor.panels.commands.tour import Tour
from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.export_dialog import ExportDialog
from vicode.editor.panels.findings.finding_navigation import FindingNavigator
from vicode.editor.panels.header import Header
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DocumentSession, User, UserDirectory, Workspace
from vicode.editor.session.external_editor import ExternalEditor
from vicode.editor.session.gestures.delivery import Inbox
from vicode.editor.session.recovery.autosave import AutosaveService
from vicode.editor.session.search.search_index import SearchTarget
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import DesignAddress, parse_trail

# Changes by other users are drawn first; the panels follow.
_CANVAS_DELAY_S = 0.02
_PANELS_DELAY_S = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class Window:
    """What a window keeps while it shows other designs, and the containers for what it shows of each."""

    users: UserDirectory
    user_id: str
    autosave: AutosaveService | None
    theme: Theme
    code_editors: CodeEditorFactory
    dialogs: DesignDialogs
    palette: CommandPalette
    undo_bar: UndoBar
    main: ui.element
    tabs: SideTabs
    overlay: ui.element
    starts_tour: bool
    external_editor: ExternalEditor
    inbox: Inbox
    offered_recovery: set[Workspace] = field(default_factory=set)

    @property
    def user(self) -> User:
        return self.users.get_or_create_user(self.user_id)

    def clear(self) -> None:
        """Remove what shows a design."""
        self.tabs.clear()
        for container in (self.main, self.overlay):
            container.clear()
        for child in tuple(ui.context.client.content.default_slot.children):
            if isinstance(child, ui.dialog):
                child.delete()


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenedDesign:
    """A design, and the address that named it."""

    workspace: Workspace
    document: DocumentSession
    address: DesignAddress


class DesignEditor:
    """The parts of a window that show one design, and the services for its panels; all can be rebuilt."""

    def __init__(self, window: Window, opened: OpenedDesign) -> None:
        """Build all but the panels; `show_in` and `build_panels` complete it."""
        self.window = window
        workspace, address = opened.workspace, opened.address
        session = DocumentSession(opened.document.shared, window.user_id)
        self.context = context = WindowContext(
            workspace=workspace,
            document=session,
            client=ui.context.client,
            page=self,
            inbox=window.inbox,
            open_sections=window.users.open_sections(window.user_id),
            code_editors=window.code_editors,
            external_editor=window.external_editor,
        )
        component = context.design.component
        self.trail = trail = parse_trail(address.trail, workspace.project.interfaces(), component)
        findings = FindingNavigator(context)
        with window.main:
            self.view = DesignView(context)
        canvas = self.view.canvas_controller.canvas
        self.side_panels = SidePanels(context, canvas, findings, window.tabs)
        self.autosave = AutosaveControls(context, window.autosave)
        self.outside_edits = OutsideEditNotices(context)
        with window.overlay:
            self.tour = Tour(context, lambda: self.view.is_table_shown, starts_automatically=window.starts_tour)
        self.navigator = Navigator(context, window.palette.open, trail)
        new = Command("new-design", "New design", self._ask_new, MenuGroup.DESIGN, icon="add")
        parts = (findings, self.navigator, self.autosave, self.tour)
        self.commands = self._commands((new, *(command for part in parts for command in part.commands())))
        window.palette.commands = self.commands
        window.palette.interpret = LineCommand(context).interpret
        window.palette.current = SearchTarget(project=workspace.key, component=component)
        self.navigator.select_initial(address.selected, self.view.canvas_controller)
        canvas.on_ready = self.build_panels
        self._scheduled: set[Callable[[], None]] = set()
        context.closings.subscribe(session.shared.changes.subscribe(self._on_change))

    def show_in(self, header: Header) -> None:
        """Fill the header of the window, and refresh all parts after each change."""
        self.header = header
        canvas = self.view.canvas_controller.canvas
        self.presence = PresenceSync(self.context, self.window.user, canvas, header.presence_bar)
        if self.context.client.has_socket_connection:
            self.presence.join()
        header.show(self.context, self.trail)
        self.context.changes.subscribe(self._refresh)
        self._refresh()

    def build_panels(self) -> None:
        """Build the panels unless they exist, or the window shows another design."""
        if not self.context.is_closed:
            self.side_panels.build()

    def reveal(self, item: ItemRef) -> None:
        self.view.canvas_controller.center_on(item)

    def run_canvas_command(self, command: str) -> None:
        self.view.canvas_controller.canvas.run_command(command)

    def open_component(self, component: str) -> None:
        self.navigator.open_component(component)

    def offer_undo(self, text: str, undo: Callable[[], object]) -> None:
        self.window.undo_bar.show(text, undo, is_brief=True)

    async def view_run(self, trace: str) -> None:
        await self.side_panels.view_run(trace)

    def recover_work(self, is_continued: bool) -> None:
        if is_continued:
            self.autosave.recover()
        workspace = self.context.workspace
        if workspace not in self.window.offered_recovery:
            self.window.offered_recovery.add(workspace)
            self.autosave.offer_recovery()

    def _ask_new(self) -> None:
        self.window.dialogs.ask_new(self.context.workspace)

    def _commands(self, others: tuple[Command, ...]) -> tuple[Command, ...]:
        page_commands = PageCommands(self.context, self.view.canvas_controller, self.window.theme)
        commands = (*page_commands.commands(), *others, *self.view.commands())
        commands += ExtractionCommands(self.context).commands()
        commands += ExportDialog(self.context, lambda: page_commands.links_shown).commands()
        commands += (docs_command(self.context), *editor_command(self.context))
        help_ = Command(
            "help",
            "Keyboard shortcuts and gestures",
            lambda: show_help(commands),
            MenuGroup.VIEW,
            icon="help",
            keys=("?",),
        )
        commands += (*self.side_panels.commands(), help_)
        return (*commands, *self.view.canvas_controller.commands(commands))

    def _on_change(self, origin: DocumentSession) -> None:
        """Show a change: immediately if this window made it, else delayed, to combine several changes."""
        if origin is self.context.document:
            self._refresh_canvas()
            self._refresh_panels()
        else:
            self._schedule(_CANVAS_DELAY_S, self._refresh_canvas)
            self._schedule(_PANELS_DELAY_S, self._refresh_panels)

    def _schedule(self, delay_s: float, action: Callable[[], None]) -> None:
        if action not in self._scheduled and core.loop is not None:
            self._scheduled.add(action)
            # With more windows, each combines more edits.
            delay_s *= max(1.0, len(self.context.presence.presences) / 12)
            core.loop.call_soon_threadsafe(core.loop.call_later, delay_s, action)

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
                self.context.notify_subscribers()

    def _refresh(self) -> None:
        for panel in (self.view, self.header, self.side_panels, self.autosave, self.outside_edits, self.tour):
            panel.refresh()
