"""The page that edits designs: the list of designs on the left, and what shows one of them."""

import contextlib
from dataclasses import replace
from functools import partial
from pathlib import Path
from urllib.parse import quote

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.pages.delivery import open_inbox
from vicode.editor.pages.design_editor import DesignEditor, OpenedDesign, Window
from vicode.editor.pages.navigation import HOME
from vicode.editor.pages.shortcuts import register_shortcuts
from vicode.editor.pages.side_panels import SideTabs
from vicode.editor.pages.theme import Theme, apply_theme
from vicode.editor.pages.user_identity import identify_user
from vicode.editor.panels.code.code_editor import CodeEditorFactory
from vicode.editor.panels.commands.command_palette import CommandPalette
from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.designs.designs_list import DesignsList
from vicode.editor.panels.designs.open_design import open_design
from vicode.editor.panels.header import Header
from vicode.editor.panels.toasts import show_toast
from vicode.editor.panels.undo_bar import UndoBar
from vicode.editor.session import Library
from vicode.editor.session.recovery.autosave import AutosaveService
from vicode.editor.session.search.search_index import SearchIndex, SearchTarget
from vicode.editor.view.page_urls import DesignAddress, design_url, parse_design_url

_PANELS_DELAY_S = 0.01
_NAVIGATION = Path(__file__).with_name("design_navigation.js")


class DesignPage:
    """One window; it shows one design at a time, and another one without being loaded again."""

    def __init__(
        self,
        library: Library,
        index: SearchIndex,
        autosave: AutosaveService | None,
        opened: OpenedDesign,
        *,
        starts_tour: bool,
    ) -> None:
        self.library = library
        self._client = ui.context.client
        user = identify_user(library.users)
        code_editors = CodeEditorFactory()
        theme = Theme(code_editors, apply_theme())
        with ui.element("div").classes("shell"):
            skip = ui.element("a").classes("skip-link")
            undo_bar = UndoBar()
            dialogs = DesignDialogs(show_toast=show_toast, offer_undo=undo_bar.show)
            head = ui.element("header").classes("head")
            self._designs = DesignsList(library, dialogs)
            main = ui.element("main").classes("design-view").props("tabindex=-1")
            tabs = SideTabs()
        with skip.props(f"href=#{main.html_id}"):
            ui.label("Skip to the design")
        self._window = Window(
            users=library.users,
            user_id=user.id,
            autosave=autosave,
            theme=theme,
            code_editors=code_editors,
            dialogs=dialogs,
            palette=CommandPalette(index, self._go_to),
            undo_bar=undo_bar,
            main=main,
            tabs=tabs,
            overlay=ui.element("div"),
            starts_tour=starts_tour,
            external_editor=library.external_editor,
            inbox=open_inbox(),
        )
        self._editor = DesignEditor(self._window, opened)
        commands = [replace(each, handler=partial(self._run_command, each.name)) for each in self._editor.commands]
        with head:
            self._header = Header(self._editor.context, commands)
        self._show(self._editor)
        register_shortcuts(commands, self._window.inbox)
        self._follow_browser()
        ui.timer(1.0, self._follow_disk)

    def _follow_browser(self) -> None:
        ui.add_body_html(f"<script>\n{_NAVIGATION.read_text(encoding='utf-8')}</script>")
        ui.on("show-design", self._on_show)
        self._client.on_connect(self._on_connect)
        self._client.on_disconnect(self._on_disconnect)
        self._client.on_delete(self._on_delete)

    def _show(self, editor: DesignEditor) -> None:
        self._editor = editor
        editor.show_in(self._header)
        context = editor.context
        ui.page_title(f"{context.design.component} – vicode")
        self._designs.show_current(design_url(context.workspace.key, context.design.component))

    def _on_show(self, event: GenericEventArguments) -> None:
        """Show another design in place of the current one."""
        address = parse_design_url(str(event.args))
        opened = open_design_at(self.library, address, is_synchronized=True) if address else None
        if opened is None:
            # The page says that there is no such design.
            ui.run_javascript("location.reload()")
            return
        before = self._editor.context
        with self._client:
            before.close()
            self._window.clear()
            editor = DesignEditor(self._window, opened)
            self._show(editor)
            # After the diagram was sent, while the browser draws it.
            ui.timer(_PANELS_DELAY_S, editor.build_panels, once=True)

    def _on_connect(self) -> None:
        self._editor.presence.join()

    def _on_disconnect(self) -> None:
        self._editor.context.disconnects.notify()

    def _on_delete(self) -> None:
        self._editor.context.close()

    def _run_command(self, name: str) -> object:
        """Run a command on the design that is shown now."""
        return next(command for command in self._editor.commands if command.name == name).handler()

    def _go_to(self, target: SearchTarget) -> None:
        self._editor.navigator.go_to(target)

    def _follow_disk(self) -> None:
        context = self._editor.context
        # The folder may be deleted while the editor is open; the open design stays.
        with contextlib.suppress(OSError):
            context.workspace.poll_disk()
            self.library.find_new_projects()
        self._designs.refresh()
        new_name = context.workspace.removed_components.get(context.design.component)
        if new_name is not None:
            key = context.workspace.key
            # The home page offers to restore a deleted design: an offer on this page would disappear with it.
            home_url = f"{HOME}?gone={quote(key)}/{quote(context.design.component)}"
            open_design(design_url(key, new_name) if new_name else home_url)


def open_design_at(library: Library, address: DesignAddress, *, is_synchronized: bool = False) -> OpenedDesign | None:
    """The design at an address, None if there is none; reads changed files first, unless an open window does that."""
    workspace = library.workspace(address.key)
    if workspace is None:
        return None
    if not is_synchronized or workspace.project.design(address.component) is None:
        with contextlib.suppress(OSError):
            workspace.sync_from_disk()
    document = workspace.open_document(address.component)
    return OpenedDesign(workspace=workspace, document=document, address=address) if document else None
