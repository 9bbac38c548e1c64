"""The design as a table: a grid, and a toolbar with the commands of its keys."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.texts import invalid_event
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.gestures.edits import RequestedEdit, apply_edit
from vicode.editor.session.gestures.table_edits import AddState, AddTransition, MoveRow, RemoveRow, SetCell
from vicode.editor.table import TableGrid
from vicode.editor.view import TableData, diff_tables, item_row_id, make_table, parse_row_id

_BUTTONS: tuple[tuple[str, str, Callable[[str], RequestedEdit]], ...] = (
    ("arrow_upward", "Move up (Alt+Up)", lambda row: MoveRow(row=row, by=-1)),
    ("arrow_downward", "Move down (Alt+Down)", lambda row: MoveRow(row=row, by=1)),
    ("delete", "Remove (Ctrl+Delete)", lambda row: RemoveRow(row=row)),
)


class TablePanel:
    """Builds the table; `refresh` shows changes of the design and the selection."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        with ui.row().classes("table-bar").props('role="toolbar" aria-label="Table"'):
            self._adder("State", self._add_state, "New state (Ctrl+Shift+Enter)")
            add_transition = self._on_selected(lambda row: AddTransition(row=row))
            self._adder("Transition", add_transition, "New transition from this state (Ctrl+Enter)")
            for icon, label, make_edit in _BUTTONS:
                icon_button(icon, label, self._on_selected(make_edit))
        self.shown = self._table()
        with ui.element("div").classes("table-space"):
            self.grid = TableGrid(self._on_edit, self._select, self._on_malformed)
        self.grid.load(self.shown)

    def refresh(self) -> None:
        table = self._table()
        if table != self.shown:
            self.grid.apply(table, diff_tables(self.shown, table))
            self.shown = table
        self.grid.select([item_row_id(item) for item in self.context.selected])

    def _table(self) -> TableData:
        return make_table(self.context.design, self.context.document.findings)

    def _adder(self, text: str, add: Callable[[], None], tip: str) -> None:
        with ui.button(text, icon="add", on_click=add).props("flat dense no-caps"):
            ui.tooltip(tip)

    def _add_state(self) -> None:
        item = self.context.single_selection
        self._on_edit(AddState(row=item_row_id(item) if item else ""))

    def _on_selected(self, make_edit: Callable[[str], RequestedEdit]) -> Callable[[], None]:
        def run() -> None:
            item = self.context.single_selection
            if item is None:
                self.context.show_toast("Select a row first", "info")
            else:
                self._on_edit(make_edit(item_row_id(item)))

        return run

    def _select(self, row: str) -> None:
        if row in {each["id"] for each in self.shown["rows"]}:
            self.context.select(parse_row_id(row))

    def _on_malformed(self, reason: str) -> None:
        self.context.show_toast(invalid_event(reason), "warning")

    def _on_edit(self, edit: RequestedEdit) -> None:
        outcome = apply_edit(self.context.document, edit)
        if outcome.error and isinstance(edit, SetCell):
            self.grid.show_error(edit, outcome.error)
        elif outcome.error:
            self.context.show_toast(outcome.error, "warning")
        if outcome.new_selection is None:
            return
        self.context.select(*outcome.new_selection)
        if isinstance(edit, AddState | AddTransition):
            self.grid.edit_cell(item_row_id(outcome.new_selection[0]), "name")
