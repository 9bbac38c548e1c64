"""A slider for keyboard and screen readers: the browser's own."""

from collections.abc import Callable

from nicegui import ui
from nicegui.events import GenericEventArguments

_THROTTLE_S = 0.05


class RangeInput(ui.element, component="range_input.js"):
    """Shows a number in a range, and reports changes by the user.

    Args:
        label: accessible name.
        low: lowest value.
        high: highest value.
        step: distance between two values.
        value: initial value.
        on_move: called with each new value, several times per second.
    """

    def __init__(
        self, label: str, *, low: float, high: float, step: float, value: float, on_move: Callable[[float], None]
    ) -> None:
        super().__init__()
        self.value, self.enabled = value, True
        self._on_move = on_move
        self.props.update({"min": low, "max": high, "step": step, "value": value, "aria-label": label})
        self.on("moved", self._handle_moved, throttle=_THROTTLE_S)

    def set_value(self, value: float) -> None:
        """Show a value without an event."""
        if value != self.value:
            self.value = value
            self.props["value"] = value
            self.update()

    def set_high(self, high: float) -> None:
        if self.props["max"] != high:
            self.props["max"] = high
            self.update()

    def set_enabled(self, value: bool) -> None:
        self.enabled = value
        self.props["disable"] = not value
        self.update()

    def _handle_moved(self, event: GenericEventArguments) -> None:
        if isinstance(event.args, int | float):
            self.value = event.args
            self.props["value"] = event.args
            self._on_move(event.args)
