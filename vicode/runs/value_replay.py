"""What another value of a constant or parameter would have changed: one record, replayed with both values.

Two processes run the recorded inputs side by side, the design as it is and the design with the value. Comparing them,
not the record and the new value, leaves out everything else that differs from the record, such as a design that was
changed since. The replay is open-loop: the recorded inputs do not react to the changed behavior.
"""

import asyncio
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain, dropwhile
from pathlib import Path

from vicode.model.design import Design
from vicode.model.project import Project
from vicode.runs.changed_values import ChangedValue, apply_values
from vicode.runs.client import RunClient
from vicode.runs.inputs import PARAMETERS
from vicode.runs.process import start_process
from vicode.runs.recorded_inputs import (
    RecordedChunk,
    RecordedEntry,
    RecordedInputs,
    Values,
    merge_values,
    read_segments,
)
from vicode.runs.replay import Difference, require_calls, states_of, with_live_stubs
from vicode.runs.setup import PreparedRun, RunConfig, prepare_run, used_components
from vicode.simulation import IterationResult, Request, Start

_BRIDGED_NS = 500_000_000

StateTimes = dict[tuple[str, str], tuple[int, int]]
"""Nanoseconds in each state, by component and state: before and after."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueEffect:
    """What changes in a record.

    Attributes:
        iterations: How many were replayed.
        changed: In how many a component has another state.
        first: The first of them: `expected` is the state before the change, `got` the one after it.
        times_ns: How long each state is active.
        unlike_record: In how many the states differ from the record even without the change.
    """

    iterations: int
    changed: int
    first: Difference | None
    times_ns: StateTimes
    unlike_record: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueReplay:
    """A design with two sets of values, ready to run."""

    project: Project
    before: PreparedRun
    after: PreparedRun
    values: tuple[ChangedValue, ...]
    components: frozenset[str]


def prepare_value_replay(
    project: Project, design: Design, values: tuple[ChangedValue, ...], sources: Mapping[str, str], folder: Path
) -> ValueReplay:
    """Generate a design with and without changed values.

    Raises:
        NotReadyError: The design, or one that it uses, has errors.
        UnsoundDesignError: It cannot be generated.
    """
    changed = apply_values(project, values)
    names = (design.component, *used_components(project, design))
    return ValueReplay(
        project=project,
        before=prepare_run(project, design, RunConfig(), sources, folder),
        after=prepare_run(changed, changed.design(design.component) or design, RunConfig(), sources, folder),
        values=values,
        components=frozenset(name for name in names if project.design(name) is not None),
    )


def concerns(project: Project, design: Design, value: ChangedValue) -> bool:
    """Whether a run of a design can depend on a value."""
    return value.component in ("", design.component, *used_components(project, design))


def bridge_gaps(iterations: Iterator[IterationResult]) -> Iterator[IterationResult]:
    """The iterations of a live view as if the robot had made no others, except after a gap of half a second.

    A live view receives some of the iterations only. Entering the record after each of them would leave nothing to
    compare.
    """
    number, last_ns = 0, 0
    # The first ones came before the robot knew that values are needed.
    for each in dropwhile(lambda iteration: "values" not in iteration.tree[0], iterations):
        if not number:
            number = each.iteration
        else:
            number += 1 if each.time_ns - last_ns <= _BRIDGED_NS else 2
        last_ns = each.time_ns
        yield replace(each, iteration=number)


async def replay_values(
    prepared: ValueReplay,
    cwd: Path,
    iterations: Iterator[IterationResult],
    *,
    allows_missing: bool = False,
    on_progress: Callable[[int], None] = lambda _count: None,
) -> ValueEffect:
    """Run a trace with and without changed values.

    Args:
        prepared: The design with both values.
        cwd: The folder of the project.
        iterations: The recorded iterations, at least one.
        allows_missing: Keep the initial values of inputs that the trace lacks.
        on_progress: Called with the number of iterations so far.

    Raises:
        MissingValuesError: The trace lacks an input.
        RunFailedError: The code of the design cannot run.
        TraceError: A line is not part of a trace.
    """
    first = next(iterations)
    clients: list[RunClient] = []
    try:
        clients.append(await start_process(with_live_stubs(prepared.before, first), cwd))
        clients.append(await start_process(with_live_stubs(prepared.after, first), cwd))
        run = _TwoRuns(prepared=prepared, clients=(clients[0], clients[1]), requires_calls=not allows_missing)
        own = {each.name for each in prepared.values if each.component == prepared.before.design.component}
        # A recorded parameter of the root component would replace the changed one.
        inputs = (each for each in prepared.before.inputs if each.component != PARAMETERS or each.name not in own)
        recorded = RecordedInputs(inputs, allows_missing=allows_missing)
        for segment in read_segments(chain([first], iterations), recorded):
            await run.add(segment)
            on_progress(run.count)
        return run.effect()
    finally:
        for client in clients:
            client.close()
        for client in clients:
            await client.wait_closed()


@dataclass(slots=True, kw_only=True)
class _TwoRuns:
    prepared: ValueReplay
    clients: tuple[RunClient, RunClient]
    requires_calls: bool
    count: int = 0
    _changed: int = 0
    _unlike_record: int = 0
    _first: Difference | None = None
    _times_ns: dict[tuple[str, str], list[int]] = field(default_factory=dict)
    _values: tuple[Values, Values] = field(default_factory=lambda: ({}, {}))
    _active: tuple[dict[str, str], dict[str, str]] = field(default_factory=lambda: ({}, {}))
    _time_ns: int = 0

    async def add(self, segment: RecordedEntry | RecordedChunk) -> None:
        if isinstance(segment, RecordedEntry):
            await self._enter(segment)
        else:
            await self._run_chunk(segment)

    def effect(self) -> ValueEffect:
        return ValueEffect(
            iterations=self.count,
            changed=self._changed,
            first=self._first,
            times_ns={key: (before, after) for key, (before, after) in self._times_ns.items()},
            unlike_record=self._unlike_record,
        )

    async def _enter(self, entry: RecordedEntry) -> None:
        start = self._without_changed(entry.start)
        request = Request(kind="inspect", inputs=entry.inputs, start=start)
        await asyncio.gather(*(client.run_inspection(request) for client in self.clients))
        states = states_of(entry.iteration, self.prepared.components)
        self._active, self._time_ns = (states, states), start.time_ns
        self._values = dict(entry.start.values), dict(entry.start.values)

    def _without_changed(self, start: Start) -> Start:
        """A start with the declared values of the changed parameters in place of the recorded ones."""
        values = {name: dict(known) for name, known in start.values.items()}
        tree = [{**step, "parameters": dict(step["parameters"])} for step in start.tree]
        for each in self.prepared.values:
            values.get(each.component, {}).pop(each.name, None)
            declared = replace(each, text=each.text_in(self.prepared.project))
            for step in tree:
                # A component that works less often repeats its recorded calls, with defaults, until it works again.
                known = step["parameters"].get(each.name)
                if step["component"] == each.component and declared.is_value(known, self.prepared.project):
                    del step["parameters"][each.name]
        return replace(start, values=values, tree=tree)

    async def _run_chunk(self, chunk: RecordedChunk) -> None:
        answers: tuple[list[IterationResult], list[IterationResult]] = ([], [])
        await asyncio.gather(
            *(client.run(chunk.request, found.append) for client, found in zip(self.clients, answers, strict=True))
        )
        for recorded, before, after in zip(chunk.iterations, *answers, strict=True):
            if self.requires_calls:
                require_calls(recorded, before)
                require_calls(recorded, after)
            self._compare(recorded, before, after)

    def _compare(self, recorded: IterationResult, before: IterationResult, after: IterationResult) -> None:
        names = self.prepared.components
        states = states_of(before, names), states_of(after, names)
        self.count += 1
        self._unlike_record += states[0] != states_of(recorded, names)
        self._add_times(recorded.time_ns)
        if self._first is None:
            for known, iteration in zip(self._values, (before, after), strict=True):
                known.update(recorded.inputs)
                merge_values(known, iteration)
        if states[0] != states[1]:
            self._changed += 1
            self._first = self._first or self._describe(recorded, states)
        self._active = states

    def _add_times(self, now_ns: int) -> None:
        """A state lasts until the next iteration."""
        for index, active in enumerate(self._active):
            for key in active.items():
                self._times_ns.setdefault(key, [0, 0])[index] += now_ns - self._time_ns
        self._time_ns = now_ns

    def _describe(self, recorded: IterationResult, states: tuple[dict[str, str], dict[str, str]]) -> Difference:
        old, new = states
        component = next(name for name in (*old, *new) if old.get(name) != new.get(name))
        return Difference(
            iteration=recorded.iteration,
            time_ns=recorded.time_ns,
            component=component,
            before=self._active[0].get(component),
            expected=old.get(component),
            got=new.get(component),
            recorded={name: dict(known) for name, known in self._values[0].items()},
            replayed={name: dict(known) for name, known in self._values[1].items()},
        )
