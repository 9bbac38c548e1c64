"""The recorded past of a run: every iteration, the inputs before it, and the values as columns for plots."""

import math
import zlib
from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping
from typing import Any

from vicode.simulation import Inputs, IterationResult, decode_response
from vicode.simulation.messages import encode_response

MAX_ITERATIONS = 20_000
_MAX_COLUMNS = 400


class Recording:
    """Iterations 1, 2, 3 …; 0 is the time before the first."""

    def __init__(self) -> None:
        self._packed: list[bytes] = []
        self._changes: dict[int, Inputs] = {}
        self._columns: dict[str, array[float]] = {}
        self._with_output: list[int] = []
        self.states: list[str] = []
        self.transitions: list[str] = []
        self.times_ns: list[int] = []
        self.dropped = 0
        """How many iterations were removed at the beginning."""
        self.truncations = 0
        """How often iterations were removed at the end, after which others get their numbers."""

    def __len__(self) -> int:
        return len(self._packed)

    @property
    def is_full(self) -> bool:
        return len(self) >= MAX_ITERATIONS

    @property
    def names(self) -> tuple[str, ...]:
        """The names of plottable values, as `Component.name`."""
        return tuple(self._columns)

    def add(self, iteration: IterationResult, changes: Inputs) -> None:
        """Add an iteration and the inputs that were set before it."""
        if any(changes.values()):
            self._changes[len(self) + 1] = changes
        # Consecutive iterations are similar: compression leaves a fifth.
        self._packed.append(zlib.compress(encode_response(iteration), 1))
        self.states.append(iteration.state)
        self.transitions.append(iteration.transition or "")
        self.times_ns.append(iteration.time_ns)
        if iteration.prints or iteration.omitted_lines or iteration.errors:
            self._with_output.append(len(self))
        self._add_values(iteration)

    def iteration(self, number: int) -> IterationResult | None:
        """An iteration by its number; None for 0."""
        if not 0 < number <= len(self):
            return None
        iteration = decode_response(zlib.decompress(self._packed[number - 1]))
        assert isinstance(iteration, IterationResult)
        return iteration

    def iterations(self) -> Iterator[IterationResult]:
        """The iterations recorded so far, also if others are added or removed meanwhile."""
        for packed in tuple(self._packed):
            iteration = decode_response(zlib.decompress(packed))
            assert isinstance(iteration, IterationResult)
            yield iteration

    def number_at(self, time_ns: int) -> int | None:
        """The number of the first iteration at a time or after it; None if it is not recorded yet."""
        index = bisect_left(self.times_ns, time_ns)
        return index + 1 if index < len(self) else None

    def changes_before(self, number: int) -> Inputs:
        return self._changes.get(number, {})

    def input_segments(self, end: int) -> Iterator[tuple[Inputs, int]]:
        """The inputs up to an iteration, each with the number of iterations that used them."""
        starts = sorted({1, *(number for number in self._changes if number <= end)})
        for start, after in zip(starts, [*starts[1:], end + 1], strict=True):
            if after > start:
                yield self._changes.get(start, {}), after - start

    def inputs_at(self, number: int) -> dict[str, dict[str, Any]]:
        known: dict[str, dict[str, Any]] = {}
        for start in sorted(self._changes):
            if start > number:
                break
            merge_inputs(known, self._changes[start])
        return known

    def truncate(self, length: int) -> None:
        """Remove all iterations after the first `length`."""
        self.truncations += 1
        del self._packed[length:]
        del self.states[length:]
        del self.transitions[length:]
        del self.times_ns[length:]
        self._with_output = [number for number in self._with_output if number <= length]
        for column in self._columns.values():
            del column[length:]
        self._changes = {number: each for number, each in self._changes.items() if number <= length}

    def make_room(self) -> None:
        """Remove the older half if it is full."""
        if not self.is_full:
            return
        count = len(self) // 2
        del self._packed[:count]
        del self.states[:count]
        del self.transitions[:count]
        del self.times_ns[:count]
        for column in self._columns.values():
            del column[:count]
        self._with_output = [number - count for number in self._with_output if number > count]
        self._changes = {number - count: each for number, each in self._changes.items() if number > count}
        self.dropped += count

    def column(self, name: str) -> "array[float]":
        """The values of one name over all iterations, nan where missing; empty for an unknown name."""
        column = self._columns.get(name, array("d"))
        missing = len(self) - len(column) if column else 0
        return column + array("d", [math.nan]) * missing

    def iterations_with_output(self, number: int, limit: int) -> list[int]:
        """The numbers of the latest `limit` iterations with output or an error, up to iteration `number`."""
        end = bisect_right(self._with_output, number)
        return self._with_output[max(0, end - limit) : end]

    def latest_transition(self, number: int) -> str:
        """The last transition taken up to an iteration; "" if there is none, or it is not known."""
        for index in range(number - 1, -1, -1):
            if self.transitions[index]:
                return self.transitions[index]
            if index and self.states[index] != self.states[index - 1]:
                return ""
        return ""

    def _add_values(self, iteration: IterationResult) -> None:
        index = len(self) - 1
        for component, values in iteration.values().items():
            for name, value in (values or {}).items():
                number = _number(value)
                if number is not None:
                    self._put(f"{component}.{name}", index, number)

    def _put(self, name: str, index: int, number: float) -> None:
        if name not in self._columns and len(self._columns) >= _MAX_COLUMNS:
            return
        column = self._columns.setdefault(name, array("d"))
        if len(column) > index:
            # If a component is stepped twice in an iteration, the later value counts.
            column[index] = number
            return
        column.extend([math.nan] * (index - len(column)))
        column.append(number)


def merge_inputs(known: dict[str, dict[str, Any]], changes: Mapping[str, Mapping[str, Any]]) -> None:
    for component, values in changes.items():
        known.setdefault(component, {}).update(values)


def _number(value: object) -> float | None:
    return float(value) if isinstance(value, bool | int | float) else None
