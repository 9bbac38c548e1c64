"""Plots of values over time with the states below; the slider and a click show a recorded iteration."""

from html import escape
from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.panels.simulation.range_input import RangeInput
from vicode.editor.view.plot import PlotSeries, add_cursor, band_labels, render_series
from vicode.runs import Simulation

_DEFAULT_CURVES = 3
_MAX_CURVES = 6
_EMIT_CLICK_FRACTION = """(event) => {
  const box = event.currentTarget.getBoundingClientRect();
  emit((event.clientX - box.left) / box.width);
}"""


class Timeline:
    """The plots, redrawn when an iteration is added or another one is shown."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shown: object = None
        self._names: tuple[str, ...] = ()
        self._drawn_length = 0
        self._series_key: object = None
        self._series = ""
        self._curves: list[PlotSeries] = []
        self._labels: list[tuple[str, float, float]] = []
        self.choice = ui.select([], value=[], multiple=True, label="Values to plot", on_change=self._draw)
        self.choice.props("dense outlined options-dense stack-label").classes("field plot-choice")
        self.slider = RangeInput("Shown iteration", low=0, high=1, step=1, value=0, on_move=self._go_to)
        self.slider.classes("plot-slider")
        with ui.element("div").classes("plot-frame") as frame:
            self.names = ui.html("", sanitize=False).classes("plot-names")
            self.drawing = ui.html("", sanitize=False)
            self.band = ui.html("", sanitize=False).classes("plot-band")
        frame.on("click", self._clicked, js_handler=_EMIT_CLICK_FRACTION)

    def refresh(self) -> None:
        simulation = self.controller.simulation
        self._update_choices(simulation)
        length, cursor = (len(simulation.recording), simulation.cursor) if simulation else (0, 0)
        shown = (id(simulation), length, cursor)
        # A long recording takes long to draw and changes little.
        is_little = self.controller.is_playing and 0 < length - self._drawn_length < length // 50
        if shown == self._shown or is_little:
            return
        self._drawn_length = length
        self._shown = shown
        self.slider.set_high(max(length, 1))
        self.slider.set_value(cursor)
        self._draw()

    def _update_choices(self, simulation: Simulation | None) -> None:
        """Offer the existing values; select those that are read or set."""
        names = simulation.recording.names if simulation else ()
        if names == self._names:
            return
        self._names = names
        kept = [name for name in self.choice.value or [] if name in names]
        own = f"{self.controller.context.design.component}."
        first = sorted(names, key=lambda name: not name.startswith(own))[:_DEFAULT_CURVES]
        self.choice.set_options(list(names), value=kept or first)

    def _draw(self) -> None:
        simulation = self.controller.simulation
        if simulation is None or not len(simulation.recording):
            self.drawing.set_content('<p class="empty">Plots appear here while the simulation runs.</p>')
            self.names.set_content("")
            self.band.set_content("")
            return
        recording = simulation.recording
        chosen = [str(name) for name in self.choice.value or []][:_MAX_CURVES]
        key = (recording, tuple(chosen))
        if key != self._series_key or not simulation.replay:
            # A long trace takes long to draw; the cursor moves without that.
            self._series_key = key
            self._curves = [PlotSeries(name=name, values=recording.column(name)) for name in chosen]
            self._series = render_series(self._curves, recording.states)
            self._labels = band_labels(recording.states)
        curves = self._curves
        self.drawing.set_content(add_cursor(self._series, curves, recording.states, simulation.cursor))
        self.names.set_content("".join(_name(curve, simulation.cursor) for curve in curves))
        labels = (
            f'<span style="left:{left:.2f}%;max-width:{width:.2f}%">{escape(name)}</span>'
            for name, left, width in self._labels
        )
        self.band.set_content("".join(labels))

    def _go_to(self, value: Any) -> None:
        simulation = self.controller.simulation
        if simulation is None or not isinstance(value, int | float):
            return
        self.controller.pause()
        simulation.go_to(round(value))

    def _clicked(self, event: GenericEventArguments) -> None:
        simulation = self.controller.simulation
        if simulation is not None and isinstance(event.args, int | float):
            self._go_to(1 + int(event.args * len(simulation.recording)))


def _name(curve: PlotSeries, cursor: int) -> str:
    value = curve.values[cursor - 1] if 0 < cursor <= len(curve.values) else float("nan")
    shown = "" if value != value else f"{value:.4g}"  # noqa: PLR0124 - nan is what differs from itself
    return f"<div><b>{escape(curve.name)}</b> {shown}</div>"
