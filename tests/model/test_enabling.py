"""What is disabled is kept, and the design works as if it were not there."""

from dataclasses import replace

from hypothesis import given

from tests.strategies.designs import designs
from vicode.model.design import Common, Design, Group, Guard, State, Stay, Transition
from vicode.model.enabling import disable, enabled_part
from vicode.model.walks import walk_decisions

DESIGN = Design(
    component="Player",
    initial="A",
    common=Common(transitions=(Transition(to="C"), Transition(to="B", disabled=True))),
    states=(
        State(
            name="A",
            transitions=(
                Group(guard=Guard(when="x"), then=(Transition(to="C"),)),
                Group(guard=Guard(when="y"), then=(Transition(to="C"), Stay()), otherwise=(Transition(to="B"),)),
                Transition(to="B"),
            ),
        ),
        State(name="B", transitions=(Stay(disabled=True), Group(then=(Stay(),), disabled=True))),
        State(name="C", disabled=True, transitions=(Transition(to="A"),)),
    ),
)


def test_what_is_disabled_and_what_leads_there_does_not_work() -> None:
    works = enabled_part(DESIGN)
    assert works.common.transitions == ()
    assert [state.name for state in works.states] == ["A", "B"]
    kept = Group(guard=Guard(when="y"), then=(Stay(),), otherwise=(Transition(to="B"),))
    assert works.states[0].transitions == (kept, Transition(to="B"))
    assert works.states[1].transitions == ()


def test_disabling_and_enabling_change_only_the_marks() -> None:
    off = disable(
        DESIGN, ["B"], [("states", "A", "transitions", 1, "then", 1), ("common", "transitions", 0)], flag=True
    )
    marks = [located.decision.disabled for located in walk_decisions(off)]
    assert marks == [True, True, False, False, False, False, True, False, False, True, True, False, False]
    assert [state.disabled for state in off.states] == [False, True, True]
    back = disable(off, ["B"], [("states", "A", "transitions", 1, "then", 1), ("common", "transitions", 0)], flag=False)
    assert back == DESIGN
    assert disable(DESIGN, ["Nobody"], [("states", "A", "transitions", 9)], flag=True) == DESIGN


@given(designs)
def test_what_works_works_as_it_is(design: Design) -> None:
    works = enabled_part(design)
    assert enabled_part(works) == works
    without = replace(design, states=tuple(state for state in design.states if not state.disabled))
    assert {state.name for state in works.states} == {state.name for state in without.states}
    assert not any(located.decision.disabled for located in walk_decisions(works))
