"""Notes and the states that they explain: the nearest ones."""

import math

from vicode.diagram.layered_layout import NodeLayout, note_position
from vicode.diagram.node_geometry import OccupancyGrid, Size, note_size
from vicode.model.design import Design, Point

_GAP, _STEP, _RINGS = 16.0, 20.0, 60


def nearest_states(design: Design, layout: NodeLayout) -> dict[str, str]:
    """The nearest state of every note, by the name of the note; empty without states."""
    return {
        note.name: min(layout.states, key=lambda name: math.dist(layout.states[name], at))
        for note, at in ((note, note_position(note, index)) for index, note in enumerate(design.notes))
        if layout.states
    }


def follow_states(design: Design, before: NodeLayout, after: NodeLayout, occupied: OccupancyGrid) -> dict[str, Point]:
    """The positions of notes after a layout: at the same place relative to their states, or at the nearest free one."""
    nearest = nearest_states(design, before)
    places: dict[str, Point] = {}
    for index, note in enumerate(design.notes):
        at, state = note_position(note, index), nearest.get(note.name)
        if state is None:
            continue
        moved = (after.states[state][0] - before.states[state][0], after.states[state][1] - before.states[state][1])
        size = note_size(note.text)
        places[note.name] = _free_place((at[0] + moved[0], at[1] + moved[1]), size, occupied)
        occupied.occupy(places[note.name], size)
    return places


def _free_place(wanted: Point, size: Size, occupied: OccupancyGrid) -> Point:
    for ring in range(_RINGS):
        reach = ring * _STEP
        corners = [(dx * reach, dy * reach) for dx, dy in ((0, 0), (0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, 1))]
        for dx, dy in corners if ring else corners[:1]:
            at = (wanted[0] + dx, wanted[1] + dy)
            if occupied.is_free(at, size, _GAP):
                return at
    return wanted
