"""Sets of numbers in which a comparison with a constant holds."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from vicode.analysis.interval_diagrams import BEFORE_ALL, BEFORE_NAN, Interval, Position


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberSet:
    """A set of numbers: intervals in order, and nan or not."""

    intervals: tuple[Interval, ...]
    has_nan: bool = False


def compare_with(operator: str, number: float) -> NumberSet:
    """The numbers for which a comparison with a constant holds."""
    before, after = (number, 0), (number, 1)
    if math.isnan(number):
        return NumberSet(intervals=((BEFORE_ALL, BEFORE_NAN),) if operator == "!=" else (), has_nan=operator == "!=")
    match operator:
        case "<":
            return NumberSet(intervals=((BEFORE_ALL, before),))
        case "<=":
            return NumberSet(intervals=((BEFORE_ALL, after),))
        case ">":
            return NumberSet(intervals=((after, BEFORE_NAN),))
        case ">=":
            return NumberSet(intervals=((before, BEFORE_NAN),))
        case "==":
            return NumberSet(intervals=((before, after),))
        case _:
            return NumberSet(intervals=((BEFORE_ALL, before), (after, BEFORE_NAN)), has_nan=True)


def mirror(numbers: NumberSet) -> NumberSet:
    """The negative numbers of a set."""

    def mirrored(position: Position) -> Position:
        return (-position[0], 1 - position[1])

    return replace(
        numbers, intervals=tuple((mirrored(high), mirrored(low)) for low, high in reversed(numbers.intervals))
    )


def cut_off(intervals: Iterable[Interval], start: Position) -> tuple[Interval, ...]:
    """The parts of intervals after a position."""
    return tuple((max(low, start), high) for low, high in intervals if high > start)
