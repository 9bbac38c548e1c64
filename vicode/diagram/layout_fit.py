"""Fits a computed layout to the canvas: on the grid, and clear of elements that stay.

A layout of some states does not know the others. The part is moved as a whole to the place where it was, and from there
in growing steps in four directions until it covers nothing: its own arrangement, which was computed, is kept.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from itertools import count

from vicode.diagram.drawn_transitions import shows_common
from vicode.diagram.layered_layout import ORIGIN, NodeLayout, complete_layout
from vicode.diagram.layout_graph import COMMON_ID, state_ids, use_ids
from vicode.diagram.node_geometry import COMMON_SIZE, MIN_WIDTH, OccupancyGrid, Size, state_size, use_size
from vicode.diagram.notes import follow_states
from vicode.model.design import CommonSection, Design, Point
from vicode.model.edits import move_nodes

GRID = 10.0
_STEPS = 60
_SCREEN, _BOX = Size(width=1280, height=800), Size(width=MIN_WIDTH, height=60)


def fit_layout(design: Design, centers: Mapping[str, Point], only: Collection[str] | None) -> NodeLayout:
    """Positions of the whole design, given new centers by id of all nodes or of the states in `only`."""
    layout = _fit_nodes(design, centers, only)
    if not design.notes:
        return layout
    notes = follow_states(design, complete_layout(design), layout, _occupied_by_others(design, layout, ()))
    return replace(layout, notes={name: _snapped(at, (0, 0)) for name, at in notes.items()})


def _fit_nodes(design: Design, centers: Mapping[str, Point], only: Collection[str] | None) -> NodeLayout:
    states = {name: centers[id_] for name, id_ in state_ids(design).items() if id_ in centers}
    if only is not None:
        return _fit_part(design, states)
    uses = {alias: centers[id_] for alias, id_ in use_ids(design).items() if id_ in centers}
    common = centers.get(COMMON_ID)
    if not centers:
        return complete_layout(design)
    left, top = min(x for x, _y in centers.values()), min(y for _x, y in centers.values())
    by = (ORIGIN[0] - left, ORIGIN[1] - top)
    moved = move_nodes(
        design,
        {name: _snapped(at, by) for name, at in states.items()},
        {alias: _snapped(at, by) for alias, at in uses.items()},
        _snapped(common, by) if common else None,
    )
    return complete_layout(moved)


def layered_positions(design: Design, only: Collection[str] | None) -> dict[str, Point]:
    """Centers by id from the layered layout, ignoring existing positions of the nodes to move."""
    states = tuple(replace(state, at=None) for state in design.states if only is None or state.name in only)
    if only is not None:
        part = replace(design, states=states, uses=(), common=CommonSection())
        return {state_ids(design)[name]: at for name, at in complete_layout(part).states.items()}
    uses = tuple(replace(use, at=None) for use in design.uses)
    placement = complete_layout(replace(design, states=states, uses=uses, common=replace(design.common, at=None)))
    centers = {id_: placement.states[name] for name, id_ in state_ids(design).items()}
    centers |= {id_: placement.uses[alias] for alias, id_ in use_ids(design).items()}
    if shows_common(design):
        centers[COMMON_ID] = placement.common
    return centers


def screens_needed(centers: Collection[Point]) -> float:
    """How many screens of 1280 by 800 pixels boxes with these centers need in their larger dimension."""
    xs, ys = [x for x, _y in centers] or [0.0], [y for _x, y in centers] or [0.0]
    return max((max(xs) - min(xs) + _BOX.width) / _SCREEN.width, (max(ys) - min(ys) + _BOX.height) / _SCREEN.height)


def _fit_part(design: Design, states: Mapping[str, Point]) -> NodeLayout:
    """Keep a moved part as a whole where it was, or at the nearest free position."""
    before = complete_layout(design)
    if not states:
        return before
    rest = _occupied_by_others(design, before, states)
    wanted, is_now = _center([before.states[name] for name in states]), _center(states.values())
    start = (wanted[0] - is_now[0], wanted[1] - is_now[1])
    sizes = {name: state_size(name) for name in states}
    by = next(
        by
        for by in _candidate_shifts(start, _search_extent(before, states))
        if all(rest.is_free(_snapped(at, by), sizes[name]) for name, at in states.items())
    )
    return replace(before, states=before.states | {name: _snapped(at, by) for name, at in states.items()})


def _occupied_by_others(design: Design, placement: NodeLayout, moved: Collection[str]) -> OccupancyGrid:
    occupied = OccupancyGrid()
    for name, at in placement.states.items():
        if name not in moved:
            occupied.occupy(at, state_size(name))
    for use in design.uses:
        occupied.occupy(placement.uses[use.alias], use_size(use.alias, use.component))
    if shows_common(design):
        occupied.occupy(placement.common, COMMON_SIZE)
    return occupied


def _center(points: Collection[Point]) -> Point:
    xs, ys = [x for x, _y in points], [y for _x, y in points]
    return (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2


def _search_extent(placement: NodeLayout, states: Mapping[str, Point]) -> Size:
    """The extent of everything and of the part: a larger shift is always clear of the rest."""
    xs = [x for x, _y in (*placement.states.values(), *placement.uses.values())]
    ys = [y for _x, y in (*placement.states.values(), *placement.uses.values())]
    wide = max(x for x, _y in states.values()) - min(x for x, _y in states.values())
    high = max(y for _x, y in states.values()) - min(y for _x, y in states.values())
    return Size(width=max(xs) - min(xs) + wide + 600, height=max(ys) - min(ys) + high + 300)


def _candidate_shifts(start: Point, reach: Size) -> Iterator[Point]:
    """Shifts of growing distance in four directions, limited to what a screen would show."""
    yield start
    for step in count(1):
        right, down = max(GRID, reach.width / _STEPS) * step, max(GRID, reach.height / _STEPS) * step
        yield start[0], start[1] + down
        yield start[0] + right, start[1]
        yield start[0], start[1] - down
        yield start[0] - right, start[1]


def _snapped(at: Point, by: Point) -> Point:
    return round((at[0] + by[0]) / GRID) * GRID, round((at[1] + by[1]) / GRID) * GRID
