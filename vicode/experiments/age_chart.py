"""The chart of the age of the data that behaviors acted on, over time, with what the thesis reports."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from vicode.simulated_robot.session import TrackPoint

THESIS_AFTER_S, THESIS_AGE_S = 60.0, 30.0
"""“After running the program for a minute, the sensor data of 30 seconds in was only just coming in.”"""

_LEFT, _RIGHT, _TOP, _BOTTOM = 64.0, 12.0, 12.0, 34.0
_WIDTH, _HEIGHT = 720.0, 300.0
_LOWEST_MS, _HIGHEST_MS = 0.1, 100_000.0
_Y_LABELS = ((0.1, "0.1 ms"), (1, "1 ms"), (10, "10 ms"), (100, "100 ms"), (1000, "1 s"), (10_000, "10 s"))


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisMark:
    """A line of the grid, with its label."""

    at: float
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class AgeLine:
    """A line; `kind` is `own` or `thesis`."""

    points: str
    kind: str
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class AgeChart:
    """A chart in pixels; the vertical axis is logarithmic."""

    width: float
    height: float
    left: float
    right: float
    top: float
    bottom: float
    x_marks: tuple[AxisMark, ...]
    y_marks: tuple[AxisMark, ...]
    lines: tuple[AgeLine, ...]


def build_age_chart(runs: Sequence[tuple[str, Sequence[TrackPoint]]]) -> AgeChart:
    """Draw the ages of named runs."""
    lines = [
        AgeLine(points=_line((point.time_s, point.age_ms) for point in points), kind="own", title=title)
        for title, points in runs
    ]
    thesis = ((float(second), 1000.0 * second * THESIS_AGE_S / THESIS_AFTER_S) for second in range(1, 61))
    return AgeChart(
        width=_WIDTH,
        height=_HEIGHT,
        left=_LEFT,
        right=_WIDTH - _RIGHT,
        top=_TOP,
        bottom=_HEIGHT - _BOTTOM,
        x_marks=tuple(AxisMark(at=_x(second), label=f"{second} s") for second in range(0, 61, 10)),
        y_marks=tuple(AxisMark(at=_y(value), label=label) for value, label in _Y_LABELS),
        lines=(AgeLine(points=_line(thesis), kind="thesis", title="the thesis"), *lines),
    )


def _line(points: Iterable[tuple[float, float | None]]) -> str:
    """The highest age of each half second."""
    highest: dict[int, float] = {}
    for second, age in points:
        if age is not None and second <= THESIS_AFTER_S:
            highest[int(second * 2)] = max(age, highest.get(int(second * 2), 0.0))
    return " ".join(f"{_x(slot / 2):g},{_y(age):g}" for slot, age in highest.items())


def _x(second: float) -> float:
    return round(_LEFT + second / THESIS_AFTER_S * (_WIDTH - _LEFT - _RIGHT), 1)


def _y(age_ms: float) -> float:
    part = math.log(max(age_ms, _LOWEST_MS) / _LOWEST_MS) / math.log(_HIGHEST_MS / _LOWEST_MS)
    return round(_HEIGHT - _BOTTOM - part * (_HEIGHT - _TOP - _BOTTOM), 1)
