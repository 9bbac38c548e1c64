"""One simulation of an open design: a run and its recorded past, which can be viewed and continued from."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from vicode.runs.client import RunClient, RunFailedError
from vicode.runs.inputs import SimulationInput
from vicode.runs.process import start_process
from vicode.runs.recording import MAX_ITERATIONS, Recording, merge_inputs
from vicode.runs.setup import PreparedRun
from vicode.simulation import Inputs, IterationResult, Request, StopConditions
from vicode.simulation.stop_reasons import COUNT_REACHED, stop_reason

_CHUNK = 25
_QUIET_CHUNK = 500
_NOTHING = StopConditions()


class RunStatus(StrEnum):
    """The status of a simulation."""

    PAUSED = "paused"
    RUNNING = "running"
    FAILED = "failed"
    ENDED = "ended"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """Why a run cannot continue."""

    message: str
    error: Mapping[str, Any] | None = None
    prints: tuple[str, ...] = ()


@dataclass(eq=False, kw_only=True)
class Simulation:
    """Runs a prepared design. `cursor` is the number of the shown iteration, 0 before the first.

    Iterations up to the newest are recorded. Setting an input in the past discards the later iterations: the next step
    starts a new process and replays the inputs up to the cursor, which gives the same iterations because the clock is
    simulated.

    Args:
        prepared: what to run.
        cwd: the working directory of the process, the project folder.
        script: inputs to set before each iteration, if a trace provides them.
        replay: recorded iterations, or a recording, to view instead of running anything.
        live: the recording of a robot, to view instead of running anything; `follow` shows what was added.
        find_guards: evaluates the guards of a viewed iteration by its number.
        start_client: starts the program that runs the component.
    """

    prepared: PreparedRun
    cwd: Path
    script: Sequence[Inputs] = ()
    replay: Sequence[IterationResult] | Recording = ()
    live: Recording | None = None
    find_guards: Callable[[Recording, int], Mapping[str, Any]] | None = None
    on_change: Callable[[], None] = field(default=lambda: None)
    start_client: Callable[[PreparedRun, Path], Awaitable[RunClient]] = start_process
    recording: Recording = field(init=False, default_factory=Recording)
    cursor: int = field(init=False, default=0)
    status: RunStatus = field(init=False, default=RunStatus.PAUSED)
    failure: Failure | None = field(init=False, default=None)
    warning: str = field(init=False, default="")
    stop_reason: str = field(init=False, default="")
    """Why the last run stopped."""
    _guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    _viewed_guards: tuple[int, Mapping[str, Any]] | None = field(init=False, default=None)
    """The guards of a viewed iteration, by its number since the beginning."""
    _is_following: bool = field(init=False, default=True)
    _dropped: int = field(init=False, default=0)
    _client: RunClient | None = field(init=False, default=None)
    _closing: list[RunClient] = field(init=False, default_factory=list)
    _client_iterations: int = field(init=False, default=0)
    """How many iterations the process has made."""
    _initial_guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    _pending: dict[str, dict[str, Any]] = field(init=False, default_factory=dict)
    _lock: asyncio.Lock = field(init=False, default_factory=asyncio.Lock)
    _pause_requested: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        """Load the iterations of a replay; otherwise the initial inputs are the first change."""
        if isinstance(self.replay, Recording):
            self.recording = self.replay
        else:
            for iteration in self.replay:
                self.recording.add(iteration, {})
        if self.live is not None:
            self.recording, self._dropped = self.live, self.live.dropped
            self.cursor = len(self.live)
        self._pending = {} if self.is_view else _initial_inputs(self.prepared.inputs)

    @property
    def is_view(self) -> bool:
        """Whether it shows what ran elsewhere, and runs nothing."""
        return bool(self.replay) or self.live is not None

    @property
    def guards(self) -> Mapping[str, Any]:
        """The evaluated guards of the shown iteration, by decision."""
        if self.find_guards is None or not self.cursor:
            return self._guards
        number = self.cursor + self.recording.dropped
        if self._viewed_guards is None or self._viewed_guards[0] != number:
            self._viewed_guards = (number, self.find_guards(self.recording, self.cursor))
        return self._viewed_guards[1]

    @property
    def shown_iteration(self) -> IterationResult | None:
        """The shown iteration; None before the first."""
        return self.recording.iteration(self.cursor)

    @property
    def is_past(self) -> bool:
        """Whether the shown iteration is older than the newest."""
        return self.cursor < len(self.recording)

    @property
    def can_step(self) -> bool:
        if self.is_past:
            return True
        return not self.is_view and self.status is not RunStatus.ENDED and not self.recording.is_full

    @property
    def is_over(self) -> bool:
        """Whether no iterations can follow: the simulation was ended, or failed before the first iteration."""
        failed = self.status is RunStatus.FAILED and not len(self.recording)
        return failed or (self.status is RunStatus.ENDED and not self.is_past)

    @property
    def inputs(self) -> dict[str, dict[str, Any]]:
        """The inputs at the cursor, including those set for the next iteration."""
        known = self.recording.inputs_at(self.cursor)
        if not self.is_past:
            merge_inputs(known, self._pending)
        return known

    def restore_inputs(self, inputs: Inputs) -> None:
        """Use the inputs of an earlier simulation where they still exist with the same type."""
        for each in self.prepared.inputs:
            value = _accept(each, inputs.get(each.component, {}).get(each.name))
            if value is not None:
                merge_inputs(self._pending, {each.component: {each.name: value}})

    async def start(self) -> None:
        """Start the process, so that errors are reported before the first step."""
        async with self._lock:
            await self._catch_failure(self._evaluate_guards)
            self._initial_guards = self._guards
        self._notify()

    async def step(self, count: int = 1, stops: StopConditions = _NOTHING) -> str:
        """Step forward, through the recorded past and beyond; returns why it stopped, or "" on failure."""
        async with self._lock:
            self._pause_requested = False
            reason = await self._catch_failure(lambda: self._forward(count, stops))
        self.stop_reason = reason or ""
        self._notify()
        return self.stop_reason

    def pause(self) -> None:
        """Stop a run as soon as possible."""
        self._pause_requested = True

    def follow(self) -> None:
        """Show the newest iteration of a live recording, unless the user looks at an earlier one."""
        moved, self._dropped = self.recording.dropped - self._dropped, self.recording.dropped
        self.cursor = len(self.recording) if self._is_following else max(1, self.cursor - moved)
        self._notify()

    def step_back(self, count: int = 1) -> None:
        self.go_to(self.cursor - count)

    def go_to(self, number: int) -> None:
        self.cursor = min(max(0, number), len(self.recording))
        self._is_following = not self.is_past
        if self.find_guards is None:
            self._guards = iteration.guards if (iteration := self.shown_iteration) else self._initial_guards
        self.stop_reason = ""
        self._notify()

    def truncate(self) -> None:
        """Discard the iterations after the shown one and continue from there."""
        if not self.is_past or self.is_view:
            return
        after = self.recording.changes_before(self.cursor + 1)
        self.recording.truncate(self.cursor)
        # The form already shows the inputs of the next iteration.
        self._pending = {component: dict(values) for component, values in after.items()}
        self._close_client()
        self._clear_failure()

    async def set_input(self, key: tuple[str, str], value: Any) -> bool:
        """Set an input for the next iteration; false if it does not exist or the value has the wrong type."""
        known = next((each for each in self.prepared.inputs if each.key == key), None)
        if known is None or self.status is RunStatus.ENDED or self.is_view:
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
        """Kill the process; the recorded past remains."""
        self._pause_requested = True
        self._close_client()
        self.status = RunStatus.ENDED

    async def wait_closed(self) -> None:
        """Wait until killed processes are cleaned up."""
        while self._closing:
            await self._closing.pop().wait_closed()

    def _clear_failure(self) -> None:
        """Clear a failure: with other inputs, the run may succeed."""
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
            await self._synchronize_client()
            made = len(self.recording)
            reason = await self._run_chunk(min(left, _CHUNK, MAX_ITERATIONS - made), stops)
            left -= len(self.recording) - made
            self._notify()
        return "pause" if self._pause_requested and left else reason

    def is_done_at(self, number: int) -> bool:
        """Whether the component was in a final state after an iteration."""
        iteration = self.recording.iteration(number)
        return iteration is not None and iteration.done

    def _end_reason(self) -> str:
        if self.recording.is_full:
            self.warning = f"The recording is full ({MAX_ITERATIONS} iterations); restart to continue."
        return "end"

    async def _run_chunk(self, count: int, stops: StopConditions) -> str:
        assert self._client is not None
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
            rested = await self._client.run(request, lambda iteration: self._add_iteration(iteration, waiting))
        except RunFailedError:
            # Inputs that no iteration has used yet are pending.
            self._pending = waiting.pop() if waiting else {}
            raise
        self.status = RunStatus.PAUSED
        return rested.reason

    def _add_iteration(self, iteration: IterationResult, waiting: list[dict[str, dict[str, Any]]]) -> None:
        self.recording.add(iteration, waiting.pop() if waiting else {})
        self._client_iterations = self.cursor = len(self.recording)
        self._guards = iteration.guards

    async def _synchronize_client(self) -> None:
        """Ensure a process that has made all recorded iterations, starting and replaying if needed."""
        if self._client is not None and self._client_iterations == len(self.recording):
            return
        self._close_client()
        await self.wait_closed()
        client = await self.start_client(self.prepared, self.cwd)
        if self.status is RunStatus.ENDED:
            # The simulation was ended while the process started.
            client.close()
            raise RunFailedError("The simulation was stopped.")
        self._client = client
        latest: list[IterationResult] = []
        for changes, count in self.recording.input_segments(len(self.recording)):
            inputs = changes
            for begin in range(0, count, _QUIET_CHUNK):
                request = Request(
                    kind="run", inputs=inputs, count=min(_QUIET_CHUNK, count - begin), suppress_events=True
                )
                await self._client.run(request, latest.append)
                inputs = {}
        self._client_iterations = len(self.recording)
        if latest and latest[-1] != self.recording.iteration(self._client_iterations):
            self.warning = (
                "The replay gave a different result: the code depends on real time or on unseeded random numbers."
            )

    async def _evaluate_guards(self) -> None:
        await self._synchronize_client()
        assert self._client is not None
        self._guards = (await self._client.evaluate_guards(self._pending)).guards

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
        self._close_client()
        return None

    def _close_client(self) -> None:
        if self._client is not None:
            self._client.close()
            self._closing.append(self._client)
        self._client, self._client_iterations = None, 0

    def _notify(self) -> None:
        self.on_change()


def _initial_inputs(inputs: Sequence[SimulationInput]) -> dict[str, dict[str, Any]]:
    first: dict[str, dict[str, Any]] = {}
    for each in inputs:
        value = {"value": each.initial, "table": []} if each.arguments is not None else each.initial
        first.setdefault(each.component, {})[each.name] = value
    return first


def _accept(known: SimulationInput, value: Any) -> Any | None:
    """Validate a value from the browser; None if it is invalid.

    The value of a function is a mapping: `value` for all arguments, and `table` with exceptions for some arguments.
    """
    if known.arguments is None:
        return known.accept(value)
    if not isinstance(value, dict):
        return None
    table = [[row[0], known.accept(row[1])] for row in value.get("table", ()) if isinstance(row[0], dict)]
    elsewhere = known.accept(value.get("value"))
    if elsewhere is None or any(row[1] is None for row in table):
        return None
    return {"value": elsewhere, "table": table}
