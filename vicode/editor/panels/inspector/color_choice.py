"""Buttons that set the color of states and frames."""

from collections.abc import Callable, Collection
from functools import partial

from nicegui import ui

from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemKind, ItemRef
from vicode.model.design import STATE_COLORS
from vicode.model.diagram_edits import set_color


def color_choice(context: WindowContext, list_items: Callable[[], Collection[ItemRef]]) -> Callable[[], None]:
    """Build the buttons for these states and frames; return a function that shows the current color."""

    def choose(color: str) -> None:
        states, frames = names("states"), names("frames")
        count = len(states) + len(frames)
        what = f"{count} items" if count > 1 else "a frame" if frames else "a state"
        context.edit(f"color {what}", lambda design: set_color(design, states, frames, color))

    def names(kind: ItemKind) -> frozenset[str]:
        return frozenset(item.id for item in list_items() if item.kind == kind)

    def show() -> None:
        states, frames = names("states"), names("frames")
        used = {state.color for state in context.design.states if state.name in states}
        used |= {frame.color for frame in context.design.frames if frame.name in frames}
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
