"""The header: breadcrumbs, save status, users, and buttons for the main commands."""

from collections.abc import Sequence

from nicegui import ui

from vicode.editor.panels.code.code_choices import ask_to_resolve_code
from vicode.editor.panels.commands.command import Command
from vicode.editor.panels.presence_bar import PresenceBar
from vicode.editor.panels.versions.conflict_dialog import ask_to_resolve_conflict
from vicode.editor.panels.widgets import icon_button, primary_button, set_enabled
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view.page_urls import design_url

_ICONS = ("find", "undo", "redo")
_VIEW_MENU = ("table", "links", "page", "theme", "tour", "help")


class Header:
    """Builds the header of a window; `show` fills it for a design, `refresh` updates its labels."""

    def __init__(self, context: WindowContext, commands: Sequence[Command]) -> None:
        self.context = context
        named = {command.name: command for command in commands}
        ui.link("vicode", "/").classes("brand").props('aria-label="vicode, all designs"')
        self._breadcrumbs = ui.element("nav").classes("crumbs").props('aria-label="Breadcrumb"')
        self.save_status = ui.label().classes("saved").props('role="status"')
        self.conflict_button = ui.button("Resolve…", on_click=self._resolve).props("flat dense no-caps")
        ui.element("div").classes("spacer")
        self.presence_bar = PresenceBar(context)
        self.buttons = {name: _icon(named[name]) for name in _ICONS}
        save, generate = named["save"], named["generate"]
        _labeled(named["lay-out"])
        _build_menu([named[name] for name in _VIEW_MENU])
        _labeled(save)
        primary_button(generate.label, generate.handler, icon=generate.icon)

    def show(self, context: WindowContext, trail: Sequence[str]) -> None:
        """Show a design; `trail` are the components on the path to it."""
        self.context = self.presence_bar.context = context
        key, here = context.workspace.key, context.design.component
        self._breadcrumbs.clear()
        with self._breadcrumbs:
            ui.link(context.workspace.project.name, f"/#{key}").classes("crumb")
            for index, name in enumerate(trail):
                _separator()
                ui.link(name, design_url(key, name, trail=trail[:index])).classes("crumb")
            _separator()
            ui.label(here).classes("crumb here").props('role="heading" aria-level="1"')
        self.presence_bar.refresh()

    def _file_status(self) -> tuple[str, str]:
        document = self.context.document
        if document.shared.disk_conflict is not None:
            return "Conflict: file changed on disk", "is-conflicting"
        if document.shared.outside.conflicts:
            return "Conflict: generated code edited", "is-conflicting"
        more = " · Open in another editor" if self.context.workspace.has_other_editor else ""
        return (f"Saved{more}", "") if document.is_saved else (f"Unsaved changes{more}", "is-unsaved")

    def _resolve(self) -> None:
        if self.context.document.shared.disk_conflict is not None:
            ask_to_resolve_conflict(self.context)
        else:
            ask_to_resolve_code(self.context)

    def refresh(self) -> None:
        document = self.context.document
        text, kind = self._file_status()
        if self.save_status.text != text:
            self.save_status.set_text(text)
            self.save_status.classes(add=kind, remove=" ".join({"is-unsaved", "is-conflicting"} - {kind}))
        self.conflict_button.set_visibility(
            document.shared.disk_conflict is not None or bool(document.shared.outside.conflicts)
        )
        set_enabled(self.buttons["undo"], flag=bool(document.undo_label))
        set_enabled(self.buttons["redo"], flag=bool(document.redo_label))


def _icon(command: Command) -> ui.button:
    return icon_button(command.icon, command.label, command.handler, keys=" or ".join(command.keys))


def _labeled(command: Command) -> ui.button:
    button = ui.button(command.label, icon=command.icon, on_click=command.handler, color=None).props(
        "flat no-caps dense"
    )
    # Narrow windows hide the label.
    button.props["aria-label"] = command.label
    return button.classes("head-button")


def _build_menu(commands: Sequence[Command]) -> None:
    with (
        ui.button("View", icon="visibility", color=None)
        .props("flat no-caps dense aria-label=View aria-haspopup=menu")
        .classes("head-button"),
        ui.menu().props("auto-close"),
    ):
        for command in commands:
            with ui.menu_item(on_click=command.handler).props("role=menuitem").classes("view-item"):
                ui.icon(command.icon)
                ui.label(command.label)
                ui.label(" or ".join(command.keys)).classes("small")


def _separator() -> None:
    ui.label("/").classes("crumb-sep").props('aria-hidden="true"')
