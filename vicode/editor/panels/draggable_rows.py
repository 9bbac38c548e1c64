"""Rows that can be reordered with the mouse."""

from collections.abc import Callable

from nicegui import ui

_ENTER = "(event) => { event.preventDefault(); event.currentTarget.classList.add('is-over'); }"
_LEAVE = "(event) => event.currentTarget.classList.remove('is-over')"
_DROP = "(event) => { event.preventDefault(); event.currentTarget.classList.remove('is-over'); emit(); }"


class DraggableRows:
    """The rows of one list; `move` is called with the old and the new index of a dropped row."""

    def __init__(self, move: Callable[[int, int], None]) -> None:
        self._move = move
        self._dragged_index: int | None = None

    def add(self, row: ui.element, index: int) -> None:
        """Make a row draggable, and a drop target for other rows."""
        row.props("draggable=true")
        row.on("dragstart", lambda: self._start_drag(index))
        row.on("dragend", lambda: self._start_drag(None))
        row.on("dragover", js_handler=_ENTER)
        row.on("dragleave", js_handler=_LEAVE)
        row.on("drop", lambda: self._drop(index), js_handler=_DROP)

    def _start_drag(self, index: int | None) -> None:
        self._dragged_index = index

    def _drop(self, index: int) -> None:
        # The dropped item may come from another list or window.
        from_index, self._dragged_index = self._dragged_index, None
        if from_index is not None and from_index != index:
            self._move(from_index, index)
