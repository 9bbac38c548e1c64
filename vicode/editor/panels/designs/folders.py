"""The folders of a project's designs, which open and close."""

from collections.abc import Callable, Iterable
from pathlib import PurePosixPath
from typing import TypeVar

from nicegui import ui

from vicode.editor.panels.texts import pluralize

MANY_DESIGNS = 30
"""The folders of larger projects are closed at first."""

_EMIT_NEW_STATE = "(event) => emit(!event.currentTarget.parentElement.open)"

T = TypeVar("T")


def group_by_folder(items: Iterable[T], get_file: Callable[[T], str]) -> dict[str, list[T]]:
    """The items by the folder of their file, sorted; "" is the project itself. A single folder is not shown."""
    folders: dict[str, list[T]] = {}
    for item in items:
        parent = PurePosixPath(get_file(item)).parent.as_posix()
        folders.setdefault("" if parent == "." else parent, []).append(item)
    if len(folders) < 2:
        return {"": [item for group in folders.values() for item in group]}
    return dict(sorted(folders.items(), key=lambda pair: pair[0].casefold()))


class Folder:
    """A section with a folder's name; the body of the context manager builds its content.

    Args:
        name: the path of the folder.
        count: the number of its designs.
        is_open: whether it is open at first.
        on_toggle: called with the new state when the user opens or closes it.
    """

    def __init__(
        self, name: str, count: int, *, is_open: bool, on_toggle: Callable[[bool], None] = lambda _is_open: None
    ) -> None:
        self.name = name
        with ui.element("details").classes("folder") as self.element:
            head = ui.element("summary").classes("folder-head")
        with head:
            ui.label(name).classes("folder-name")
            ui.label(pluralize(count, "design")).classes("small")
        self.set_open(is_open=is_open)
        # The event "toggle" would also report what `set_open` does.
        head.on("click", lambda event: on_toggle(bool(event.args)), js_handler=_EMIT_NEW_STATE)

    def set_open(self, *, is_open: bool) -> None:
        self.element.props["open"] = is_open
