"""An SVG plot of values over time: a strip per value, a band of states, and a cursor."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape

WIDTH, STRIP, GAP, BAND = 600, 52, 6, 18
_NAME_HEIGHT = 14
"""The space above each curve for its name."""
_MAX_POINTS = 300
_MIN_LABEL_WIDTH = 46
_COLORS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotSeries:
    """One value per iteration, nan where it is missing."""

    name: str
    values: Sequence[float]


def render_series(curves: Sequence[PlotSeries], states: Sequence[str]) -> str:
    """The part of a plot that does not depend on the cursor."""
    count = max(len(states), 1)
    parts = [_strip(curve, index, count) for index, curve in enumerate(curves)]
    parts.append(_band(states, len(curves) * (STRIP + GAP), count))
    return "".join(parts)


def add_cursor(series: str, curves: Sequence[PlotSeries], states: Sequence[str], cursor: int) -> str:
    """The plot with its cursor, the number of the current iteration, 0 before the first.

    The drawing has a fixed width and is stretched by the browser, so it contains no text elements.
    """
    count = max(len(states), 1)
    height = len(curves) * (STRIP + GAP) + BAND
    x = WIDTH * max(cursor - 0.5, 0) / count
    line = f'<line class="plot-cursor" x1="{x:.1f}" x2="{x:.1f}" y1="0" y2="{height}"/>'
    label = f"{len(curves)} values over {len(states)} iterations"
    return (
        f'<svg class="plot" viewBox="0 0 {WIDTH} {height}" preserveAspectRatio="none" '
        f'style="height:{height}px" role="img" aria-label="{label}">{series}{line}</svg>'
    )


def _strip(curve: PlotSeries, index: int, count: int) -> str:
    top = index * (STRIP + GAP)
    known = [value for value in curve.values if math.isfinite(value)]
    low, high = (min(known), max(known)) if known else (0.0, 1.0)
    span = (high - low) or 1.0
    middle = 0.5 if high == low else 0.0

    def y_of(value: float) -> float:
        return top + STRIP - 4 - (STRIP - _NAME_HEIGHT - 8) * ((value - low) / span + middle)

    path = _path(curve.values, count, y_of)
    ground = f'<rect class="plot-ground" x="0" y="{top}" width="{WIDTH}" height="{STRIP}"/>'
    return f'{ground}<path class="plot-line c{index % _COLORS}" d="{path}"/>'


def _path(values: Sequence[float], count: int, y_of: Callable[[float], float]) -> str:
    """A step curve, as a value holds until the next iteration."""
    commands: list[str] = []
    pen_down = False
    for number, value in _downsample(values):
        if not math.isfinite(value):
            pen_down = False
            continue
        x, next_x = WIDTH * number / count, WIDTH * (number + 1) / count
        commands.append(f"{'L' if pen_down else 'M'}{x:.1f} {y_of(value):.1f}H{next_x:.1f}")
        pen_down = True
    return "".join(commands)


def _downsample(values: Sequence[float]) -> list[tuple[int, float]]:
    """The values with their indices; of long series only the minimum and maximum of each part."""
    if len(values) <= _MAX_POINTS:
        return list(enumerate(values))
    size = math.ceil(len(values) / (_MAX_POINTS / 2))
    kept: list[tuple[int, float]] = []
    for start in range(0, len(values), size):
        part = [(start + index, value) for index, value in enumerate(values[start : start + size])]
        finite = [pair for pair in part if math.isfinite(pair[1])] or part[:1]
        ends = {min(finite, key=lambda pair: pair[1]), max(finite, key=lambda pair: pair[1])}
        kept += sorted(ends)
    return kept


def state_runs(states: Sequence[str]) -> list[tuple[str, int, int]]:
    """Runs of equal states: the name, the first index, and the index after the last."""
    runs: list[tuple[str, int, int]] = []
    for index, state in enumerate(states):
        if runs and runs[-1][0] == state:
            runs[-1] = (state, runs[-1][1], index + 1)
        else:
            runs.append((state, index, index + 1))
    return runs


def _band(states: Sequence[str], top: int, count: int) -> str:
    order = list(dict.fromkeys(states))
    parts = []
    for state, start, end in _merge_narrow(state_runs(states), count):
        x, width = WIDTH * start / count, WIDTH * (end - start) / count
        color = order.index(state) % _COLORS
        parts.append(
            f'<rect class="plot-state c{color}" x="{x:.1f}" y="{top}" width="{width:.1f}" height="{BAND}">'
            f"<title>{escape(state)}</title></rect>"
        )
    return "".join(parts)


def _merge_narrow(runs: list[tuple[str, int, int]], count: int) -> list[tuple[str, int, int]]:
    """Runs of which none is narrower than a pixel: of narrow neighbors, the longest stands for all."""
    if len(runs) <= WIDTH:
        return runs
    pixel = count / WIDTH
    merged: list[tuple[str, int, int]] = []
    longest = 0
    for state, start, end in runs:
        if merged and end - merged[-1][1] <= pixel:
            name = state if end - start > longest else merged[-1][0]
            merged[-1] = (name, merged[-1][1], end)
            longest = max(longest, end - start)
        else:
            merged.append((state, start, end))
            longest = end - start
    return merged


def band_labels(states: Sequence[str]) -> list[tuple[str, float, float]]:
    """The names of the runs that are wide enough for a label, each with its left end and its width in percent."""
    count = max(len(states), 1)
    return [
        (state, 100 * start / count, 100 * (end - start) / count)
        for state, start, end in state_runs(states)
        if WIDTH * (end - start) / count >= _MIN_LABEL_WIDTH
    ]
