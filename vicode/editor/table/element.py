"""The Python side of the table: keeps what is shown, so that a page that mounts late or again gets it all."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.js_modules import TABLE_JS

Payload = Mapping[str, Any]


class TableGrid(ui.element, component=TABLE_JS / "vicode_table.js"):
    """The rows of a design (see `vicode.editor.view.table`), as a tree grid that keys alone can steer.

    Args:
        on_edit: called with every wish to change something (see `vicode.editor.session.table_edits`).
        on_select: called with the id of the row that is worked on.
    """

    def __init__(self, on_edit: Callable[[Payload], None], on_select: Callable[[str], None]) -> None:
        super().__init__()
        self._on_edit, self._on_select = on_edit, on_select
        self._table: dict[str, Any] = {"rows": [], "states": [], "uses": []}
        self._selected: list[str] = []
        self._is_mounted = False
        self._is_focus_pending = False
        # Handlers added after the first rendering would make NiceGUI mount the element anew.
        self.on("edit", self._on_edit_event)
        self.on("select", self._on_select_event)
        self.on("ready", self._on_ready)

    def load(self, table: Mapping[str, Any]) -> None:
        """Show a whole table."""
        self._table = dict(table)
        self._call("load", self._table)

    def apply(self, table: Mapping[str, Any], changes: Mapping[str, Any]) -> None:
        """Show another table, that differs by `changes` from the one shown."""
        self._table = dict(table)
        self._call("apply", dict(changes))

    def select(self, rows: Iterable[str]) -> None:
        """Mark exactly these rows, and bring the first of them into sight."""
        wanted = list(rows)
        if wanted == self._selected:
            # The hand may be some rows ahead by now: what it told is not told back to it.
            return
        self._selected = wanted
        self._call("select", self._selected)

    def edit_cell(self, row: str, column: str) -> None:
        """Open a cell for typing."""
        self._call("editCell", row, column)

    def show_error(self, payload: Payload, words: str) -> None:
        """Tell why an edit was not done; what was typed stays to be mended."""
        self._call("showError", dict(payload), words)

    def focus_grid(self) -> None:
        """Let the keys work here."""
        self._is_focus_pending = not self._is_mounted
        self._call("focusGrid")

    def _call(self, method: str, *arguments: object) -> None:
        # Before the element is mounted a call would be lost; `_on_ready` sends everything then.
        if self._is_mounted:
            self.run_method(method, *arguments)

    def _on_edit_event(self, event: GenericEventArguments) -> None:
        if isinstance(event.args, dict):
            self._on_edit(event.args)

    def _on_select_event(self, event: GenericEventArguments) -> None:
        self._selected = [str(event.args)]
        self._on_select(str(event.args))

    def _on_ready(self) -> None:
        self._is_mounted = True
        self._call("load", self._table)
        self._call("select", self._selected)
        if self._is_focus_pending:
            self.focus_grid()
