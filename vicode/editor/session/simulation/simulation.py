"""One simulation of an open design: a run that goes on, and its past that can be looked at and continued from."""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from vicode.editor.session.simulation.inputs import SimulationInput
from vicode.editor.session.simulation.process import RunFailedError, RunProcess, start_process
from vicode.editor.session.simulation.recording import MAX_ITERATIONS, Recording, merge_inputs
from vicode.editor.session.simulation.setup import PreparedRun
from vicode.simulation import Inputs, IterationResult, Request, StopConditions
from vicode.simulation.stop_reasons import COUNT_REACHED, stop_reason

_CHUNK = 25
_QUIET_CHUNK = 500
_NOTHING = StopConditions()


class RunStatus(StrEnum):
    """What a simulation is doing."""

    PAUSED = "paused"
    RUNNING = "running"
    FAILED = "failed"
    ENDED = "ended"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """Why it cannot go on."""

    message: str
    error: Mapping[str, Any] | None = None
    prints: tuple[str, ...] = ()


@dataclass(eq=False, kw_only=True)
class Simulation:
    """Runs a stage; `cursor` is the number of the moment that is shown, 0 before the first.

    Moments behind the cursor are the recorded past. Setting an input there forgets what came after: the next step
    begins a new process and repeats the way up to the cursor with the same inputs, which gives the same moments as
    the clock is simulated.

    Args:
        stage: what to run.
        cwd: where the process begins, the project's folder.
        script: inputs to set before each iteration, if a trace gives them.
        replay: moments to look at instead of running anything.
    """

    prepared: PreparedRun
    cwd: Path
    script: Sequence[Inputs] = ()
    replay: Sequence[IterationResult] = ()
    on_change: Callable[[], None] = field(default=lambda: None)
    recording: Recording = field(init=False, default_factory=Recording)
    cursor: int = field(init=False, default=0)
    status: RunStatus = field(init=False, default=RunStatus.PAUSED)
    failure: Failure | None = field(init=False, default=None)
    warning: str = field(init=False, default="")
    guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    stop_reason: str = field(init=False, default="")
    """Why it last came to rest."""
    _process: RunProcess | None = field(init=False, default=None)
    _closing: list[RunProcess] = field(init=False, default_factory=list)
    _process_iterations: int = field(init=False, default=0)
    """How many iterations the process has made."""
    _initial_guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    _pending: dict[str, dict[str, Any]] = field(init=False, default_factory=dict)
    _lock: asyncio.Lock = field(init=False, default_factory=asyncio.Lock)
    _pause_requested: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        """Take the moments of a replay; else the first values of all inputs are the first change."""
        for moment in self.replay:
            self.recording.add(moment, {})
        self._pending = {} if self.replay else _initial_inputs(self.prepared.inputs)

    @property
    def shown_iteration(self) -> IterationResult | None:
        """What is shown, None before the first iteration."""
        return self.recording.iteration(self.cursor)

    @property
    def is_past(self) -> bool:
        """Whether what is shown is behind the newest moment."""
        return self.cursor < len(self.recording)

    @property
    def can_step(self) -> bool:
        """Whether a step forward is possible."""
        if self.is_past:
            return True
        return not self.replay and self.status is not RunStatus.ENDED and not self.recording.is_full

    @property
    def is_over(self) -> bool:
        """Whether there is nothing more to come from it: it was ended, or failed before the first moment."""
        failed = self.status is RunStatus.FAILED and not len(self.recording)
        return failed or (self.status is RunStatus.ENDED and not self.is_past)

    @property
    def time_s(self) -> float:
        """The simulated time of what is shown."""
        return self.recording.times_ns[self.cursor - 1] / 1e9 if self.cursor else 0.0

    @property
    def inputs(self) -> dict[str, dict[str, Any]]:
        """All inputs as they are at the cursor, with those that the next iteration will see."""
        known = self.recording.inputs_at(self.cursor)
        if not self.is_past:
            merge_inputs(known, self._pending)
        return known

    def restore_inputs(self, inputs: Inputs) -> None:
        """Begin with inputs of an earlier simulation, as far as they are still what they were."""
        for each in self.prepared.inputs:
            value = _accept(each, inputs.get(each.component, {}).get(each.name))
            if value is not None:
                merge_inputs(self._pending, {each.component: {each.name: value}})

    async def start(self) -> None:
        """Start the process, so that mistakes are told before the first step."""
        async with self._lock:
            await self._catch_failure(self._evaluate_guards)
            self._initial_guards = self.guards
        self._notify()

    async def step(self, count: int = 1, stops: StopConditions = _NOTHING) -> str:
        """Go forward, through the recorded past and on; returns why it rested, "" if it could not go on."""
        async with self._lock:
            self._pause_requested = False
            reason = await self._catch_failure(lambda: self._forward(count, stops))
        self.stop_reason = reason or ""
        self._notify()
        return self.stop_reason

    def pause(self) -> None:
        """Let a run come to rest as soon as it can."""
        self._pause_requested = True

    def step_back(self, count: int = 1) -> None:
        """Show an earlier moment."""
        self.go_to(self.cursor - count)

    def go_to(self, number: int) -> None:
        """Show a recorded moment."""
        self.cursor = min(max(0, number), len(self.recording))
        self.guards = moment.guards if (moment := self.shown_iteration) else self._initial_guards
        self.stop_reason = ""
        self._notify()

    def truncate(self) -> None:
        """Forget what comes after the moment that is shown, to go on from there."""
        if not self.is_past or self.replay:
            return
        after = self.recording.changes_before(self.cursor + 1)
        self.recording.truncate(self.cursor)
        # What was set before the next iteration stands in the form already.
        self._pending = {component: dict(values) for component, values in after.items()}
        self._kill_process()
        self._clear_failure()

    async def set_input(self, key: tuple[str, str], value: Any) -> bool:
        """Set an input for the next iteration; false if there is no such input or the value is none of its type."""
        known = next((each for each in self.prepared.inputs if each.key == key), None)
        if known is None or self.status is RunStatus.ENDED or self.replay:
            return False
        accepted = _accept(known, value)
        if accepted is None:
            return False
        self.truncate()
        self._clear_failure()
        merge_inputs(self._pending, {key[0]: {key[1]: accepted}})
        if not self._lock.locked():
            async with self._lock:
                await self._catch_failure(self._evaluate_guards)
        self._notify()
        return True

    def end(self) -> None:
        """Kill the process; the past can still be looked at."""
        self._pause_requested = True
        self._kill_process()
        self.status = RunStatus.ENDED

    async def wait_closed(self) -> None:
        """Wait until the processes that were killed have left nothing behind."""
        while self._closing:
            await self._closing.pop().wait_closed()

    def _clear_failure(self) -> None:
        """Forget a failure: with another input, or without what led to it, it may go well."""
        if self.status is RunStatus.FAILED:
            self.status, self.failure = RunStatus.PAUSED, None

    async def _forward(self, count: int, stops: StopConditions) -> str:
        left = count
        while left and self.is_past and not self._pause_requested:
            was_done = self.is_done_at(self.cursor)
            self.go_to(self.cursor + 1)
            left -= 1
            assert self.shown_iteration is not None
            reason = stop_reason(self.shown_iteration, stops, was_done=was_done)
            if reason:
                return reason
        reason = COUNT_REACHED
        while left and reason == COUNT_REACHED and not self._pause_requested:
            if not self.can_step:
                return self._end_reason()
            await self._synchronize_process()
            made = len(self.recording)
            reason = await self._run_chunk(min(left, _CHUNK, MAX_ITERATIONS - made), stops)
            left -= len(self.recording) - made
            self._notify()
        return "pause" if self._pause_requested and left else reason

    def is_done_at(self, number: int) -> bool:
        """Whether the component was in a final state in a moment."""
        moment = self.recording.iteration(number)
        return moment is not None and moment.done

    def _end_reason(self) -> str:
        if self.recording.is_full:
            self.warning = f"The recording is full ({MAX_ITERATIONS} iterations); start again to go on."
        return "end"

    async def _run_chunk(self, count: int, stops: StopConditions) -> str:
        assert self._process is not None
        self.status = RunStatus.RUNNING
        changes, self._pending = self._pending, {}
        at = len(self.recording)
        if at < len(self.script):
            changes = {component: dict(values) for component, values in changes.items()}
            merge_inputs(changes, self.script[at])
            count = 1
        waiting = [changes]
        request = Request(kind="run", inputs=changes, count=count, stops=stops)
        try:
            rested = await self._process.run(request, lambda moment: self._add_iteration(moment, waiting))
        except RunFailedError:
            # Inputs that no moment has seen are still to come.
            self._pending = waiting.pop() if waiting else {}
            raise
        self.status = RunStatus.PAUSED
        return rested.reason

    def _add_iteration(self, moment: IterationResult, waiting: list[dict[str, dict[str, Any]]]) -> None:
        self.recording.add(moment, waiting.pop() if waiting else {})
        self._process_iterations = self.cursor = len(self.recording)
        self.guards = moment.guards

    async def _synchronize_process(self) -> None:
        """Have a process that has made all recorded iterations: if there is none, a new one repeats them."""
        if self._process is not None and self._process_iterations == len(self.recording):
            return
        self._kill_process()
        await self.wait_closed()
        runner = await start_process(self.prepared, self.cwd)
        if self.status is RunStatus.ENDED:
            # It was ended while it began.
            runner.kill()
            raise RunFailedError("The simulation was ended.")
        self._process = runner
        latest: list[IterationResult] = []
        for changes, count in self.recording.input_segments(len(self.recording)):
            inputs = changes
            for begin in range(0, count, _QUIET_CHUNK):
                request = Request(
                    kind="run", inputs=inputs, count=min(_QUIET_CHUNK, count - begin), suppress_events=True
                )
                await self._process.run(request, latest.append)
                inputs = {}
        self._process_iterations = len(self.recording)
        if latest and latest[-1] != self.recording.iteration(self._process_iterations):
            self.warning = (
                "Repeating the past gave something else: the code reads the real time, or noise without a seed."
            )

    async def _evaluate_guards(self) -> None:
        """Test the guards with the inputs as they are now."""
        await self._synchronize_process()
        assert self._process is not None
        self.guards = (await self._process.evaluate_guards(self._pending)).guards

    async def _catch_failure(self, do: Callable[[], Any]) -> Any:
        try:
            return await do()
        except RunFailedError as error:
            if self.status is not RunStatus.ENDED:
                self.status = RunStatus.FAILED
                self.failure = Failure(message=error.message, error=error.error, prints=error.prints)
        except OSError as error:
            self.status = RunStatus.FAILED
            self.failure = Failure(message=f"The simulation could not be started: {error}")
        self._kill_process()
        return None

    def _kill_process(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._closing.append(self._process)
        self._process, self._process_iterations = None, 0

    def _notify(self) -> None:
        self.on_change()


def _initial_inputs(inputs: Sequence[SimulationInput]) -> dict[str, dict[str, Any]]:
    first: dict[str, dict[str, Any]] = {}
    for each in inputs:
        value = {"value": each.initial, "table": []} if each.arguments is not None else each.initial
        first.setdefault(each.component, {})[each.name] = value
    return first


def _accept(known: SimulationInput, value: Any) -> Any | None:
    """A value, or for a function one for all arguments and a table of others."""
    if known.arguments is None:
        return known.accept(value)
    if not isinstance(value, dict):
        return None
    table = [[row[0], known.accept(row[1])] for row in value.get("table", ()) if isinstance(row[0], dict)]
    elsewhere = known.accept(value.get("value"))
    if elsewhere is None or any(row[1] is None for row in table):
        return None
    return {"value": elsewhere, "table": table}
