"""The help dialog: all commands with keys, and the gestures of the canvas."""

from collections.abc import Iterable, Sequence

from nicegui import ui

from vicode.editor.canvas.commands import CANVAS_COMMANDS, GESTURE_HELP, CommandGroup
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.dialogs import titled_dialog

_PAGE = {MenuGroup.DESIGN: "design", MenuGroup.EDIT: "edit", MenuGroup.VIEW: "view", MenuGroup.SIMULATE: "Simulate tab"}


def show_help(commands: Sequence[Command]) -> None:
    with titled_dialog("Keyboard shortcuts and gestures", "help") as dialog:
        with ui.element("div").classes("help-scroll"), ui.element("div").classes("help-columns"):
            for group in CommandGroup:
                _section(f"Canvas: {group.lower()}", _canvas_rows(group))
            for place, title in _PAGE.items():
                _section(f"Page: {title}", _page_rows(commands, place))
            _section("Canvas: mouse and touch", GESTURE_HELP)
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps autofocus")
    dialog.on("hide", dialog.delete)


def _canvas_rows(group: CommandGroup) -> list[tuple[str, str]]:
    shown = (each for each in CANVAS_COMMANDS if each.group is group and (each.keys or each.keys_label))
    return [(each.keys_label or " or ".join(each.keys), each.label) for each in shown]


def _page_rows(commands: Iterable[Command], place: MenuGroup) -> list[tuple[str, str]]:
    canvas_names = {each.name for each in CANVAS_COMMANDS if each.keys}
    shown = (each for each in commands if each.menu_group == place and each.keys and each.name not in canvas_names)
    return [(" or ".join(each.keys), each.label) for each in shown]


def _section(title: str, rows: Iterable[tuple[str, str]]) -> None:
    rows = list(rows)
    if not rows:
        return
    with ui.element("section").classes("help-section"):
        ui.label(title).classes("help-title").props('role="heading" aria-level="3"')
        with ui.element("dl"):
            for keys, meaning in rows:
                _row(keys, meaning)


def _row(keys: str, meaning: str) -> None:
    with ui.element("div").classes("help-row"):
        with ui.element("dt").classes("help-keys"):
            ui.label(keys)
        with ui.element("dd"):
            ui.label(meaning)
