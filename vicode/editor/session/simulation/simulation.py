"""One simulation of an open design: a run that goes on, and its past that can be looked at and continued from."""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from vicode.editor.session.simulation.inputs import Input
from vicode.editor.session.simulation.process import RunFailedError, Runner, start_runner
from vicode.editor.session.simulation.recording import MOST_MOMENTS, Recording, merge_inputs
from vicode.editor.session.simulation.setup import Stage
from vicode.simulation import Inputs, Moment, Request, Stops
from vicode.simulation.resting import COUNT, reason_to_rest

_CHUNK = 25
_QUIET_CHUNK = 500
_NOTHING = Stops()


class Phase(StrEnum):
    """What a simulation is doing."""

    RESTING = "resting"
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

    stage: Stage
    cwd: Path
    script: Sequence[Inputs] = ()
    replay: Sequence[Moment] = ()
    on_change: Callable[[], None] = field(default=lambda: None)
    recording: Recording = field(init=False, default_factory=Recording)
    cursor: int = field(init=False, default=0)
    phase: Phase = field(init=False, default=Phase.RESTING)
    failure: Failure | None = field(init=False, default=None)
    note: str = field(init=False, default="")
    guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    rested: str = field(init=False, default="")
    """Why it last came to rest."""
    _runner: Runner | None = field(init=False, default=None)
    _leaving: list[Runner] = field(init=False, default_factory=list)
    _done: int = field(init=False, default=0)
    """How many iterations the process has made."""
    _first_guards: Mapping[str, Any] = field(init=False, default_factory=dict)
    _pending: dict[str, dict[str, Any]] = field(init=False, default_factory=dict)
    _busy: asyncio.Lock = field(init=False, default_factory=asyncio.Lock)
    _wants_pause: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        """Take the moments of a replay; else the first values of all inputs are the first change."""
        for moment in self.replay:
            self.recording.add(moment, {})
        self._pending = {} if self.replay else _first_inputs(self.stage.inputs)

    @property
    def moment(self) -> Moment | None:
        """What is shown, None before the first iteration."""
        return self.recording.moment(self.cursor)

    @property
    def is_past(self) -> bool:
        """Whether what is shown is behind the newest moment."""
        return self.cursor < len(self.recording)

    @property
    def can_go_on(self) -> bool:
        """Whether a step forward is possible."""
        if self.is_past:
            return True
        return not self.replay and self.phase is not Phase.ENDED and not self.recording.is_full

    @property
    def is_over(self) -> bool:
        """Whether there is nothing more to come from it: it was ended, or failed before the first moment."""
        failed = self.phase is Phase.FAILED and not len(self.recording)
        return failed or (self.phase is Phase.ENDED and not self.is_past)

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

    def take_over(self, inputs: Inputs) -> None:
        """Begin with inputs of an earlier simulation, as far as they are still what they were."""
        for each in self.stage.inputs:
            value = _accept(each, inputs.get(each.component, {}).get(each.name))
            if value is not None:
                merge_inputs(self._pending, {each.component: {each.name: value}})

    async def begin(self) -> None:
        """Start the process, so that mistakes are told before the first step."""
        async with self._busy:
            await self._guarded(self._look)
            self._first_guards = self.guards
        self._tell()

    async def step(self, count: int = 1, stops: Stops = _NOTHING) -> str:
        """Go forward, through the recorded past and on; returns why it rested, "" if it could not go on."""
        async with self._busy:
            self._wants_pause = False
            reason = await self._guarded(lambda: self._forward(count, stops))
        self.rested = reason or ""
        self._tell()
        return self.rested

    def pause(self) -> None:
        """Let a run come to rest as soon as it can."""
        self._wants_pause = True

    def back(self, count: int = 1) -> None:
        """Show an earlier moment."""
        self.go_to(self.cursor - count)

    def go_to(self, number: int) -> None:
        """Show a recorded moment."""
        self.cursor = min(max(0, number), len(self.recording))
        self.guards = moment.guards if (moment := self.moment) else self._first_guards
        self.rested = ""
        self._tell()

    def cut(self) -> None:
        """Forget what comes after the moment that is shown, to go on from there."""
        if not self.is_past or self.replay:
            return
        after = self.recording.changes_before(self.cursor + 1)
        self.recording.cut(self.cursor)
        # What was set before the next iteration stands in the form already.
        self._pending = {component: dict(values) for component, values in after.items()}
        self._drop_runner()
        self._forgive()

    async def set_input(self, key: tuple[str, str], value: Any) -> bool:
        """Set an input for the next iteration; false if there is no such input or the value is none of its type."""
        known = next((each for each in self.stage.inputs if each.key == key), None)
        if known is None or self.phase is Phase.ENDED or self.replay:
            return False
        accepted = _accept(known, value)
        if accepted is None:
            return False
        self.cut()
        self._forgive()
        merge_inputs(self._pending, {key[0]: {key[1]: accepted}})
        if not self._busy.locked():
            async with self._busy:
                await self._guarded(self._look)
        self._tell()
        return True

    def end(self) -> None:
        """Kill the process; the past can still be looked at."""
        self._wants_pause = True
        self._drop_runner()
        self.phase = Phase.ENDED

    async def gone(self) -> None:
        """Wait until the processes that were killed have left nothing behind."""
        while self._leaving:
            await self._leaving.pop().gone()

    def _forgive(self) -> None:
        """Forget a failure: with another input, or without what led to it, it may go well."""
        if self.phase is Phase.FAILED:
            self.phase, self.failure = Phase.RESTING, None

    async def _forward(self, count: int, stops: Stops) -> str:
        left = count
        while left and self.is_past and not self._wants_pause:
            was_done = self.recording_done(self.cursor)
            self.go_to(self.cursor + 1)
            left -= 1
            assert self.moment is not None
            reason = reason_to_rest(self.moment, stops, was_done=was_done)
            if reason:
                return reason
        reason = COUNT
        while left and reason == COUNT and not self._wants_pause:
            if not self.can_go_on:
                return self._full()
            await self._catch_up()
            made = len(self.recording)
            reason = await self._run_some(min(left, _CHUNK, MOST_MOMENTS - made), stops)
            left -= len(self.recording) - made
            self._tell()
        return "pause" if self._wants_pause and left else reason

    def recording_done(self, number: int) -> bool:
        """Whether the component was in a final state in a moment."""
        moment = self.recording.moment(number)
        return moment is not None and moment.done

    def _full(self) -> str:
        if self.recording.is_full:
            self.note = f"The recording is full ({MOST_MOMENTS} iterations); start again to go on."
        return "end"

    async def _run_some(self, count: int, stops: Stops) -> str:
        assert self._runner is not None
        self.phase = Phase.RUNNING
        changes, self._pending = self._pending, {}
        at = len(self.recording)
        if at < len(self.script):
            changes = {component: dict(values) for component, values in changes.items()}
            merge_inputs(changes, self.script[at])
            count = 1
        waiting = [changes]
        request = Request(do="run", inputs=changes, count=count, stops=stops)
        try:
            rested = await self._runner.run(request, lambda moment: self._take(moment, waiting))
        except RunFailedError:
            # Inputs that no moment has seen are still to come.
            self._pending = waiting.pop() if waiting else {}
            raise
        self.phase = Phase.RESTING
        return rested.reason

    def _take(self, moment: Moment, waiting: list[dict[str, dict[str, Any]]]) -> None:
        self.recording.add(moment, waiting.pop() if waiting else {})
        self._done = self.cursor = len(self.recording)
        self.guards = moment.guards

    async def _catch_up(self) -> None:
        """Have a process that has made all recorded iterations: if there is none, a new one repeats them."""
        if self._runner is not None and self._done == len(self.recording):
            return
        self._drop_runner()
        await self.gone()
        runner = await start_runner(self.stage, self.cwd)
        if self.phase is Phase.ENDED:
            # It was ended while it began.
            runner.kill()
            raise RunFailedError("The simulation was ended.")
        self._runner = runner
        latest: list[Moment] = []
        for changes, count in self.recording.runs(len(self.recording)):
            inputs = changes
            for begin in range(0, count, _QUIET_CHUNK):
                request = Request(do="run", inputs=inputs, count=min(_QUIET_CHUNK, count - begin), quiet=True)
                await self._runner.run(request, latest.append)
                inputs = {}
        self._done = len(self.recording)
        if latest and latest[-1] != self.recording.moment(self._done):
            self.note = "Repeating the past gave something else: the code reads the real time, or noise without a seed."

    async def _look(self) -> None:
        """Test the guards with the inputs as they are now."""
        await self._catch_up()
        assert self._runner is not None
        self.guards = (await self._runner.look(self._pending)).guards

    async def _guarded(self, do: Callable[[], Any]) -> Any:
        try:
            return await do()
        except RunFailedError as error:
            if self.phase is not Phase.ENDED:
                self.phase = Phase.FAILED
                self.failure = Failure(message=error.message, error=error.error, prints=error.prints)
        except OSError as error:
            self.phase = Phase.FAILED
            self.failure = Failure(message=f"The simulation could not be started: {error}")
        self._drop_runner()
        return None

    def _drop_runner(self) -> None:
        if self._runner is not None:
            self._runner.kill()
            self._leaving.append(self._runner)
        self._runner, self._done = None, 0

    def _tell(self) -> None:
        self.on_change()


def _first_inputs(inputs: Sequence[Input]) -> dict[str, dict[str, Any]]:
    first: dict[str, dict[str, Any]] = {}
    for each in inputs:
        value = {"value": each.initial, "table": []} if each.arguments is not None else each.initial
        first.setdefault(each.component, {})[each.name] = value
    return first


def _accept(known: Input, value: Any) -> Any | None:
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
