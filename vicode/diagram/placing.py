"""Places for what a design gives no place to: a simple layering, so that every design can be drawn at once."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count

from vicode.model.design import Design, Point, Transition
from vicode.model.walks import walk_decisions

COLUMN, ROW = 240.0, 110.0
ORIGIN = (120.0, 100.0)
_NEAR = (150.0, 60.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """A centre in pixels for every state, every used component (by alias) and the badge of common transitions."""

    states: dict[str, Point]
    uses: dict[str, Point]
    common: Point


def place(design: Design) -> Placement:
    """The places a design gives, and free ones for the rest: states in columns by their distance from the start."""
    states = {state.name: state.at for state in design.states if state.at}
    taken = list(states.values()) + [use.at for use in design.uses if use.at]
    if design.common.at:
        taken.append(design.common.at)
    for column, names in enumerate(_columns(design)):
        for name in names:
            if name not in states:
                states[name] = _free(_down((ORIGIN[0] + column * COLUMN, ORIGIN[1])), taken)
                taken.append(states[name])
    below = max((y for _x, y in taken), default=ORIGIN[1]) + 1.5 * ROW
    uses: dict[str, Point] = {}
    for use in design.uses:
        uses[use.alias] = use.at or _free(_across((ORIGIN[0], below)), taken)
        taken.append(uses[use.alias])
    left = min((x for x, _y in states.values()), default=ORIGIN[0])
    common = design.common.at or _free(_down((left, min(ORIGIN[1] - ROW, below - 3 * ROW))), taken)
    return Placement(states=states, uses=uses, common=common)


def _columns(design: Design) -> Iterator[list[str]]:
    """States by the number of transitions from the initial one; those nobody reaches stand last."""
    leads: dict[str, list[str]] = {}
    for located in walk_decisions(design):
        if isinstance(located.decision, Transition):
            leads.setdefault(located.source, []).append(located.decision.to)
    left = {state.name: None for state in design.states}
    column = [design.initial] if design.initial in left else list(left)[:1]
    while column:
        for name in column:
            del left[name]
        yield column
        nexts = (to for name in column for to in leads.get(name, ()))
        column = [name for name in dict.fromkeys(nexts) if name in left]
        if not column and left:
            column = list(left)


def _down(start: Point) -> Iterator[Point]:
    return ((start[0], start[1] + row * ROW) for row in count())


def _across(start: Point) -> Iterator[Point]:
    return ((start[0] + column * COLUMN * 0.75, start[1]) for column in count())


def _free(candidates: Iterable[Point], taken: list[Point]) -> Point:
    """The first candidate that keeps its distance from all that is taken."""
    return next(
        point
        for point in candidates
        if all(abs(point[0] - x) >= _NEAR[0] or abs(point[1] - y) >= _NEAR[1] for x, y in taken)
    )
