"""What a trace contains for a replay: the inputs of each iteration, and the places where a record is entered."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from vicode.runs.inputs import DONE, PARAMETERS, SimulationInput
from vicode.runs.recording import merge_inputs
from vicode.simulation import Inputs, IterationResult, Request, Start

_CHUNK = 100
_MAX_WARM_UP = 1000

Values = dict[str, dict[str, Any]]
"""Values by component and name."""


class MissingValuesError(Exception):
    """The trace lacks values that the design reads; the message says which."""


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


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedEntry:
    """Where a run enters a record that does not begin with the first iteration, or has gaps."""

    start: Start
    inputs: Inputs
    iteration: IterationResult
    """The iteration that the run continues from."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedChunk:
    """Consecutive iterations to run with their inputs."""

    iterations: list[IterationResult]
    script: tuple[Inputs, ...]

    @property
    def request(self) -> Request:
        """Runs the iterations at their recorded times."""
        times_ns = tuple(each.time_ns for each in self.iterations)
        return Request(kind="run", count=len(self.iterations), script=self.script, times_ns=times_ns)


def read_segments(
    iterations: Iterator[IterationResult], inputs: RecordedInputs
) -> Iterator[RecordedEntry | RecordedChunk]:
    """What a replay of a trace does: enter it, and run its iterations.

    Raises:
        MissingValuesError: The trace lacks an input.
        TraceError: A line is not part of a trace.
    """
    latest: Values = {}
    number = 0
    upcoming = next(iterations, None)
    while upcoming is not None:
        if upcoming.iteration != number + 1:
            entry, upcoming = _find_entry(upcoming, iterations, inputs, latest)
            number = entry.iteration.iteration
            yield entry
            continue
        chunk, upcoming = _take_consecutive(upcoming, iterations)
        number = chunk[-1].iteration
        yield RecordedChunk(iterations=chunk, script=tuple(inputs.changes(each) for each in chunk))
        for each in chunk:
            merge_values(latest, each)


def merge_values(latest: Values, iteration: IterationResult) -> None:
    """Replace the latest values by those of an iteration."""
    latest.update((name, each) for name, each in iteration.values().items() if each)


def _find_entry(
    recorded: IterationResult, iterations: Iterator[IterationResult], inputs: RecordedInputs, latest: Values
) -> tuple[RecordedEntry, IterationResult | None]:
    """The first iteration before which all components have worked, and the one after it."""
    changes: Values = {}
    worked_ns: dict[str, int] = {}
    upcoming: IterationResult | None = recorded
    for number in range(_MAX_WARM_UP):
        merge_values(latest, recorded)
        merge_inputs(changes, inputs.changes(recorded))
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
        values=dict(latest),
        worked_ns=worked_ns,
    )
    return RecordedEntry(start=start, inputs=changes, iteration=recorded), upcoming


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


def _input_values(iteration: IterationResult) -> Iterator[tuple[str, Mapping[str, Any] | None]]:
    yield PARAMETERS, iteration.tree[0].get("values")
    yield from iteration.values().items()
