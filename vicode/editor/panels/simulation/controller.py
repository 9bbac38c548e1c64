"""The simulation of one window: starts and stops it, plays it, and shows its state on the canvas."""

import asyncio
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from nicegui import run

from vicode.editor.canvas import Canvas
from vicode.editor.panels import texts
from vicode.editor.panels.code.code_choices import ask_to_resolve_code
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.simulation.trust_dialog import ask_for_trust
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.code.code_sync import find_lacking
from vicode.editor.session.simulation import Breakpoints
from vicode.editor.view import ItemRef
from vicode.generators import UnsoundDesignError
from vicode.runs import (
    NotReadyError,
    PreparedRun,
    Recording,
    RunConfig,
    RunStatus,
    Simulation,
    behavior_key,
    prepare_run,
)
from vicode.runs.design_trace import input_script, read_iterations
from vicode.runs.guard_values import evaluate_guards, latest_steps
from vicode.runs.trace_recording import read_beginning, read_recording
from vicode.simulation import IterationResult, StopConditions
from vicode.simulation.isolation import isolation_problem
from vicode.simulation.stop_reasons import COUNT_REACHED
from vicode.traces.reader import TraceError

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 20.0)
_PLAY_INTERVAL_S = 0.04
_MAX_STEPS_PER_INTERVAL = 100
_UNLIMITED = 1_000_000
_USE_BREAKPOINT = "To stop a robot at a state, set a breakpoint on the state (F9)"


