"""Python side of the table. It keeps the displayed rows, so that an element that mounts late or again receives them."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.js_modules import TABLE_JS
from vicode.editor.session.gestures.edits import RequestedEdit
from vicode.editor.session.gestures.table_edits import SetCell
from vicode.editor.table.protocol import TABLE_EVENTS, SelectRow


class TableGrid(ui.element, component=TABLE_JS / "vicode_table.js"):
    """Tree grid with the rows of a design (see `vicode.editor.view.table`), fully usable by keyboard.

    Args:
        on_edit: called with every edit that the user requests (see `vicode.editor.session.gestures.table_edits`).
        on_select: called with the id of the current row.
        on_malformed: called with the reason when the browser sent a malformed event, which is ignored.
    """

    def __init__(
        self,
        on_edit: Callable[[RequestedEdit], None],
        on_select: Callable[[str], None],
        on_malformed: Callable[[str], None],
    ) -> None:
        super().__init__()
        self._on_edit, self._on_select, self._on_malformed = on_edit, on_select, on_malformed
        self._table: dict[str, Any] = {"rows": [], "states": [], "uses": []}
        self._selected: list[str] = []
        self._is_mounted = False
        self._is_focus_pending = False
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("event", self._on_event)
        self.on("ready", self._on_ready)

    def load(self, table: Mapping[str, Any]) -> None:
        self._table = dict(table)
        self._call("load", self._table)

    def apply(self, table: Mapping[str, Any], changes: Mapping[str, Any]) -> None:
        """Show `table`, which differs from the current one by `changes`."""
        self._table = dict(table)
        self._call("apply", dict(changes))

    def select(self, rows: Iterable[str]) -> None:
        """Set the selected rows and scroll to the first of them."""
        selected = list(rows)
        if selected == self._selected:
            # The browser may already have a newer selection: do not echo the one that it reported.
            return
        self._selected = selected
        self._call("select", self._selected)

    def edit_cell(self, row: str, column: str) -> None:
        self._call("editCell", row, column)

    def show_error(self, edit: SetCell, message: str) -> None:
        """Show why an edit was refused; the cell is opened again with the typed text."""
        self._call("showError", {"row": edit.row, "column": edit.column, "value": edit.value}, message)

    def focus_grid(self) -> None:
        self._is_focus_pending = not self._is_mounted
        self._call("focusGrid")

    def _call(self, method: str, *arguments: object) -> None:
        # A call before mounting would be lost; `_on_ready` sends everything.
        if self._is_mounted:
            self.run_method("call", method, *arguments)

    def _on_event(self, event: GenericEventArguments) -> None:
        try:
            decoded = decode_event(event.args, TABLE_EVENTS)
        except MalformedEventError as error:
            self._on_malformed(str(error))
            return
        if isinstance(decoded, SelectRow):
            self._selected = [decoded.row]
            self._on_select(decoded.row)
        else:
            self._on_edit(decoded)

    def _on_ready(self) -> None:
        self._is_mounted = True
        self._call("load", self._table)
        self._call("select", self._selected)
        if self._is_focus_pending:
            self.focus_grid()
