"""Rectangles under names in a coarse grid, so that asking what lies somewhere does not grow with their number."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.diagram.boxes import Size
from vicode.model.design import Point

_CELL = 200.0
# One that is larger than so many cells would be a slip of the pen somewhere far out.
_MOST_CELLS = 400


@dataclass(frozen=True, slots=True)
class Rect:
    """By its edges."""

    left: float
    top: float
    right: float
    bottom: float

    @classmethod
    def around(cls, at: Point, size: Size) -> "Rect":
        """Of a size, around a centre."""
        return cls(at[0] - size.width / 2, at[1] - size.height / 2, at[0] + size.width / 2, at[1] + size.height / 2)

    def grown(self, by: float) -> "Rect":
        """Larger by this on every side."""
        return Rect(self.left - by, self.top - by, self.right + by, self.bottom + by)

    def overlaps(self, other: "Rect") -> bool:
        """Whether both share more than a border."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )


class Rects:
    """Rectangles to be found by place."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[str, Rect]]] = defaultdict(list)

    def add(self, key: str, rect: Rect) -> None:
        """Put a rectangle there."""
        for cell in _cells(rect):
            self._cells[cell].append((key, rect))

    def under(self, rect: Rect) -> set[str]:
        """The keys of all that overlap a rectangle."""
        return {key for cell in _cells(rect) for key, other in self._cells.get(cell, ()) if rect.overlaps(other)}


class Points:
    """Points of lines, to be found by place."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[str, Point]]] = defaultdict(list)

    def add(self, key: str, points: Iterable[Point]) -> None:
        """Put the points of a line there."""
        for x, y in points:
            self._cells[math.floor(x / _CELL), math.floor(y / _CELL)].append((key, (x, y)))

    def within(self, rect: Rect) -> set[str]:
        """The keys of all lines with a point in a rectangle."""
        return {
            key
            for cell in _cells(rect)
            for key, (x, y) in self._cells.get(cell, ())
            if rect.left <= x <= rect.right and rect.top <= y <= rect.bottom
        }


def _cells(rect: Rect) -> Iterator[tuple[int, int]]:
    columns = range(math.floor(rect.left / _CELL), math.floor(rect.right / _CELL) + 1)
    rows = range(math.floor(rect.top / _CELL), math.floor(rect.bottom / _CELL) + 1)
    if len(columns) * len(rows) <= _MOST_CELLS:
        yield from ((column, row) for column in columns for row in rows)
