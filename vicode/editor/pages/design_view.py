"""The middle of the page: the design as a diagram or as a table."""

from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.pages.auto_layout import AutoLayout
from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext

if TYPE_CHECKING:
    from vicode.editor.panels.table_panel import TablePanel

_FOCUS_CANVAS = 'document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus()'


class DesignView:
    """Builds the switch and the diagram; the table is built when it is first shown."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self.table: TablePanel | None = None
        self.is_table_shown = False
        with ui.element("div").classes("view-switch").props('role="group" aria-label="Show the design as"'):
            self._buttons = {title: self._button(title) for title in ("Diagram", "Table")}
        with ui.element("div").classes("view-pane") as self._diagram_pane:
            self.canvas_controller = CanvasController(context)
            self.auto_layout = AutoLayout(context, self.canvas_controller)
        self._table_pane = ui.element("div").classes("view-pane table-view")
        self._table_pane.set_visibility(False)
        self._update_buttons()

    def commands(self) -> tuple[Command, ...]:
        return (
            *self.auto_layout.commands(),
            Command(
                "table",
                "Switch between diagram and table",
                self.toggle,
                MenuGroup.VIEW,
                icon="table_rows",
                keys=("F4",),
                while_typing=True,
            ),
        )

    def toggle(self) -> None:
        self.show(table=not self.is_table_shown)

    def show(self, *, table: bool) -> None:
        """Show the table or the diagram, and focus it."""
        self.is_table_shown = table
        self.auto_layout.discard_preview()
        self._diagram_pane.set_visibility(not table)
        self._table_pane.set_visibility(table)
        self._update_buttons()
        self.context.notify_subscribers()
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
        """Draw the changes of the design; discard a previewed layout of an older version."""
        self.auto_layout.discard_preview()
        self.canvas_controller.update()

    def refresh(self) -> None:
        """Show design and selection. The selection follows renames before other panels refresh."""
        if self.canvas_controller.design is not self.context.design:
            self.update()
        self.canvas_controller.show_selection()
        if self.table is not None and self.is_table_shown:
            self.table.refresh()

    def _button(self, title: str) -> ui.element:
        button = ui.element("button").props('type="button"').classes("view-button")
        button.on("click", lambda: self.show(table=title == "Table"))
        with button:
            ui.label(title)
            ui.tooltip(f"Show the design as a {title.lower()} (F4)")
        return button

    def _update_buttons(self) -> None:
        for title, button in self._buttons.items():
            is_pressed = (title == "Table") == self.is_table_shown
            button.props(f'aria-pressed="{str(is_pressed).lower()}"')
