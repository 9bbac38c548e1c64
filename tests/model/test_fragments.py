"""Extracting fragments and inserting them with unique names and ids."""

from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.designs import designs
from vicode.model.design import (
    Assign,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Design,
    Guard,
    RunCode,
    State,
    Transition,
    Use,
)
from vicode.model.fragments import (
    FragmentSelection,
    append_decisions,
    duplicate_decision,
    extract_fragment,
    insert_fragment,
)
from vicode.model.traversal import iter_decisions, iter_transitions
from vicode.store import read_design, save_design

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(
        Use(alias="head", component="Head", at=(5, 5)),
        Use(alias="legs", component="Legs"),
        Use(alias="eyes", component="Eyes"),
    ),
    common=CommonSection(transitions=(Transition(to="C"),)),
    states=(
        State(
            name="A",
            at=(0, 0),
            requires=("head",),
            actions=(RunCode(code=Code(texts=(("python", "self.legs.go()"),)), id="go"),),
            transitions=(
                Transition(to="B", id="a_to_b"),
                Transition(to="C"),
                DecisionGroup(guard=Guard(when="x"), then=(Transition(to="C"),)),
            ),
        ),
        State(name="B", at=(200, 0), transitions=(Transition(to="A", guard=Guard(when="eyes.open")),)),
        State(name="C"),
    ),
)
ALL = {"Head", "Legs", "Eyes"}


def arrows(design: Design) -> list[tuple[str, str]]:
    return [(at.source, at.decision.to) for at in iter_transitions(design) if isinstance(at.decision, Transition)]


def test_a_fragment_includes_the_components_it_refers_to() -> None:
    assert [use.alias for use in extract_fragment(DESIGN, FragmentSelection(states=["A"])).uses] == ["head", "legs"]
    assert [use.alias for use in extract_fragment(DESIGN, FragmentSelection(states=["B"])).uses] == ["eyes"]
    assert extract_fragment(DESIGN, FragmentSelection(states=["C"], aliases=["legs"])).uses == (DESIGN.uses[1],)


def test_inserted_names_are_unique_and_inner_transitions_are_kept() -> None:
    joined = insert_fragment(
        DESIGN, extract_fragment(DESIGN, FragmentSelection(states=["A", "B"])), available=ALL, offset=(40, 90)
    )
    assert joined.states == ("A2", "B2")
    assert arrows(joined.design)[-4:] == [("A2", "B2"), ("A2", "C"), ("A2", "C"), ("B2", "A2")]
    assert joined.design.states[3].at == (40, 90)
    assert (joined.design.uses, joined.design.initial) == (DESIGN.uses, "A")


def test_dangling_transitions_and_empty_groups_are_dropped() -> None:
    joined = insert_fragment(
        Design(component="Other"), extract_fragment(DESIGN, FragmentSelection(states=["A", "B"])), available=ALL
    )
    assert arrows(joined.design) == [("A", "B"), ("B", "A")]
    assert len(joined.design.states[0].transitions) == 1
    assert joined.design.initial == "A"
    assert [use.component for use in joined.design.uses] == ["Head", "Legs", "Eyes"]


def test_a_conflicting_alias_is_renamed() -> None:
    other = Design(component="Other", uses=(Use(alias="legs", component="Wheels"), Use(alias="head", component="Head")))
    joined = insert_fragment(other, extract_fragment(DESIGN, FragmentSelection(states=["A"])), available=ALL)
    assert [(use.alias, use.component) for use in joined.design.uses][2:] == [("legs2", "Legs")]
    (action,) = joined.design.states[0].actions
    assert isinstance(action, RunCode)
    assert action.code.in_language("python") == "self.legs2.go()"


def test_unavailable_components_are_reported() -> None:
    joined = insert_fragment(
        Design(component="Other"), extract_fragment(DESIGN, FragmentSelection(states=["A"])), available={"Head"}
    )
    assert joined.missing == ("Legs",)
    assert [use.alias for use in joined.design.uses] == ["head"]


def test_ids_of_code_are_unique() -> None:
    joined = insert_fragment(DESIGN, extract_fragment(DESIGN, FragmentSelection(states=["A"])), available=ALL)
    copy = joined.design.states[-1]
    assert isinstance(copy.actions[0], RunCode)
    assert (copy.actions[0].id, copy.transitions[0].id) == ("go2", "a_to_b2")
    cut = insert_fragment(
        Design(component="Other"), extract_fragment(DESIGN, FragmentSelection(states=["A"])), available=ALL
    )
    assert isinstance(cut.design.states[0].actions[0], RunCode)
    assert cut.design.states[0].actions[0].id == "go"


def test_numbers_at_the_end_of_names_are_incremented() -> None:
    design = Design(component="X", states=(State(name="Kick2"), State(name="Kick3"), State(name="7")))
    joined = insert_fragment(design, design, available=())
    assert joined.states == ("Kick4", "Kick5", "72")


def test_transitions_are_appended_to_other_states() -> None:
    part = extract_fragment(DESIGN, FragmentSelection(decisions=[("states", "A", "transitions", 0)]))
    assert [item.to for item in part.common.transitions if isinstance(item, Transition)] == ["B"]
    joined = append_decisions(DESIGN, part, ["B", "C"], available=ALL)
    assert arrows(joined.design)[-2:] == [("B", "B"), ("C", "B")]


def test_the_common_section_is_inserted_once() -> None:
    part = extract_fragment(DESIGN, FragmentSelection(states=["C"], common=True))
    assert insert_fragment(DESIGN, part, available=()).design.common.transitions == (
        Transition(to="C"),
        Transition(to="C2"),
    )
    lone = Design(
        component="X", states=(State(name="C"),), common=CommonSection(actions=(Assign(values=(("x", "1"),)),))
    )
    again = insert_fragment(lone, replace_states(lone), available=())
    assert len(again.design.common.actions) == 1


def replace_states(design: Design) -> Design:
    return Design(component=design.component, common=design.common)


def test_duplicate_decision_inserts_the_copy_after_it() -> None:
    twice = duplicate_decision(DESIGN, ("states", "A", "transitions", 0))
    assert [getattr(item, "id", "") for item in twice.states[0].transitions] == ["a_to_b", "a_to_b2", "", ""]
    assert duplicate_decision(DESIGN, ("states", "A", "transitions", 9)) is DESIGN


@given(designs, designs, st.data())
def test_any_fragment_can_be_inserted_into_any_design(design: Design, other: Design, data: st.DataObject) -> None:
    names = data.draw(st.lists(st.sampled_from([state.name for state in design.states] or ["x"]), max_size=3))
    part = extract_fragment(design, FragmentSelection(states=names, common=data.draw(st.booleans())))
    joined = insert_fragment(other, part, available={use.component for use in part.uses})
    result = joined.design
    assert len({state.name for state in result.states}) == len(other.states) + len(part.states)
    assert result.states[: len(other.states)] == other.states
    new = [located for located in iter_decisions(result) if located.source in joined.states]
    there = {state.name for state in result.states}
    assert all(at.decision.to in there for at in new if isinstance(at.decision, Transition))
    assert read_design(save_design(result)).design == result


def test_calls_count_as_references() -> None:
    design = Design(
        component="X",
        uses=(Use(alias="head", component="Head"),),
        states=(State(name="A", modulates=(Call(alias="head"),)), State(name="B", actions=(Call(alias="head"),))),
    )
    for name in "AB":
        assert extract_fragment(design, FragmentSelection(states=[name])).uses == design.uses
