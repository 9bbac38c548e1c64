"""Charts of paths: the map, the way of each robot, colored by state, and thin lines for the other seeds."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

from vicode.simulated_robot.arena import RADIUS_M
from vicode.simulated_robot.session import RobotTrack, TrackPoint
from vicode.simulated_robot.world_map import Point, WorldMap

SERIES = 8
"""Number of colors that the page defines for states."""

_WIDTH, _TALLEST, _MARGIN = 520.0, 420.0, 10.0
_POINTS_PER_S = 5
_OUTLINE_EVERY_S = 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PathPart:
    """A piece of a path in one state; `color` is the number of its color."""

    points: str
    color: int
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Disc:
    """A circle; the color is -1 for goals."""

    x: float
    y: float
    radius: float
    color: int
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PathChart:
    """A chart in pixels, y downwards.

    Attributes:
        others: Paths of other seeds.
        robots: Outlines of the robots every few seconds.
    """

    title: str
    width: float
    height: float
    walls: tuple[str, ...]
    goals: tuple[Disc, ...]
    others: tuple[str, ...]
    parts: tuple[PathPart, ...]
    robots: tuple[Disc, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scale:
    factor: float
    left: float
    top: float

    def place(self, point: Point) -> Point:
        return round((point[0] - self.left) * self.factor, 1), round((self.top - point[1]) * self.factor, 1)

    def line(self, points: Iterable[Point]) -> str:
        return " ".join(f"{x:g},{y:g}" for x, y in map(self.place, points))


def build_path_chart(
    title: str, world_map: WorldMap, tracks: Sequence[RobotTrack], others: Sequence[RobotTrack], colors: dict[str, int]
) -> PathChart:
    """Draw runs in a map.

    Args:
        title: What the chart shows, for screen readers.
        world_map: The map.
        tracks: The robots of the run that is drawn with states.
        others: Robots of other runs.
        colors: Number of the color of each state.
    """
    left, bottom, right, top = world_map.bounds()
    factor = min((_WIDTH - 2 * _MARGIN) / (right - left), (_TALLEST - 2 * _MARGIN) / (top - bottom))
    scale = _Scale(factor=factor, left=left - _MARGIN / factor, top=top + _MARGIN / factor)
    goals = ((*scale.place(goal.at), goal.radius * factor) for goal in world_map.goals)
    return PathChart(
        title=title,
        width=round((right - left) * factor + 2 * _MARGIN),
        height=round((top - bottom) * factor + 2 * _MARGIN),
        walls=tuple(scale.line(line) for line in world_map.lines()),
        goals=tuple(Disc(x=x, y=y, radius=round(size, 1), color=-1, title="goal") for x, y, size in goals),
        others=tuple(scale.line(point.at for point in _thin_out(track.points)) for track in others),
        parts=tuple(part for track in tracks for part in _parts(track, scale, colors)),
        robots=tuple(disc for track in tracks for disc in _outlines(track, scale, colors)),
    )


def number_states(tracks: Iterable[RobotTrack]) -> dict[str, int]:
    """The states of runs in order of appearance, with the number of their color."""
    states = dict.fromkeys(point.state for track in tracks for point in track.points if point.state)
    return {state: number % SERIES for number, state in enumerate(states)}


def _parts(track: RobotTrack, scale: _Scale, colors: dict[str, int]) -> Iterable[PathPart]:
    before: list[Point] = []
    for state, group in groupby(track.points, key=lambda point: point.state):
        points = list(group)
        kept = [*before, *(point.at for point in _thin_out(points))]
        before = [points[-1].at]
        title = f"robot {track.robot.number}: {state}, {points[0].time_s:.1f} s to {points[-1].time_s:.1f} s"
        yield PathPart(points=scale.line(kept), color=colors.get(state, 0), title=title)


def _outlines(track: RobotTrack, scale: _Scale, colors: dict[str, int]) -> Iterable[Disc]:
    due = 0.0
    for point in track.points:
        if point.time_s >= due or point is track.points[-1]:
            due += _OUTLINE_EVERY_S
            x, y = scale.place(point.at)
            yield Disc(
                x=x,
                y=y,
                radius=round(RADIUS_M * scale.factor, 1),
                color=colors.get(point.state, 0),
                title=f"robot {track.robot.number} at {point.time_s:.0f} s: {point.state}",
            )


def _thin_out(points: Sequence[TrackPoint]) -> Iterable[TrackPoint]:
    """A few points per second, and the last one."""
    due = -1.0
    for point in points:
        if point.time_s >= due or point is points[-1]:
            due = point.time_s + 1 / _POINTS_PER_S
            yield point
