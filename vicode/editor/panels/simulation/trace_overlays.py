"""Overlays of a viewed trace: the heat map on the canvas, and the first difference from another trace."""

from nicegui import run, ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.session.simulation.trace_overlays import HeatMap, compare_traces, measure_heat
from vicode.runs.trace_recording import find_traces
from vicode.traces.reader import TraceError
from vicode.traces.statistics import RunDifference


class TraceOverlays:
    """Visible while a trace is viewed."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._trace: object = ()
        self._shown: object = None
        self._difference: RunDifference | None = None
        with ui.column().classes("trace-overlays") as self.body:
            self.heat = ui.checkbox("Heat map", on_change=self.refresh).props("dense size=xs")
            with self.heat:
                ui.tooltip("Color states by their share of the time, transitions by how often they were taken")
            self.choice = ui.select([], label="Compare with", clearable=True, on_change=self._compare)
            self.choice.props("dense outlined options-dense stack-label").classes("field")
            self.result = ui.label().classes("small").props('role="status"')
            self.jump = ui.button("Show the first difference", icon="compare_arrows", color=None, on_click=self._jump)
            self.jump.props("outline dense no-caps no-wrap align=left").classes("trace-pick")
        self._show_result("", None)

    def refresh(self) -> None:
        """Follow the trace that is viewed."""
        controller, simulation = self.controller, self.controller.simulation
        is_viewed = simulation is not None and bool(simulation.replay)
        self.body.set_visibility(is_viewed)
        if is_viewed and controller.trace is not self._trace:
            self._trace = controller.trace
            self.choice.set_value(None)
            controller.context.run_in_background(self._list_files(), "traces")
        recording = simulation.recording if is_viewed and simulation is not None and self.heat.value else None
        shown = (recording, controller.context.design if recording is not None else None)
        if shown != self._shown:
            self._shown = shown
            heat = measure_heat(recording, controller.context.design) if recording is not None else _NO_HEAT
            controller.canvas.show_heat(heat.colors, heat.words)

    async def _list_files(self) -> None:
        files = await run.io_bound(find_traces, self.controller.context.workspace.folder) or ()
        own = self.controller.trace_path
        folder = self.controller.context.workspace.folder
        self.choice.set_options([name for name in files if folder / name != own], value=None)
        self.choice.set_visibility(bool(self.choice.options))

    async def _compare(self) -> None:
        name, controller = self.choice.value, self.controller
        if not isinstance(name, str):
            self._show_result("", None)
            return
        own = controller.trace_path or (controller.trace if isinstance(controller.trace, tuple) else ())
        self._show_result("Comparing…", None)
        try:
            found = await run.io_bound(compare_traces, own, controller.context.workspace.folder / name)
        except (TraceError, OSError) as error:
            self._show_result(f"{name[:60]}: {error}", None)
            return
        if name == self.choice.value:
            self._show_result(_describe(found), found)

    def _show_result(self, words: str, difference: RunDifference | None) -> None:
        self._difference = difference
        self.result.set_text(words)
        self.result.set_visibility(bool(words))
        self.jump.set_visibility(difference is not None)

    def _jump(self) -> None:
        simulation = self.controller.simulation
        if simulation is None or self._difference is None or not len(simulation.recording):
            return
        self.controller.pause()
        time_ns = simulation.recording.times_ns[0] + self._difference.time_ns
        simulation.go_to(simulation.recording.number_at(time_ns) or len(simulation.recording))


_NO_HEAT = HeatMap(colors={}, words={})


def _describe(difference: RunDifference | None) -> str:
    if difference is None:
        return "Same states, up to the end of the shorter trace."
    here, there = (state or "not active" for state in (difference.first, difference.second))
    return (
        f"First difference at {difference.time_ns / 1e9:.2f} s: {difference.component} is {here} here, {there} there."
    )
