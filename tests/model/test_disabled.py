"""Disabled items stay in the design, but have no effect."""

from dataclasses import replace

from hypothesis import given

from tests.strategies.designs import designs
from vicode.model.design import CommonSection, DecisionGroup, Design, Guard, State, Stay, Transition
from vicode.model.disabled import strip_disabled
from vicode.model.edits import set_disabled
from vicode.model.traversal import iter_decisions

DESIGN = Design(
    component="Player",
    initial="A",
    common=CommonSection(transitions=(Transition(to="C"), Transition(to="B", disabled=True))),
    states=(
        State(
            name="A",
            transitions=(
                DecisionGroup(guard=Guard(when="x"), then=(Transition(to="C"),)),
                DecisionGroup(
                    guard=Guard(when="y"), then=(Transition(to="C"), Stay()), otherwise=(Transition(to="B"),)
                ),
                Transition(to="B"),
            ),
        ),
        State(name="B", transitions=(Stay(disabled=True), DecisionGroup(then=(Stay(),), disabled=True))),
        State(name="C", disabled=True, transitions=(Transition(to="A"),)),
    ),
)


def test_strip_disabled_removes_disabled_items_and_transitions_to_them() -> None:
    works = strip_disabled(DESIGN)
    assert works.common.transitions == ()
    assert [state.name for state in works.states] == ["A", "B"]
    kept = DecisionGroup(guard=Guard(when="y"), then=(Stay(),), otherwise=(Transition(to="B"),))
    assert works.states[0].transitions == (kept, Transition(to="B"))
    assert works.states[1].transitions == ()


def test_set_disabled_changes_only_the_flags() -> None:
    off = set_disabled(
        DESIGN, ["B"], [("states", "A", "transitions", 1, "then", 1), ("common", "transitions", 0)], disabled=True
    )
    marks = [located.decision.disabled for located in iter_decisions(off)]
    assert marks == [True, True, False, False, False, False, True, False, False, True, True, False, False]
    assert [state.disabled for state in off.states] == [False, True, True]
    back = set_disabled(
        off, ["B"], [("states", "A", "transitions", 1, "then", 1), ("common", "transitions", 0)], disabled=False
    )
    assert back == DESIGN
    assert set_disabled(DESIGN, ["Nobody"], [("states", "A", "transitions", 9)], disabled=True) == DESIGN


@given(designs)
def test_strip_disabled_keeps_enabled_items(design: Design) -> None:
    works = strip_disabled(design)
    assert strip_disabled(works) == works
    without = replace(design, states=tuple(state for state in design.states if not state.disabled))
    assert {state.name for state in works.states} == {state.name for state in without.states}
    assert not any(located.decision.disabled for located in iter_decisions(works))
