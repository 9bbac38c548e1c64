"""Maps of simulated worlds: walls, circles, start poses and goals, in metres."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import cos, hypot, pi, sin
from pathlib import Path

Point = tuple[float, float]
Wall = tuple[Point, Point]
MAPS_FOLDER = Path(__file__).parent / "maps"
"""The maps that are part of vicode."""

_CIRCLE_SIDES = 36
_HALF = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Circle:
    """A round wall: a pillar, or the border of an arena."""

    at: Point
    radius: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StartPose:
    """Where a robot starts; with a `spread`, x and y are up to that far off, and the heading a little."""

    at: Point
    towards: Point
    spread: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldMap:
    """A world; `walls` are polylines, a robot reaches a goal when its center is inside."""

    name: str = ""
    doc: str = ""
    walls: tuple[tuple[Point, ...], ...] = ()
    circles: tuple[Circle, ...] = ()
    starts: tuple[StartPose, ...] = ()
    goals: tuple[Circle, ...] = ()

    def lines(self) -> tuple[tuple[Point, ...], ...]:
        """All walls as polylines."""
        return *self.walls, *(_corners(circle) for circle in self.circles)

    def segments(self) -> Iterator[Wall]:
        """All walls as straight lines."""
        for line in self.lines():
            yield from pairwise(line)

    def bounds(self) -> tuple[float, float, float, float]:
        """The smallest and largest x and y of the walls, or of a square around the starts if there are none."""
        points = [point for wall in self.segments() for point in wall]
        points += [
            (start.at[0] + side, start.at[1] + side) for start in self.starts for side in (-_HALF, _HALF)
        ]  # keeps an empty map visible
        xs, ys = zip(*points, strict=True) if points else ((-1.0, 1.0), (-1.0, 1.0))
        return min(xs), min(ys), max(xs), max(ys)

    def is_goal(self, point: Point) -> bool:
        return any(hypot(point[0] - goal.at[0], point[1] - goal.at[1]) <= goal.radius for goal in self.goals)


def _corners(circle: Circle) -> tuple[Point, ...]:
    angles = [2 * pi * number / _CIRCLE_SIDES for number in range(_CIRCLE_SIDES)]
    corners = [
        (circle.at[0] + circle.radius * cos(angle), circle.at[1] + circle.radius * sin(angle)) for angle in angles
    ]
    return *corners, corners[0]
