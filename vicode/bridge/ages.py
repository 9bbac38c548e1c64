"""Figures of many ages in constant memory."""

from collections.abc import Iterable

_BITS = 3
"""A bucket is an eighth of a power of two: quantiles are at most 12.5 % too high."""


class AgeFigures:
    """The distribution of ages in nanoseconds.

    Attributes:
        newest: The last age, None before the first.
        greatest: The greatest one.
        number: How many there were.
    """

    __slots__ = ("_buckets", "greatest", "newest", "number")

    def __init__(self) -> None:
        self.newest: int | None = None
        self.greatest = self.number = 0
        self._buckets: dict[int, int] = {}

    def add(self, age_ns: int) -> None:
        self.newest = age_ns
        self.greatest = max(self.greatest, age_ns)
        self.number += 1
        bucket = _find_bucket(age_ns)
        self._buckets[bucket] = self._buckets.get(bucket, 0) + 1

    def merge(self, other: "AgeFigures") -> None:
        """Add all ages of another distribution."""
        self.greatest = max(self.greatest, other.greatest)
        self.number += other.number
        for bucket, number in other._buckets.items():
            self._buckets[bucket] = self._buckets.get(bucket, 0) + number

    def quantile(self, part: float) -> int:
        """The age that this part of all ages does not exceed, from 0 to 1; 0 if there are none."""
        missing = part * self.number
        for bucket, number in sorted(self._buckets.items()):
            missing -= number
            if missing <= 0:
                return min(_upper_bound(bucket), self.greatest)
        return self.greatest


def merge_ages(parts: Iterable[AgeFigures]) -> AgeFigures:
    """The distribution of all ages of some distributions."""
    figures = AgeFigures()
    for each in parts:
        figures.merge(each)
    return figures


def _find_bucket(age_ns: int) -> int:
    shift = max(0, age_ns.bit_length() - _BITS - 1)
    return (shift << _BITS) + (age_ns >> shift)


def _upper_bound(bucket: int) -> int:
    shift = max(0, (bucket >> _BITS) - 1)
    return ((bucket - (shift << _BITS) + 1) << shift) - 1
