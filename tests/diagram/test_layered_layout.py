"""Layered layout without Graphviz: nothing overlaps, and given positions are kept."""

import itertools
import math

from hypothesis import given
from hypothesis import strategies as st

from tests.diagram.diagram_designs import find_overlaps, list_boxes, ring_design, shipped_designs
from vicode.diagram.layered_layout import complete_layout
from vicode.diagram.layout_fit import screens_needed
from vicode.model.design import CommonSection, Design, Point, State, Transition, Use

_coordinates = st.integers(-500, 2500).map(float) | st.sampled_from([0.0, 120.0, 1e9, -1e300, 1e300])
_places = st.none() | st.tuples(_coordinates, _coordinates)
_names = st.lists(st.text(max_size=4) | st.text("Wide name", min_size=15, max_size=40), unique=True, max_size=12)


@st.composite
def designs(draw: st.DrawFn) -> Design:
    names = draw(_names)
    targets = st.lists(st.sampled_from([*names, "nowhere"]), max_size=3)
    states = tuple(
        State(name=name, at=draw(_places), transitions=tuple(Transition(to=to) for to in draw(targets)))
        for name in names
    )
    uses = tuple(Use(alias=alias, component="C", at=draw(_places)) for alias in draw(_names))
    common = CommonSection(at=draw(_places), transitions=(Transition(to="nowhere"),))
    return Design(component="D", initial=draw(st.sampled_from([*names, ""])), states=states, uses=uses, common=common)


@given(designs())
def test_given_positions_are_kept_and_nothing_else_overlaps(design: Design) -> None:
    placement = complete_layout(design)
    kept = _given(design)
    boxes = list_boxes(design, placement)
    assert {name: boxes[name][0] for name in kept} == kept
    assert not find_overlaps(boxes, apart_from=kept)


def test_shipped_designs_without_positions_do_not_overlap() -> None:
    for design in shipped_designs():
        assert not find_overlaps(list_boxes(design, complete_layout(design)))


def test_three_thousand_states_are_about_as_wide_as_a_screen() -> None:
    design = ring_design(3000)
    states = complete_layout(design).states.values()
    assert len(set(states)) == 3000
    wide, high = (max(point[axis] for point in states) - min(point[axis] for point in states) for axis in (0, 1))
    assert 1 < wide / high < 3


def test_a_chain_is_folded_and_stays_together() -> None:
    design = ring_design(300, chords=0)
    states = complete_layout(design).states
    assert screens_needed(states.values()) < 5
    assert not find_overlaps(list_boxes(design, complete_layout(design)))
    places = [states[f"State{index}"] for index in range(300)]
    steps = [math.dist(one, other) for one, other in itertools.pairwise(places)]
    assert max(steps) < 300


def _given(design: Design) -> dict[str, Point]:
    places = {f"state {state.name}": state.at for state in design.states}
    places |= {f"use {use.alias}": use.at for use in design.uses} | {"common": design.common.at}
    return {name: at for name, at in places.items() if at is not None}
