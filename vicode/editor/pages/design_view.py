"""The middle of the page: the design as a drawing or as a table, kept in step, one of them shown."""

from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.pages.auto_layout import AutoLayout
from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext

if TYPE_CHECKING:
    from vicode.editor.panels.table_panel import TablePanel

_FOCUS_CANVAS = 'document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus()'


class DesignView:
    """Builds the switch and the drawing; the table is built when it is first shown."""

    def __init__(self, context: WindowContext) -> None:
        """Begin with the drawing."""
        self.context = context
        self.table: TablePanel | None = None
        self.is_table_shown = False
        with ui.element("div").classes("view-switch").props('role="group" aria-label="Show the design as"'):
            self._buttons = {word: self._button(word) for word in ("Drawing", "Table")}
        with ui.element("div").classes("view-pane") as self._drawing_space:
            self.canvas_controller = CanvasController(context)
            self.auto_layout = AutoLayout(context, self.canvas_controller)
        self._table_pane = ui.element("div").classes("view-pane table-view")
        self._table_pane.set_visibility(False)
        self._mark()

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of it."""
        return (
            *self.auto_layout.commands(),
            Command(
                name="table",
                label="Drawing or table",
                handler=self.toggle,
                menu_group=MenuGroup.VIEW,
                icon="table_rows",
                keys=("F4",),
                while_typing=True,
            ),
        )

    def toggle(self) -> None:
        """Show the other one."""
        self.show(table=not self.is_table_shown)

    def show(self, *, table: bool) -> None:
        """Show the table or the drawing, and let the keys work there."""
        self.is_table_shown = table
        self.auto_layout.discard_preview()
        self._drawing_space.set_visibility(not table)
        self._table_pane.set_visibility(table)
        self._mark()
        self.context.notify_listeners()
        if not table:
            ui.run_javascript(_FOCUS_CANVAS)
            return
        if self.table is None:
            from vicode.editor.panels.table_panel import TablePanel

            with self._table_pane:
                self.table = TablePanel(self.context)
        self.table.refresh()
        self.table.grid.focus_grid()

    def update(self) -> None:
        """Draw what changed in the design; a layout found for what it was is out of date."""
        self.auto_layout.discard_preview()
        self.canvas_controller.update()

    def refresh(self) -> None:
        """Show the desk as it is now; before others hear of a new name, what is selected has it."""
        if self.canvas_controller.design is not self.context.design:
            self.update()
        self.canvas_controller.show_selection()
        if self.table is not None and self.is_table_shown:
            self.table.refresh()

    def _button(self, word: str) -> ui.element:
        button = ui.element("button").props('type="button"').classes("view-button")
        button.on("click", lambda: self.show(table=word == "Table"))
        with button:
            ui.label(word)
            ui.tooltip(f"Show the design as a {word.lower()} (F4)")
        return button

    def _mark(self) -> None:
        for word, button in self._buttons.items():
            is_pressed = (word == "Table") == self.is_table_shown
            button.props(f'aria-pressed="{str(is_pressed).lower()}"')
