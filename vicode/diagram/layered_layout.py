"""Positions for elements without one: a simple layered layout, so that every design can be drawn immediately.

A state is in the column of its distance from the initial state. Columns higher than a screen are split, and a long row
of them is folded into bands of alternating direction. Elements with a position stay, and others take the first free
place in their column, so one new state moves nothing. It is no replacement for Graphviz, but needs no process and
cannot fail.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count

from vicode.diagram.node_geometry import COMMON_SIZE, MIN_WIDTH, OccupancyGrid, state_size, use_size
from vicode.model.design import Design, DiagramNote, Point, Transition
from vicode.model.traversal import iter_decisions

COLUMN, ROW = 240.0, 110.0
ORIGIN = (120.0, 100.0)
_COLUMN_GAP = 100.0
_SCREEN_RATIO = 1.6
_MIN_ROWS = 8
# A position farther out is a typo; floating point would lose the steps within a row.
_MAX_COORDINATE = 1e7


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeLayout:
    """Center positions in pixels of states, used components (by alias) and the badge of common transitions.

    `notes` contains only those that move with the states.
    """

    states: dict[str, Point]
    uses: dict[str, Point]
    common: Point
    notes: dict[str, Point] = field(default_factory=dict)


def complete_layout(design: Design) -> NodeLayout:
    """The positions of a design, completed for the rest: states in columns by their distance from the initial state."""
    occupied = OccupancyGrid()
    states = {state.name: state.at for state in design.states if state.at}
    for name, at in states.items():
        occupied.occupy(at, state_size(name))
    for use in design.uses:
        if use.at:
            occupied.occupy(use.at, use_size(use.alias, use.component))
    if design.common.at:
        occupied.occupy(design.common.at, COMMON_SIZE)
    states |= _layout_states(design, occupied, states)
    placed = (*states.values(), *(use.at for use in design.uses if use.at))
    below = max((y for _x, y in placed if abs(y) < _MAX_COORDINATE), default=ORIGIN[1]) + 1.5 * ROW
    uses = _layout_uses(design, occupied, below)
    common = design.common.at
    if common is None:
        left = min((x for x, _y in states.values() if abs(x) < _MAX_COORDINATE), default=ORIGIN[0])
        top = min((y for _x, y in states.values() if abs(y) < _MAX_COORDINATE), default=ORIGIN[1])
        common = occupied.occupy_first_free(_upwards((left, min(ORIGIN[1], top) - ROW)), COMMON_SIZE)
    return NodeLayout(states=states, uses=uses, common=common)


def note_position(note: DiagramNote, index: int) -> Point:
    """The position of a note; without one, notes are below each other at the left."""
    return note.at or (ORIGIN[0] - COLUMN, ORIGIN[1] + index * ROW)


def _layout_states(design: Design, occupied: OccupancyGrid, given: Iterable[str]) -> dict[str, Point]:
    """Each layer is a column, or several if it is higher than a screen; a long row of layers is folded."""
    known = set(given)
    rows = max(_MIN_ROWS, math.ceil(math.sqrt(len(design.states) * COLUMN / ROW / _SCREEN_RATIO)))
    columns = [names[start : start + rows] for names in _layers(design) for start in range(0, len(names), rows)]
    states: dict[str, Point] = {}
    for column, (middle, top) in zip(columns, _fold_columns(columns), strict=True):
        free = {name: state_size(name) for name in column if name not in known}
        states |= {name: occupied.occupy_first_free(_downwards((middle, top)), size) for name, size in free.items()}
    return states


def _fold_columns(columns: Sequence[Sequence[str]]) -> Iterator[Point]:
    """The center and the top of every column, in bands of alternating direction, so that neighbors stay close."""
    widths = [max(state_size(name).width for name in column) + _COLUMN_GAP for column in columns]
    highest = max((len(column) for column in columns), default=1) * ROW
    bands = max(1, round(math.sqrt(sum(widths) / (_SCREEN_RATIO * highest))))
    widest = max(sum(widths) / bands, max(widths, default=0.0))
    left, top, height, is_back = 0.0, ORIGIN[1], 0.0, False
    for column, width in zip(columns, widths, strict=True):
        if left + width > widest + 1 and left > 0 and bands > 1:
            left, top, height, is_back = 0.0, top + height + ROW / 2, 0.0, not is_back
        middle = widest - left - width / 2 if is_back else left + width / 2
        yield ORIGIN[0] - MIN_WIDTH / 2 - _COLUMN_GAP / 2 + middle, top
        left, height = left + width, max(height, len(column) * ROW)


def _layout_uses(design: Design, occupied: OccupancyGrid, below: float) -> dict[str, Point]:
    """Place used components in rows below the states."""
    uses: dict[str, Point] = {}
    positions = _row_positions((ORIGIN[0], below))
    for use in design.uses:
        uses[use.alias] = use.at or occupied.occupy_first_free(positions, use_size(use.alias, use.component))
    return uses


def _layers(design: Design) -> Iterator[list[str]]:
    """States by their distance from the initial one; unreachable states come last."""
    leads: dict[str, list[str]] = {}
    for located in iter_decisions(design):
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


def _downwards(start: Point) -> Iterator[Point]:
    return ((start[0], start[1] + row * ROW) for row in count())


def _upwards(start: Point) -> Iterator[Point]:
    return ((start[0], start[1] - row * ROW) for row in count())


def _row_positions(start: Point) -> Iterator[Point]:
    return ((start[0] + column * COLUMN, start[1] + row * ROW) for row in count() for column in range(_MIN_ROWS))