class SimulationController:
    """The simulation of one window, used by its commands and its panel."""

    def __init__(self, context: WindowContext, canvas: Canvas) -> None:
        self.context, self.canvas = context, canvas
        self.simulation: Simulation | None = None
        self.breakpoints = Breakpoints()
        self.config = RunConfig()
        self.trace: tuple[IterationResult, ...] | Recording = ()
        self.trace_path: Path | None = None
        """The file of the trace, if it is one on this machine."""
        self.is_replay = False
        self.speed = 1.0
        self.pauses_on_errors = True
        self.is_playing = False
        self.is_running = False
        """Whether a run of several steps is under way without playing."""
        self.is_starting = False
        self.is_stale = False
        self.start_error = ""
        """Why it could not be started."""
        self.sandbox_problem = ""
        """Why the code runs without a sandbox, empty if it does not or has not run yet."""
        self.revision = 0
        """Incremented when the panel must be refreshed."""
        self.refresh_panel: Callable[[], None] = lambda: None
        """Refreshes the panel immediately, if it exists."""
        self._behavior_key: object = None
        self._seen_project: object = None
        self._starting = asyncio.Lock()
        self._is_closed = False
        self._seq = 0
        canvas.on_inside = self._show_active
        context.disconnects.subscribe(self.pause)
        context.closings.subscribe(self.close)
        self.robot = RobotView(self)

    async def restart(self) -> None:
        if self.robot.is_shown:
            return
        self.pause()
        async with self._starting:
            await self._start()

    async def step(self) -> None:
        if self._asks_robot:
            self.robot.ask("step")
            return
        await self._run(1, StopConditions())

    async def step_to_change(self) -> None:
        """Run until the state changes, a breakpoint is hit, or the recording is full."""
        if self.robot.is_shown:
            self.context.show_toast(_USE_BREAKPOINT, "info")
            return
        await self._run(_UNLIMITED, self._stop_conditions(changes=True))

    async def run_to(self, state: str) -> None:
        if self.robot.is_shown:
            self.context.show_toast(_USE_BREAKPOINT, "info")
            return
        await self._run(_UNLIMITED, self._stop_conditions(also=state))

    async def run_to_time(self, seconds: float) -> None:
        """Show the recorded iteration at this time, or run until this time."""
        if not await self._ensure_started():
            return
        simulation = self._current
        recording, time_ns = simulation.recording, round(seconds * 1e9)
        number = recording.number_at(time_ns)
        if number is not None or simulation.is_view:
            simulation.go_to(number or len(recording))
            return
        newest_ns = recording.times_ns[-1] if len(recording) else -simulation.prepared.setup.tick_ns
        missing = -(-(time_ns - newest_ns) // simulation.prepared.setup.tick_ns)
        await self._run(len(recording) - simulation.cursor + missing, self._stop_conditions())

    def step_back(self) -> None:
        self.pause()
        if self.simulation is not None:
            self.simulation.step_back()
        self.refresh_panel()

    def toggle_play(self) -> None:
        if self.robot.is_shown:
            self.robot.toggle_pause()
            return
        if self.is_playing or self.is_running:
            self.pause()
            return
        self.is_playing = True
        self.context.run_in_background(self._play(), "simulation")
        self._notify()

    def pause(self) -> None:
        self.is_playing = False
        if self.simulation is not None:
            self.simulation.pause()
        self._notify()

    def set_config(self, config: RunConfig) -> None:
        self.config = config
        self.is_stale = self.simulation is not None
        self._notify()

    def use_trace(self, text: str, *, is_replay: bool) -> None:
        """Use a recorded trace, to view it or as inputs.

        Raises:
            TraceError: It is not a trace of this design.
        """
        self.trace, self.is_replay = read_iterations(text, self.context.design), is_replay
        self.trace_path = None
        self.is_stale = self.simulation is not None
        self._notify()

    async def use_trace_file(self, path: Path, *, is_replay: bool, on_progress: Callable[[float], None]) -> None:
        """Use a trace on this machine, of any length, to view it or its beginning as inputs.

        Raises:
            TraceError: It is not a trace of this design.
            OSError: It cannot be read.
        """
        design = self.context.design
        if is_replay:
            self.trace = await run.io_bound(read_recording, path, design, on_progress) or ()
        else:
            self.trace = await run.io_bound(read_beginning, path, design) or ()
        self.trace_path, self.is_replay = path, is_replay
        self.is_stale = self.simulation is not None
        self._notify()

    def clear_trace(self) -> None:
        """Return to manual inputs."""
        self.trace, self.trace_path, self.is_replay = (), None, False
        self.is_stale = self.simulation is not None
        self._notify()

    def toggle_breakpoints(self, *items: ItemRef) -> None:
        self.set_breakpoints(self.breakpoints.toggled(self.context.design, *items))
        self.robot.tell_breakpoints()

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Replace the breakpoints of the window, without telling the robot."""
        self.breakpoints = breakpoints
        self._show_breakpoints()
        self._notify()

    def check_project(self) -> None:
        """Detect changes of designs that this one uses."""
        if self._seen_project is not self.context.workspace.project:
            self._seen_project = self.context.workspace.project
            self.check_design()

    def check_design(self) -> None:
        """Stop the run if the design changed; the recorded past remains."""
        kept = self.breakpoints.existing_in(self.context.design)
        if kept != self.breakpoints:
            self.breakpoints = kept
            self._show_breakpoints()
            self.robot.tell_breakpoints()
        simulation = self.simulation
        if self.robot.is_shown:
            if simulation is None or simulation.prepared.design is not self.context.design:
                self.robot.design_changed()
            return
        if simulation is None or simulation.status is RunStatus.ENDED:
            return
        if behavior_key(self.context.workspace.project, self.context.design) != self._behavior_key:
            self.is_playing = False
            simulation.end()
            self.is_stale = True
            self._notify()

    def close(self) -> None:
        """Stop the simulation when the window closes."""
        self._is_closed = True
        self.is_playing = False
        self._discard_simulation()

    def stop(self) -> None:
        self.is_playing = False
        self._discard_simulation()
        self.is_stale = False
        self._notify()

    def show_simulation(self, simulation: Simulation | None) -> None:
        """Show a simulation that runs elsewhere, or none."""
        if simulation is not None or self.simulation is not None:
            self._discard_simulation()
            self.simulation = simulation
            self.is_stale, self.start_error = False, ""
        self._notify()

    def simulation_changed(self) -> None:
        """Show the simulation again."""
        self._notify()

    @property
    def _asks_robot(self) -> bool:
        """Whether a step is one of the robot, and not one through its recorded past."""
        return self.robot.is_shown and (self.simulation is None or not self.simulation.is_past)

    @property
    def _current(self) -> Simulation:
        assert self.simulation is not None
        return self.simulation

    def _stop_conditions(self, *, changes: bool = False, also: str = "") -> StopConditions:
        return self.breakpoints.stop_conditions(changes=changes, errors=self.pauses_on_errors, extra_state=also)

    async def _start(self) -> bool:
        self.is_starting = True
        self._notify()
        try:
            return await self._create_simulation()
        finally:
            self.is_starting = False
            self._notify()

    async def _create_simulation(self) -> bool:
        inputs = self.simulation.inputs if self.simulation and not self.simulation.is_view else {}
        self._discard_simulation()
        self.start_error, self.is_stale = "", False
        prepared = await self._prepare() if await self._may_run() and self._has_all_edits() else None
        if prepared is not None and not self._is_closed:
            self._behavior_key = behavior_key(self.context.workspace.project, prepared.design)
            self.breakpoints = self.breakpoints.existing_in(prepared.design)
            self.simulation = simulation = Simulation(
                prepared=prepared,
                cwd=self.context.workspace.folder,
                script=input_script(self.trace, prepared.inputs)
                if isinstance(self.trace, tuple) and not self.is_replay
                else (),
                replay=self.trace if self.is_replay else (),
                find_guards=self._find_guards if self.is_replay else None,
                on_change=self._notify,
            )
            simulation.restore_inputs(inputs)
            if not simulation.is_view:
                await simulation.start()
        return self.simulation is not None and self.simulation.failure is None

    async def _may_run(self) -> bool:
        is_allowed = self.is_replay or await ask_for_trust(self.context)
        self.start_error = (
            "" if is_allowed else "The folder is not trusted, so its code does not run. Restart to be asked again."
        )
        self.sandbox_problem = "" if self.is_replay else await run.io_bound(isolation_problem) or ""
        return is_allowed

    def _has_all_edits(self) -> bool:
        """Apply edits of the generated code; where some cannot be applied, ask the user and return False."""
        if self.is_replay:
            return True
        lacking = find_lacking(self.context.workspace, self.context.design.component)
        if lacking:
            outside = lacking[0].shared.outside
            problem = outside.problems[0].message if outside.problems else ""
            file = outside.edited_outside[0].path if outside.edited_outside else ""
            self.start_error = texts.edits_before_simulation(len(outside.waiting), problem, file)
            with self.context.client:
                ask_to_resolve_code(self.context, lacking)
        return not lacking

    def _find_guards(self, recording: Recording, number: int) -> dict[str, dict[str, Any]]:
        """Evaluate the guards of an iteration of a trace with its values."""
        iteration, design = recording.iteration(number), self._current.prepared.design
        if iteration is None:
            return {}
        steps = latest_steps(recording, number, frozenset(use.component for use in design.uses))
        return evaluate_guards(self.context.workspace.project, design, iteration, steps)

    def _discard_simulation(self) -> None:
        if self.simulation is not None:
            self.simulation.on_change = lambda: None
            self.simulation.end()
        self.simulation = None

    async def _ensure_started(self) -> bool:
        """Start a simulation of the current design unless one exists; returns whether it can be stepped."""
        async with self._starting:
            simulation = self.simulation
            if simulation is None or simulation.is_over:
                return await self._start()
            return True

    async def _run(self, count: int, stops: StopConditions) -> None:
        if self.is_playing:
            self.pause()
        self.is_running = count > 1
        try:
            if await self._ensure_started():
                await self._current.step(count, stops)
        finally:
            self.is_running = False
        self._notify()
        self.refresh_panel()

    async def _play(self) -> None:
        """Step in real time, times the speed, until a reason to stop."""
        reason = COUNT_REACHED if await self._ensure_started() else ""
        last, due = time.monotonic(), 1.0
        while self.is_playing and reason == COUNT_REACHED and self.simulation is not None:
            now = time.monotonic()
            due += (now - last) * 1e9 * self.speed / self._current.prepared.setup.tick_ns
            last = now
            # A slow machine does not catch up on missed steps.
            due, count = due % 1, min(int(due), _MAX_STEPS_PER_INTERVAL)
            if count:
                reason = await self._current.step(count, self._stop_conditions())
            await asyncio.sleep(_PLAY_INTERVAL_S)
        self.is_playing = False
        self._notify()

    async def _prepare(self) -> PreparedRun | None:
        workspace, design, config = self.context.workspace, self.context.design, self.config
        try:
            return await run.io_bound(
                prepare_run, workspace.project, design, config, workspace.source_paths, workspace.folder
            )
        except (NotReadyError, UnsoundDesignError, TraceError) as error:
            self.start_error = str(error)
            return None

    def _notify(self) -> None:
        self.revision += 1
        self._show_active()

    def _show_active(self) -> None:
        """Highlight the active state and the transition that led there."""
        active: list[str] = []
        taken: list[str] = []
        simulation = self.simulation
        if simulation is not None and simulation.cursor:
            state = simulation.recording.states[simulation.cursor - 1]
            active = [state] if state else []
            latest = simulation.recording.latest_transition(simulation.cursor)
            taken = [latest] if latest and simulation.status is not RunStatus.ENDED else []
        self._seq += 1
        self.canvas.highlight_active(active, self._seq, taken, self._inner_states() if active else {})

    def _inner_states(self) -> dict[str, str]:
        """The active states of all stepped components, if the canvas shows any of them."""
        iteration = self._current.shown_iteration if self.canvas.shows_inside else None
        steps = iteration.tree if iteration else []
        return {str(step["component"]): str(step["state"]) for step in steps if step.get("state")}

    def _show_breakpoints(self) -> None:
        self.canvas.set_breakpoints(sorted(self.breakpoints.items, key=_order))


def _order(item: ItemRef) -> tuple[str, str]:
    return (item.kind, item.id)
