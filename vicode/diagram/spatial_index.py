"""Rectangles in a coarse grid, so that a spatial query does not depend on their number."""

import math
from collections import defaultdict
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from vicode.diagram.node_geometry import Size
from vicode.model.design import Point

CubicBezier = tuple[float, float, float, float, float, float, float, float]
"""A cubic curve: start, two control points, end."""

BezierWeights = tuple[float, float, float, float]
"""The weights of the four points of a curve at one of its points."""

_CELL_SIZE = 200.0
_FINE_CELL_SIZE = 40.0
# A rectangle with more cells is a typo far outside the diagram.
_MAX_CELLS = 400


@dataclass(frozen=True, slots=True)
class Rect:
    """A rectangle by its edges."""

    left: float
    top: float
    right: float
    bottom: float

    @classmethod
    def from_center(cls, at: Point, size: Size) -> "Rect":
        return cls(at[0] - size.width / 2, at[1] - size.height / 2, at[0] + size.width / 2, at[1] + size.height / 2)

    def expanded(self, by: float) -> "Rect":
        """The rectangle enlarged by this amount on every side."""
        return Rect(self.left - by, self.top - by, self.right + by, self.bottom + by)

    def overlaps(self, other: "Rect") -> bool:
        """Whether the rectangles share more than a border."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )


class RectIndex:
    """A spatial index of rectangles."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[str, Rect]]] = defaultdict(list)

    def add(self, key: str, rect: Rect) -> None:
        for cell in _cells(rect):
            self._cells[cell].append((key, rect))

    def remove(self, key: str, rect: Rect) -> None:
        for cell in _cells(rect):
            self._cells[cell].remove((key, rect))

    def overlapping(self, rect: Rect) -> set[str]:
        """The keys of all rectangles that overlap this one."""
        return {key for cell in _cells(rect) for key, other in self._cells.get(cell, ()) if rect.overlaps(other)}


class ObstacleIndex:
    """Obstacles for lines: rectangles with a clearance, in a grid so fine that most cells are empty."""

    def __init__(self, clearance: float) -> None:
        self._clearance = clearance
        self._cells: dict[tuple[float, float], list[tuple[str, float, float, float, float]]] = {}

    def add(self, key: str, rect: Rect) -> None:
        wide = rect.expanded(self._clearance)
        entry = (key, wide.left, wide.top, wide.right, wide.bottom)
        for column, row in _cells(wide, _FINE_CELL_SIZE):
            self._cells.setdefault((float(column), float(row)), []).append(entry)

    def count_hit(
        self, curve: CubicBezier, weights: Iterable[BezierWeights], ignored: Collection[str], limit: float
    ) -> int:
        """How many rectangles contain a point of the curve, except `ignored`; stops counting at `limit`."""
        find, hit = self._cells.get, set[str]()
        x0, y0, x1, y1, x2, y2, x3, y3 = curve
        # Dependency diagrams of large projects call this a million times, hence the inlined arithmetic.
        for a, b, c, d in weights:
            x, y = a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3
            for key, left, top, right, bottom in find((x // _FINE_CELL_SIZE, y // _FINE_CELL_SIZE), ()):
                if left < x < right and top < y < bottom and key not in ignored:
                    hit.add(key)
                    if len(hit) >= limit:
                        return len(hit)
        return len(hit)


class PointIndex:
    """A spatial index of points of lines."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[str, float, float]]] = defaultdict(list)

    def add(self, key: str, points: Iterable[Point]) -> None:
        for x, y in points:
            self._cells[int(x // _FINE_CELL_SIZE), int(y // _FINE_CELL_SIZE)].append((key, x, y))

    def within(self, rect: Rect) -> set[str]:
        """The keys of all lines with a point in a rectangle."""
        left, top, right, bottom = rect.left, rect.top, rect.right, rect.bottom
        return {
            key
            for cell in _cells(rect, _FINE_CELL_SIZE)
            for key, x, y in self._cells.get(cell, ())
            if left <= x <= right and top <= y <= bottom
        }


def _cells(rect: Rect, size: float = _CELL_SIZE) -> Iterable[tuple[int, int]]:
    left, right = math.floor(rect.left / size), math.floor(rect.right / size)
    top, bottom = math.floor(rect.top / size), math.floor(rect.bottom / size)
    if left == right and top == bottom:
        return ((left, top),)
    if (right - left + 1) * (bottom - top + 1) > _MAX_CELLS:
        return ()
    return [(column, row) for column in range(left, right + 1) for row in range(top, bottom + 1)]
