"""The chart of who waits for whom: a row per robot, colored by state; in a waiting state, the numbers of the others."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from vicode.experiments.age_chart import AxisMark
from vicode.model.design import Design, Transition
from vicode.simulated_robot.session import RobotTrack

_LEFT, _RIGHT, _TOP, _ROW, _BAR = 72.0, 12.0, 6.0, 38.0, 26.0
_WIDTH, _AXIS = 1080.0, 30.0
_TICK_S = 10
_CHARACTER_WIDTH = 7.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Bar:
    """A time in one state; while it waits, `label` are the robots that it waits for."""

    x: float
    width: float
    color: int
    is_waiting: bool
    label: str
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitRow:
    """A robot."""

    y: float
    label: str
    bars: tuple[Bar, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitChart:
    """A chart in pixels."""

    width: float
    height: float
    left: float
    bar_height: float
    x_marks: tuple[AxisMark, ...]
    rows: tuple[WaitRow, ...]


def find_waiting_states(design: Design) -> dict[str, tuple[str, bool]]:
    """The states that can only be left for a cooperative state, with that state and whether it has a capacity."""
    cooperative = {
        state.name: state.capacity is not None
        for state in design.states
        if state.capacity is not None or state.synchronized
    }
    found = {}
    for state in design.states:
        targets = {item.to if isinstance(item, Transition) else "" for item in state.transitions}
        target = targets.pop() if len(targets) == 1 else ""
        if target in cooperative:
            found[state.name] = (target, cooperative[target])
    return found


def build_wait_chart(
    tracks: Sequence[RobotTrack], waiting: Mapping[str, tuple[str, bool]], colors: Mapping[str, int]
) -> WaitChart:
    """Draw a run.

    Args:
        tracks: The robots, with points at the same times.
        waiting: Result of `find_waiting_states`.
        colors: Number of the color of each state.
    """
    last = max(track.points[-1].time_s for track in tracks)
    factor = (_WIDTH - _LEFT - _RIGHT) / last
    rows = tuple(
        WaitRow(
            y=_TOP + number * _ROW,
            label=f"robot {track.robot.number}",
            bars=tuple(_bars(track, tracks, waiting, colors, factor)),
        )
        for number, track in enumerate(tracks)
    )
    return WaitChart(
        width=_WIDTH,
        height=_TOP + len(rows) * _ROW + _AXIS,
        left=_LEFT,
        bar_height=_BAR,
        x_marks=tuple(
            AxisMark(at=round(_LEFT + second * factor, 1), label=f"{second} s")
            for second in range(0, int(last) + 1, _TICK_S)
        ),
        rows=rows,
    )


def _bars(
    track: RobotTrack,
    tracks: Sequence[RobotTrack],
    waiting: Mapping[str, tuple[str, bool]],
    colors: Mapping[str, int],
    factor: float,
) -> Iterable[Bar]:
    situations = [
        (point.state, _awaited(tick, track, tracks, waiting.get(point.state)))
        for tick, point in enumerate(track.points)
    ]
    tick = 0
    for (state, others), group in groupby(situations):
        first, last = track.points[tick], track.points[min(tick + len(list(group)), len(track.points) - 1)]
        tick = track.points.index(last, tick)
        width = (last.time_s - first.time_s) * factor
        label = f"waits for {', '.join(map(str, others))}" if others else state
        shown = next((text for text in (label, ", ".join(map(str, others))) if _fits(text, width)), "")
        yield Bar(
            x=round(_LEFT + first.time_s * factor, 1),
            width=round(width, 1),
            color=colors.get(state, 0),
            is_waiting=bool(others),
            label=shown,
            title=f"robot {track.robot.number}, {first.time_s:.1f} s to {last.time_s:.1f} s: {state}"
            + (f", {label}" if others else ""),
        )


def _awaited(
    tick: int, track: RobotTrack, tracks: Sequence[RobotTrack], target: tuple[str, bool] | None
) -> tuple[int, ...]:
    """The robots that a robot in a waiting state waits for: those inside a full state, or those that have not come."""
    if target is None:
        return ()
    state, has_capacity = target
    own = track.points[tick].state
    others = ((each.robot.number, each.points[tick].state) for each in tracks if each is not track)
    return tuple(number for number, now in others if (now == state if has_capacity else now not in (own, state)))


def _fits(text: str, width: float) -> bool:
    return len(text) * _CHARACTER_WIDTH + 8 <= width
