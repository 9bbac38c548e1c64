"""The choice of a trace in the project folder, of any length."""

from collections.abc import Callable

from nicegui import run, ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.runs.trace_recording import find_traces
from vicode.traces.reader import TraceError

_PROGRESS_INTERVAL_S = 0.5


class TraceFileChoice:
    """Lists the traces when it becomes visible; `is_replay` says whether the chosen one is viewed."""

    def __init__(self, controller: SimulationController, is_replay: Callable[[], bool]) -> None:
        self.controller = controller
        self._is_replay = is_replay
        self._is_visible = False
        self.choice = ui.select([], label="Trace in the project folder", on_change=self._choose)
        self.choice.props("dense outlined options-dense stack-label").classes("field trace-file")
        self.choice.set_visibility(False)
        self.progress = ui.label().classes("small").props('role="status"')
        self.progress.set_visibility(False)
        self._part = 0.0
        self._timer = ui.timer(_PROGRESS_INTERVAL_S, self._show_progress, active=False)

    def set_visibility(self, is_visible: bool) -> None:
        if is_visible == self._is_visible:
            return
        self._is_visible = is_visible
        self.choice.set_visibility(False)
        if is_visible:
            self.controller.context.run_in_background(self._list_files(), "traces")

    async def _list_files(self) -> None:
        files = await run.io_bound(find_traces, self.controller.context.workspace.folder)
        self.choice.set_options(list(files or ()), value=None)
        self.choice.set_visibility(self._is_visible and bool(files))

    async def _choose(self) -> None:
        name = self.choice.value
        if not isinstance(name, str):
            return
        controller = self.controller
        self._set_progress(0.0)
        self._show_progress()
        self.progress.set_visibility(True)
        self._timer.activate()
        try:
            path = controller.context.workspace.folder / name
            await controller.use_trace_file(path, is_replay=self._is_replay(), on_progress=self._set_progress)
        except (TraceError, OSError) as error:
            controller.context.show_toast(f"{name[:60]}: {error}", "warning")
            return
        finally:
            self._timer.deactivate()
            self.progress.set_visibility(False)
        await controller.restart()

    def _set_progress(self, part: float) -> None:
        """Called by the thread that reads."""
        self._part = part

    def _show_progress(self) -> None:
        self.progress.set_text(f"Reading the trace… {self._part:.0%}")
