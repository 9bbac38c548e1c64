"""Runs the recorded inputs of a trace through the current design and finds the first difference of the states."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any

from vicode.runs.client import RunClient
from vicode.runs.inputs import DONE, PARAMETERS, SimulationInput
from vicode.runs.process import start_process
from vicode.runs.recording import merge_inputs
from vicode.runs.setup import PreparedRun
from vicode.simulation import Inputs, IterationResult, Request, Start

_CHUNK = 100
_MAX_WARM_UP = 1000

Values = dict[str, dict[str, Any]]
"""Values by component and name."""


class MissingValuesError(Exception):
    """The trace lacks values that the design reads; the message says which."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """The first difference. A component that was not stepped has no state (None)."""

    iteration: int
    time_ns: int
    component: str
    before: str | None
    expected: str | None
    got: str | None
    recorded: Mapping[str, Mapping[str, Any]]
    """The latest values in the trace."""
    replayed: Mapping[str, Mapping[str, Any]]
    """The latest values in the replay."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayResult:
    """What was compared, and the first difference, if any."""

    iterations: int
    time_ns: int
    difference: Difference | None


class RecordedInputs:
    """The changes of recorded inputs from one iteration to the next.

    Args:
        inputs: The inputs of the run.
        allows_missing: Keep the initial value of an input that the trace lacks.
    """

    def __init__(self, inputs: Iterable[SimulationInput], *, allows_missing: bool = False) -> None:
        self._names: dict[str, tuple[str, ...]] = {}
        self._known: dict[tuple[str, str], Any] = {}
        self._allows_missing = allows_missing
        inputs = tuple(inputs)
        self._functions = {each.key: each.initial for each in inputs if each.arguments is not None}
        for each in inputs:
            if each.arguments is None and each.name != DONE:
                self._names[each.component] = (*self._names.get(each.component, ()), each.name)

    def changes(self, iteration: IterationResult) -> Inputs:
        """The inputs that changed before an iteration.

        Raises:
            MissingValuesError: The trace lacks an input.
        """
        changes: Values = {}
        for component, values in _input_values(iteration):
            for name in self._names.get(component, ()):
                value = self._value(component, name, values)
                if value is not None and value != self._known.get((component, name)):
                    self._known[component, name] = value
                    changes.setdefault(component, {})[name] = value
        for (component, name), initial in self._functions.items():
            table = [
                [call.get("arguments"), call.get("value")]
                for call in iteration.calls
                if (call.get("component"), call.get("output")) == (component, name)
            ]
            if table != self._known.get((component, name), []):
                self._known[component, name] = table
                changes.setdefault(component, {})[name] = {"value": initial, "table": table}
        return changes

    def _value(self, component: str, name: str, values: Mapping[str, Any] | None) -> Any:
        value = None if values is None else values.get(name)
        if value is None and not self._allows_missing:
            if values is None:
                raise MissingValuesError("the trace has no values; record it with --values")
            owner = component or "the root component"
            raise MissingValuesError(
                f"the trace has no value of {owner}.{name}; an output must be a bool, int, float, str or an enumeration"
            )
        return value


@dataclass(slots=True, kw_only=True)
class StateComparison:
    """Compares the states of two runs, iteration by iteration.

    Args:
        components: The components to compare.
        tolerance_ns: How long states may differ.
    """

    components: frozenset[str]
    tolerance_ns: int = 0
    _before: Mapping[str, str] = field(default_factory=dict)
    _open: dict[str, Difference] = field(default_factory=dict)

    def add(self, recorded: IterationResult, replayed: IterationResult, values: tuple[Values, Values]) -> None:
        """Compare an iteration; `values` are the latest of both runs."""
        expected, got = self._states(recorded), self._states(replayed)
        for component in (*expected, *(name for name in got if name not in expected)):
            if expected.get(component) == got.get(component):
                self._open.pop(component, None)
            elif component not in self._open:
                self._open[component] = Difference(
                    iteration=recorded.iteration,
                    time_ns=recorded.time_ns,
                    component=component,
                    before=self._before.get(component),
                    expected=expected.get(component),
                    got=got.get(component),
                    recorded={name: dict(known) for name, known in values[0].items()},
                    replayed={name: dict(known) for name, known in values[1].items()},
                )
        self._before = expected

    def difference(self, now_ns: int) -> Difference | None:
        """The earliest difference that has lasted longer than the tolerance."""
        for each in self._open.values():
            if now_ns - each.time_ns >= self.tolerance_ns:
                return each
        return None

    def _states(self, iteration: IterationResult) -> dict[str, str]:
        steps = ((str(step["component"]), str(step["state"])) for step in iteration.tree)
        return {component: state for component, state in steps if component in self.components}


async def replay_trace(
    prepared: PreparedRun,
    cwd: Path,
    iterations: Iterator[IterationResult],
    *,
    components: frozenset[str],
    tolerance_ns: int = 0,
    allows_missing: bool = False,
) -> ReplayResult:
    """Run a trace until the states of the given components differ.

    Args:
        prepared: The design with stubs for all recorded components.
        cwd: The folder of the project.
        iterations: The recorded iterations.
        components: The components whose states are compared.
        tolerance_ns: How long states may differ.
        allows_missing: Keep the initial values of inputs that the trace lacks.

    Raises:
        MissingValuesError: The trace lacks an input.
        RunFailedError: The code of the design cannot run.
        TraceError: A line is not part of a trace.
    """
    first = next(iterations)
    client = await start_process(_with_live_stubs(prepared, first), cwd)
    try:
        replay = _Replay(
            client=client,
            inputs=RecordedInputs(prepared.inputs, allows_missing=allows_missing),
            comparison=StateComparison(components=components, tolerance_ns=tolerance_ns),
            allows_missing=allows_missing,
        )
        return await replay.run(chain([first], iterations))
    finally:
        client.close()
        await client.wait_closed()


