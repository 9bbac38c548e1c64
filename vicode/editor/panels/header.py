"""The bar at the top: where one is, what is unsaved, undo and redo, save and generate."""

from collections.abc import Sequence

from nicegui import ui

from vicode.editor.panels.command import Command
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import enable
from vicode.editor.panels.people_chips import PeopleChips
from vicode.editor.panels.rows import icon_button, primary_button
from vicode.editor.panels.save_dialog import ask_about_disk
from vicode.editor.view.address import design_address

_ICONS = ("find", "undo", "redo", "lay-out", "links", "page", "theme", "help")


class Header:
    """Builds the bar; `refresh` keeps its labels true."""

    def __init__(self, desk: Desk, commands: Sequence[Command], trail: Sequence[str] = ()) -> None:
        """Build it; `trail` are the components one came through."""
        self.desk = desk
        named = {command.name: command for command in commands}
        ui.link("vicode", "/").classes("brand").props('aria-label="vicode, all designs"')
        self._crumbs(trail)
        self.saved = ui.label().classes("saved").props('role="status"')
        self.clash = ui.button("Choose …", on_click=lambda: ask_about_disk(desk)).props("flat dense no-caps")
        ui.element("div").classes("spacer")
        self.people = PeopleChips(desk)
        self.buttons = {name: _icon(named[name]) for name in _ICONS}
        save, generate = named["save"], named["generate"]
        ui.button(save.label, icon=save.icon, on_click=save.act).props("flat no-caps dense").classes("head-button")
        primary_button(generate.label, generate.act, icon=generate.icon)

    def _crumbs(self, trail: Sequence[str]) -> None:
        """The way back: the project, the components one came through, and this one."""
        key, here = self.desk.workspace.key, self.desk.design.component
        with ui.element("nav").classes("crumbs").props('aria-label="Way here"'):
            ui.link(self.desk.workspace.project.name, f"/#{key}").classes("crumb")
            for at, name in enumerate(trail):
                _separator()
                ui.link(name, design_address(key, name, trail=trail[:at])).classes("crumb")
            _separator()
            ui.label(here).classes("crumb here").props('role="heading" aria-level="1"')

    def _state_of_file(self) -> tuple[str, str]:
        document = self.desk.document
        if document.sheet.clash is not None:
            return "Changed on disk, too", "is-clashing"
        autosave = " · saves by itself" if self.desk.workspace.autosave else ""
        return (f"Saved{autosave}", "") if document.is_saved else (f"Unsaved changes{autosave}", "is-unsaved")

    def refresh(self) -> None:
        """Show whether it is saved and what undo and redo would do."""
        document = self.desk.document
        text, kind = self._state_of_file()
        if self.saved.text != text:
            self.saved.set_text(text)
            self.saved.classes(add=kind, remove=" ".join({"is-unsaved", "is-clashing"} - {kind}))
        self.clash.set_visibility(document.sheet.clash is not None)
        enable(self.buttons["undo"], flag=bool(document.undo_label))
        enable(self.buttons["redo"], flag=bool(document.redo_label))


def _icon(command: Command) -> ui.button:
    return icon_button(command.icon, command.label, command.act, keys=" or ".join(command.keys))


def _separator() -> None:
    ui.label("/").classes("crumb-sep").props('aria-hidden="true"')
