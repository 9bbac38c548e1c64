"""Rows that the mouse takes to another place of their list."""

from collections.abc import Callable

from nicegui import ui

_ENTER = "(event) => { event.preventDefault(); event.currentTarget.classList.add('is-over'); }"
_LEAVE = "(event) => event.currentTarget.classList.remove('is-over')"
_DROP = "(event) => { event.preventDefault(); event.currentTarget.classList.remove('is-over'); emit(); }"


class DraggableRows:
    """The rows of one list; `move` is called with the old and the new index of the one that was dropped."""

    def __init__(self, move: Callable[[int, int], None]) -> None:
        """Begin with no rows."""
        self._move = move
        self._dragged_index: int | None = None

    def add(self, row: ui.element, index: int) -> None:
        """Let a row be dragged, and others be dropped on it."""
        row.props("draggable=true")
        row.on("dragstart", lambda: self._start_drag(index))
        row.on("dragend", lambda: self._start_drag(None))
        row.on("dragover", js_handler=_ENTER)
        row.on("dragleave", js_handler=_LEAVE)
        row.on("drop", lambda: self._drop(index), js_handler=_DROP)

    def _start_drag(self, index: int | None) -> None:
        self._dragged_index = index

    def _drop(self, index: int) -> None:
        # What was dropped may be anything, from any window.
        held, self._dragged_index = self._dragged_index, None
        if held is not None and held != index:
            self._move(held, index)
