"""The design as a table: a grid, and a toolbar with the commands of its keys."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.texts import SELECT_ROW_FIRST
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.table_edits import Payload, apply_table_edit
from vicode.editor.table import TableGrid
from vicode.editor.view import TableData, diff_tables, item_row_id, make_table, parse_row_id

_BUTTONS = (
    ("arrow_upward", "Move up (Alt+Up)", {"kind": "move", "by": -1}),
    ("arrow_downward", "Move down (Alt+Down)", {"kind": "move", "by": 1}),
    ("delete", "Remove (Ctrl+Delete)", {"kind": "remove"}),
)


class TablePanel:
    """Builds the table; `refresh` shows changes of the design and the selection."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        with ui.row().classes("table-bar").props('role="toolbar" aria-label="Table"'):
            self._adder("State", "add-state", "New state (Ctrl+Shift+Enter)")
            self._adder("Transition", "add-transition", "New transition from this state (Ctrl+Enter)")
            for icon, label, edit in _BUTTONS:
                icon_button(icon, label, self._on_selected(edit))
        self.shown = self._table()
        with ui.element("div").classes("table-space"):
            self.grid = TableGrid(self._on_edit, self._select)
        self.grid.load(self.shown)

    def refresh(self) -> None:
        table = self._table()
        if table != self.shown:
            self.grid.apply(table, diff_tables(self.shown, table))
            self.shown = table
        self.grid.select([item_row_id(item) for item in self.context.selected])

    def _table(self) -> TableData:
        return make_table(self.context.design, self.context.document.findings)

    def _adder(self, text: str, kind: str, tip: str) -> None:
        button = ui.button(text, icon="add", on_click=self._on_selected({"kind": kind}))
        with button.props("flat dense no-caps"):
            ui.tooltip(tip)

    def _on_selected(self, edit: Payload) -> Callable[[], None]:
        def run() -> None:
            item = self.context.single_selection
            if item is None and edit["kind"] != "add-state":
                self.context.show_toast(SELECT_ROW_FIRST, "info")
                return
            self._on_edit({**edit, "row": item_row_id(item) if item else ""})

        return run

    def _select(self, row: str) -> None:
        if row in {each["id"] for each in self.shown["rows"]}:
            self.context.select(parse_row_id(row))

    def _on_edit(self, payload: Payload) -> None:
        outcome = apply_table_edit(self.context.document, payload)
        if outcome.error:
            self.grid.show_error(payload, outcome.error)
            if payload.get("kind") != "set":
                self.context.show_toast(outcome.error, "warning")
        if outcome.new_selection is None:
            return
        self.context.select(*outcome.new_selection)
        if str(payload.get("kind")).startswith("add"):
            self.grid.edit_cell(item_row_id(outcome.new_selection[0]), "name")
