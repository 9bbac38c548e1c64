"""The page that edits a design: designs on the left, diagram in the middle, inspector on the right, dock below."""

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
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import design_url

# Changes by other users are drawn first; the panels follow.
_CANVAS_DELAY_S = 0.02
_PANELS_DELAY_S = 0.1


class DesignPage:
    """One window on one design, and the services for its panels. All its content can be rebuilt from the document."""

    def __init__(
        self,
        library: Library,
        workspace: Workspace,
        document: DocumentSession,
        request: PageRequest,
        autosave: AutosaveService | None,
    ) -> None:
        self.library = library
        user = identify_user(library.users)
        session = DocumentSession(document.shared, user.id)
        self.context = context = WindowContext(
            workspace=workspace,
            document=session,
            client=ui.context.client,
            page=self,
            open_sections=library.users.open_sections(user.id),
        )
        theme = Theme(context.code_editors, apply_theme())
        findings = FindingNavigator(context)
        with ui.element("div").classes("shell"):
            skip = ui.element("a").classes("skip-link")
            self.undo_bar = UndoBar()
            dialogs = DesignDialogs(show_toast=show_toast, offer_undo=self.undo_bar.show)
            head = ui.element("header").classes("head")
            self.designs = DesignsList(library, (workspace.key, document.design.component), dialogs)
            with ui.element("main").classes("design-view").props("tabindex=-1") as main:
                self.view = DesignView(context)
            self.side_panels = SidePanels(context, self.view.canvas_controller.canvas, findings)
        self.autosave = AutosaveControls(context, autosave)
        self.tour = Tour(context, lambda: self.view.is_table_shown, starts_automatically=request.tour)
        self.navigator = navigator = Navigator(context, request.index, request.trail)
        new = Command("new-design", "New design", lambda: dialogs.ask_new(workspace), MenuGroup.DESIGN, icon="add")
        parts = (findings, navigator, self.autosave, self.tour)
        commands = self._commands(theme, (new, *(command for part in parts for command in part.commands())))
        navigator.palette.commands = commands
        with head:
            self.header = Header(context, commands, request.trail)
        with skip.props(f"href=#{main.html_id}"):
            ui.label("Skip to the design")
        PresenceSync(context, user, self.view.canvas_controller.canvas, self.header.presence_bar)
        register_shortcuts(commands)
        navigator.select_initial(request.select, self.view.canvas_controller)
        context.changes.subscribe(self._refresh)
        self._refresh()
        self.view.canvas_controller.canvas.on_ready = self.side_panels.build
        self._scheduled: set[Callable[[], None]] = set()
        ui.context.client.on_delete(session.shared.changes.subscribe(self._on_change))
        ui.timer(1.0, self._follow_disk)

    def reveal(self, item: ItemRef) -> None:
        self.view.canvas_controller.center_on(item)

    def run_canvas_command(self, command: str) -> None:
        self.view.canvas_controller.canvas.run_command(command)

    def open_component(self, component: str) -> None:
        self.navigator.open_component(component)

    def offer_undo(self, text: str, undo: Callable[[], object]) -> None:
        self.undo_bar.show(text, undo, is_brief=True)

    def _commands(self, theme: Theme, others: tuple[Command, ...]) -> tuple[Command, ...]:
        page_commands = PageCommands(self.context, self.view.canvas_controller, theme)
        commands = (*page_commands.commands(), *others, *self.view.commands())
        commands += ExportDialog(self.context, lambda: page_commands.links_shown).commands()
        commands += (docs_command(self.context),)
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

    def _follow_disk(self) -> None:
        # The folder may be deleted while the editor is open; the open design stays.
        with contextlib.suppress(OSError):
            self.context.workspace.poll_disk()
            self.library.find_new_projects()
        self.designs.refresh()
        new_name = self.context.workspace.removed_components.get(self.context.design.component)
        if new_name is not None:
            key = self.context.workspace.key
            # The home page offers to restore a deleted design: an offer on this page would disappear with it.
            home_url = f"{HOME}?gone={quote(key)}/{quote(self.context.design.component)}"
            ui.navigate.to(design_url(key, new_name) if new_name else home_url)

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
        for panel in (self.view, self.header, self.side_panels, self.autosave, self.tour):
            panel.refresh()
