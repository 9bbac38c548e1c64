"""Runs the recorded inputs of a trace through the current design and finds the first difference of the states."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any

from vicode.runs.client import RunClient
from vicode.runs.process import start_process
from vicode.runs.recorded_inputs import (
    MissingValuesError,
    RecordedChunk,
    RecordedEntry,
    RecordedInputs,
    Values,
    merge_values,
    read_segments,
)
from vicode.runs.setup import PreparedRun
from vicode.simulation import IterationResult, Request


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
        expected, got = states_of(recorded, self.components), states_of(replayed, self.components)
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


def states_of(iteration: IterationResult, components: frozenset[str]) -> dict[str, str]:
    """The states of those components that were stepped."""
    steps = ((str(step["component"]), str(step["state"])) for step in iteration.tree)
    return {component: state for component, state in steps if component in components}


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
    client = await start_process(with_live_stubs(prepared, first), cwd)
    try:
        replay = _Replay(
            client=client,
            comparison=StateComparison(components=components, tolerance_ns=tolerance_ns),
            allows_missing=allows_missing,
        )
        inputs = RecordedInputs(prepared.inputs, allows_missing=allows_missing)
        return await replay.run(read_segments(chain([first], iterations), inputs))
    finally:
        client.close()
        await client.wait_closed()


@dataclass(slots=True, kw_only=True)
class _Replay:
    """One replay; ends at the first difference."""

    client: RunClient
    comparison: StateComparison
    allows_missing: bool
    _values: tuple[Values, Values] = field(default_factory=lambda: ({}, {}))
    _count: int = 0
    _time_ns: int = 0

    async def run(self, segments: Iterator[RecordedEntry | RecordedChunk]) -> ReplayResult:
        for segment in segments:
            if isinstance(segment, RecordedEntry):
                await self._enter(segment)
                continue
            await self._run_chunk(segment)
            difference = self.comparison.difference(self._time_ns)
            if difference is not None:
                return ReplayResult(iterations=self._count, time_ns=self._time_ns, difference=difference)
        return ReplayResult(iterations=self._count, time_ns=self._time_ns, difference=None)

    async def _enter(self, entry: RecordedEntry) -> None:
        recorded = entry.iteration
        self._values = dict(entry.start.values), dict(entry.start.values)
        self.comparison.add(recorded, recorded, self._values)
        await self.client.run_inspection(Request(kind="inspect", inputs=entry.inputs, start=entry.start))
        self._time_ns = recorded.time_ns

    async def _run_chunk(self, chunk: RecordedChunk) -> None:
        answers: list[IterationResult] = []
        await self.client.run(chunk.request, answers.append)
        for recorded, replayed in zip(chunk.iterations, answers, strict=True):
            if not self.allows_missing:
                require_calls(recorded, replayed)
            for known, iteration in zip(self._values, (recorded, replayed), strict=True):
                known.update(recorded.inputs)
                merge_values(known, iteration)
            self.comparison.add(recorded, replayed, self._values)
            self._count, self._time_ns = self._count + 1, recorded.time_ns
            if self.comparison.difference(recorded.time_ns) is not None:
                return


def with_live_stubs(prepared: PreparedRun, first: IterationResult) -> PreparedRun:
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


def require_calls(recorded: IterationResult, replayed: IterationResult) -> None:
    """Check that the trace has the results of all calls of outputs with arguments.

    Raises:
        MissingValuesError: It lacks one.
    """
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