@dataclass(slots=True, kw_only=True)
class _Replay:
    """One replay. A record that does not begin with the first iteration, or has gaps, is entered in the middle."""

    client: RunClient
    inputs: RecordedInputs
    comparison: StateComparison
    allows_missing: bool
    _values: tuple[Values, Values] = field(default_factory=lambda: ({}, {}))
    _count: int = 0
    _number: int = 0
    _time_ns: int = 0

    async def run(self, iterations: Iterator[IterationResult]) -> ReplayResult:
        upcoming = next(iterations, None)
        while upcoming is not None:
            if upcoming.iteration != self._number + 1:
                upcoming = await self._enter(upcoming, iterations)
                continue
            chunk, upcoming = _take_consecutive(upcoming, iterations)
            await self._run_chunk(chunk)
            difference = self.comparison.difference(self._time_ns)
            if difference is not None:
                return ReplayResult(iterations=self._count, time_ns=self._time_ns, difference=difference)
        return ReplayResult(iterations=self._count, time_ns=self._time_ns, difference=None)

    async def _enter(self, recorded: IterationResult, iterations: Iterator[IterationResult]) -> IterationResult | None:
        """Continue from the first iteration before which all components have worked; returns the one after it."""
        inputs: Values = {}
        worked_ns: dict[str, int] = {}
        upcoming: IterationResult | None = recorded
        for number in range(_MAX_WARM_UP):
            self._remember(recorded, recorded)
            merge_inputs(inputs, self.inputs.changes(recorded))
            worked_ns.update((str(step["component"]), recorded.time_ns) for step in recorded.tree if step["worked"])
            upcoming = next(iterations, None)
            is_known = all(step["component"] in worked_ns for step in recorded.tree)
            if upcoming is None or (is_known and number) or upcoming.iteration != recorded.iteration + 1:
                break
            recorded = upcoming
        start = Start(
            iteration=recorded.iteration,
            time_ns=recorded.time_ns,
            tree=recorded.tree,
            values=self._values[0],
            worked_ns=worked_ns,
        )
        self.comparison.add(recorded, recorded, self._values)
        await self.client.run_inspection(Request(kind="inspect", inputs=inputs, start=start))
        self._number, self._time_ns = recorded.iteration, recorded.time_ns
        return upcoming

    async def _run_chunk(self, chunk: list[IterationResult]) -> None:
        answers: list[IterationResult] = []
        script = tuple(self.inputs.changes(each) for each in chunk)
        times_ns = tuple(each.time_ns for each in chunk)
        await self.client.run(Request(kind="run", count=len(chunk), script=script, times_ns=times_ns), answers.append)
        for recorded, replayed in zip(chunk, answers, strict=True):
            if not self.allows_missing:
                _require_calls(recorded, replayed)
            self._remember(recorded, replayed)
            self.comparison.add(recorded, replayed, self._values)
            self._count, self._number, self._time_ns = self._count + 1, recorded.iteration, recorded.time_ns
            if self.comparison.difference(recorded.time_ns) is not None:
                return

    def _remember(self, recorded: IterationResult, replayed: IterationResult) -> None:
        for known, iteration in zip(self._values, (recorded, replayed), strict=True):
            known.update(recorded.inputs)
            known.update((name, each) for name, each in iteration.values().items() if each)


def _take_consecutive(
    first: IterationResult, iterations: Iterator[IterationResult]
) -> tuple[list[IterationResult], IterationResult | None]:
    """Iterations with consecutive numbers, and the one after them."""
    chunk = [first]
    for each in iterations:
        if len(chunk) == _CHUNK or each.iteration != chunk[-1].iteration + 1:
            return chunk, each
        chunk.append(each)
    return chunk, None


def _with_live_stubs(prepared: PreparedRun, first: IterationResult) -> PreparedRun:
    """Components that only provide values are not stepped: their stubs show new values at once, as functions do."""
    stubs = (
        replace(
            stub,
            is_live=stub.is_live or stub.component in first.inputs,
            outputs=tuple(replace(each, is_live=each.is_function) for each in stub.outputs),
        )
        for stub in prepared.setup.stubs
    )
    return replace(prepared, setup=replace(prepared.setup, stubs=tuple(stubs)))


def _require_calls(recorded: IterationResult, replayed: IterationResult) -> None:
    known = [(call.get("component"), call.get("output"), call.get("arguments")) for call in recorded.calls]
    for call in replayed.calls:
        if (call["component"], call["output"], call["arguments"]) not in known:
            arguments = ", ".join(
                value if name.isdigit() else f"{name}={value}"
                for name, value in ((name, str(value)) for name, value in call["arguments"].items())
            )
            raise MissingValuesError(
                f"at {recorded.time_ns / 1e9:.3f} s, iteration {recorded.iteration}, the design calls "
                f"{call['component']}.{call['output']}({arguments}), which the trace has no result of"
            )


def _input_values(iteration: IterationResult) -> Iterator[tuple[str, Mapping[str, Any] | None]]:
    yield PARAMETERS, iteration.tree[0].get("values")
    yield from iteration.values().items()
