"""The middle of the page: the design as a drawing or as a table, kept in step, one of them shown."""

from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.pages.drawing import Drawing
from vicode.editor.pages.layouts import Layouts
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk

if TYPE_CHECKING:
    from vicode.editor.panels.table_panel import TablePanel

_FOCUS_CANVAS = 'document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus()'


class Stage:
    """Builds the switch and the drawing; the table is built when it is first shown."""

    def __init__(self, desk: Desk) -> None:
        """Begin with the drawing."""
        self.desk = desk
        self.table: TablePanel | None = None
        self.shows_table = False
        with ui.element("div").classes("view-switch").props('role="group" aria-label="Show the design as"'):
            self._buttons = {word: self._button(word) for word in ("Drawing", "Table")}
        with ui.element("div").classes("stage-view") as self._drawing_space:
            self.drawing = Drawing(desk)
            self.layouts = Layouts(desk, self.drawing)
        self._table_space = ui.element("div").classes("stage-view table-view")
        self._table_space.set_visibility(False)
        self._mark()

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of it."""
        return (
            *self.layouts.commands(),
            Command(
                name="table",
                label="Drawing or table",
                act=self.toggle,
                place=Place.VIEW,
                icon="table_rows",
                keys=("F4",),
                while_typing=True,
            ),
        )

    def toggle(self) -> None:
        """Show the other one."""
        self.show(table=not self.shows_table)

    def show(self, *, table: bool) -> None:
        """Show the table or the drawing, and let the keys work there."""
        self.shows_table = table
        self.layouts.drop()
        self._drawing_space.set_visibility(not table)
        self._table_space.set_visibility(table)
        self._mark()
        self.desk.tell()
        if not table:
            ui.run_javascript(_FOCUS_CANVAS)
            return
        if self.table is None:
            from vicode.editor.panels.table_panel import TablePanel

            with self._table_space:
                self.table = TablePanel(self.desk)
        self.table.refresh()
        self.table.grid.take_focus()

    def follow(self) -> None:
        """Draw what changed in the design; a layout found for what it was is out of date."""
        self.layouts.drop()
        self.drawing.follow()

    def refresh(self) -> None:
        """Show the desk as it is now; before others hear of a new name, what is selected has it."""
        if self.drawing.design is not self.desk.design:
            self.follow()
        self.drawing.show_selection()
        if self.table is not None and self.shows_table:
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
            is_pressed = (word == "Table") == self.shows_table
            button.props(f'aria-pressed="{str(is_pressed).lower()}"')
