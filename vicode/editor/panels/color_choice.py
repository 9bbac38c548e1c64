"""Buttons that set the color of states."""

from collections.abc import Callable, Collection
from functools import partial

from nicegui import ui

from vicode.editor.panels.window_context import WindowContext
from vicode.model.design import STATE_COLORS
from vicode.model.edits import set_color


def color_choice(context: WindowContext, list_names: Callable[[], Collection[str]]) -> Callable[[], None]:
    """Build the buttons for the states with these names; return a function that shows the current color."""

    def choose(color: str) -> None:
        names = frozenset(list_names())
        context.edit(
            f"color {'a state' if len(names) == 1 else f'{len(names)} states'}",
            lambda design: set_color(design, names, color),
        )

    def show() -> None:
        names = list_names()
        used = {state.color for state in context.design.states if state.name in names}
        for color, button in buttons.items():
            pressed = str(used == {color}).lower()
            if button.props.get("aria-pressed") != pressed:
                button.props["aria-pressed"] = pressed
                button.update()

    with ui.element("div").classes("swatches").props('role=group aria-label="Color"'):
        ui.label("Color").classes("swatches-label")
        buttons = {color: _swatch(color or "none", partial(choose, color)) for color in ("", *STATE_COLORS)}
    show()
    return show


def _swatch(color: str, choose: Callable[[], None]) -> ui.element:
    button = ui.element("button").classes(f"swatch is-{color}").props("type=button")
    button.props["aria-label"] = f"Color {color}"
    button.on("click", choose)
    with button:
        ui.tooltip(color)
    return button
