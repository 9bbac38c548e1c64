"""The design as a table in one window: a bar of buttons above the grid, both doing what keys do in a cell."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.rows import icon_button
from vicode.editor.session.table_edits import Payload, apply_table_edit
from vicode.editor.table import TableGrid
from vicode.editor.view import Table, row_of, table_difference, table_of, thing_of_row

_BUTTONS = (
    ("arrow_upward", "Earlier (Alt+Up)", {"kind": "move", "by": -1}),
    ("arrow_downward", "Later (Alt+Down)", {"kind": "move", "by": 1}),
    ("delete", "Remove (Ctrl+Delete)", {"kind": "remove"}),
)


class TablePanel:
    """Builds the table; `refresh` brings it up to date after a change of the design or the selection."""

    def __init__(self, desk: Desk) -> None:
        """Build it as the design is now."""
        self.desk = desk
        with ui.row().classes("table-bar").props('role="toolbar" aria-label="Table"'):
            self._adder("State", "add-state", "New state (Ctrl+Shift+Enter)")
            self._adder("Transition", "add-transition", "New transition of this state (Ctrl+Enter)")
            for icon, label, wish in _BUTTONS:
                icon_button(icon, label, self._on_selected(wish))
        self.shown = self._table()
        with ui.element("div").classes("table-space"):
            self.grid = TableGrid(self._hear, self._select)
        self.grid.load(self.shown)

    def refresh(self) -> None:
        """Show the design and the selection as they are now."""
        table = self._table()
        if table != self.shown:
            self.grid.apply(table, table_difference(self.shown, table))
            self.shown = table
        self.grid.select([row_of(thing) for thing in self.desk.selected])

    def _table(self) -> Table:
        return table_of(self.desk.design, self.desk.document.findings)

    def _adder(self, text: str, kind: str, tip: str) -> None:
        button = ui.button(text, icon="add", on_click=self._on_selected({"kind": kind}))
        with button.props("flat dense no-caps"):
            ui.tooltip(tip)

    def _on_selected(self, wish: Payload) -> Callable[[], None]:
        def act() -> None:
            only = self.desk.only
            if only is None and wish["kind"] != "add-state":
                self.desk.say("Select a row first", "info")
                return
            self._hear({**wish, "row": row_of(only) if only else ""})

        return act

    def _select(self, row: str) -> None:
        if row in {each["id"] for each in self.shown["rows"]}:
            self.desk.select(thing_of_row(row))

    def _hear(self, payload: Payload) -> None:
        outcome = apply_table_edit(self.desk.document, payload)
        if outcome.refused:
            self.grid.refuse(payload, outcome.refused)
            if payload.get("kind") != "set":
                self.desk.say(outcome.refused, "warning")
        if outcome.select is None:
            return
        self.desk.select(*outcome.select)
        if str(payload.get("kind")).startswith("add"):
            self.grid.edit_cell(row_of(outcome.select[0]), "name")
