"""Three-way merges: independent edits are merged; overlapping edits are conflicts with path and both values."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given

from tests.strategies.designs import designs, states
from vicode.model.design import (
    Assign,
    Code,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.edits import (
    add_requirement,
    add_state,
    add_transition,
    remove_states,
    rename_state,
    rename_use,
    reorder_decision,
    update_state,
)
from vicode.model.merge import merge_designs

BASE = Design(
    component="Player",
    doc="plays\n\nuntil it scores",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    variables=(Declaration(name="n", type="int"), Declaration(name="m")),
    states=(
        State(name="A", at=(0, 0), doc="first", transitions=(Transition(to="B", guard=Guard(when="x")), Stay())),
        State(name="B", at=(9, 0), requires=("head",), actions=(Assign(values=(("n", "1"), ("m", "2"))),)),
        State(name="C", at=(0, 9), transitions=(Transition(to="A"),)),
    ),
)


def with_doc(design: Design, name: str, doc: str) -> Design:
    return update_state(design, name, lambda state: replace(state, doc=doc))


def merged(ours: Design, theirs: Design) -> Design:
    """Merge two sides without conflicts."""
    result = merge_designs(BASE, ours, theirs)
    assert result.conflicts == ()
    return result.design


def paths(ours: Design, theirs: Design) -> list[Any]:
    return [conflict.path for conflict in merge_designs(BASE, ours, theirs).conflicts]


def test_edits_of_different_items_are_merged() -> None:
    ours = with_doc(add_state(BASE, State(name="D")), "A", "mine")
    theirs = with_doc(add_state(replace(BASE, frequency_hz=5.0), State(name="E")), "B", "theirs")
    both = merged(ours, theirs)
    assert [state.name for state in both.states] == ["A", "B", "C", "D", "E"]
    assert (both.frequency_hz, both.states[0].doc, both.states[1].doc) == (5.0, "mine", "theirs")


def test_a_rename_is_merged_with_edits_of_the_other_side() -> None:
    ours = rename_state(BASE, "A", "Begin")
    theirs = add_transition(with_doc(BASE, "A", "theirs"), "C", "A", Guard(when="y"))
    both = merged(ours, theirs)
    assert both.states[0].name == "Begin"
    assert both.states[0].doc == "theirs"
    assert [each.to for each in both.states[2].transitions if isinstance(each, Transition)] == ["Begin", "Begin"]
    assert merged(theirs, ours).states[0].doc == "theirs"


def test_a_renamed_alias_applies_to_links_of_the_other_side() -> None:
    both = merged(rename_use(BASE, "head", "neck"), add_requirement(BASE, "A", "head"))
    assert both.state("A") == replace(BASE.states[0], requires=("neck",))


def test_two_renames_of_one_item_are_a_conflict() -> None:
    result = merge_designs(BASE, rename_state(BASE, "A", "One"), rename_state(BASE, "A", "Two"))
    assert [(each.path, each.ours, each.theirs) for each in result.conflicts] == [
        (("states", "A", "name"), "One", "Two")
    ]
    assert result.design.states[0].name == "One"
    theirs = merge_designs(
        BASE, rename_state(BASE, "A", "One"), rename_state(BASE, "A", "Two"), theirs_at=[("states", "A", "name")]
    )
    assert theirs.design.initial == "Two"


def test_two_renames_of_one_use_are_a_conflict() -> None:
    ours, theirs = rename_use(BASE, "head", "one"), rename_use(BASE, "head", "two")
    result = merge_designs(BASE, ours, theirs)
    (conflict,) = result.conflicts
    assert (conflict.path, conflict.base, conflict.ours, conflict.theirs) == (
        ("uses", "head", "name"),
        "head",
        "one",
        "two",
    )
    assert result.design == ours
    assert merge_designs(BASE, ours, theirs, theirs_at=[conflict.path]).design == theirs


def test_different_changes_of_one_value_are_a_conflict() -> None:
    ours, theirs = with_doc(BASE, "A", "mine"), with_doc(BASE, "A", "theirs")
    result = merge_designs(BASE, ours, theirs)
    (conflict,) = result.conflicts
    assert (conflict.path, conflict.base, conflict.ours, conflict.theirs) == (
        ("states", "A", "doc"),
        "first",
        "mine",
        "theirs",
    )
    assert result.design == ours
    assert merge_designs(BASE, ours, theirs, theirs_at=[conflict.path]).design == theirs


def test_changes_of_different_lines_are_merged() -> None:
    ours = replace(BASE, doc="Plays\n\nuntil it scores")
    theirs = replace(BASE, doc="plays\n\nuntil it scores\nor time is up")
    assert merged(ours, theirs).doc == "Plays\n\nuntil it scores\nor time is up"


def test_removing_a_changed_item_is_a_conflict() -> None:
    assert paths(remove_states(BASE, ["B"]), with_doc(BASE, "B", "new")) == [("states", "B")]
    assert merged(remove_states(BASE, ["B"]), with_doc(BASE, "C", "new")).state("B") is None


def test_removing_a_referenced_item_is_a_conflict() -> None:
    smaller, leading = remove_states(BASE, ["C"]), add_transition(BASE, "B", "C")
    assert paths(smaller, leading) == [("states", "C")]
    assert merge_designs(BASE, leading, smaller).design.state("C") is not None


def test_a_dangling_reference_within_one_side_is_no_conflict() -> None:
    dangling = add_transition(remove_states(BASE, ["C"]), "B", "C")
    theirs = with_doc(BASE, "A", "new")
    assert merged(dangling, theirs) == with_doc(dangling, "A", "new")
    assert merged(theirs, dangling).state("C") is None
    assert paths(dangling, add_transition(BASE, "A", "C")) == [("states", "C")]


@pytest.mark.parametrize("name", ["D", "E"])
def test_items_with_one_name_added_by_both_sides(name: str) -> None:
    ours, theirs = (add_state(BASE, State(name=each, doc=each)) for each in ("D", name))
    assert paths(ours, theirs) == []
    theirs = add_state(add_state(BASE, State(name="D", doc="another")), State(name="F"))
    result = merge_designs(BASE, ours, theirs)
    assert [conflict.path for conflict in result.conflicts] == [("states", "D")]
    assert [state.name for state in result.design.states] == ["A", "B", "C", "D", "F"]


def test_a_removal_and_a_move_are_merged_with_an_edit() -> None:
    theirs = replace(remove_states(BASE, ["C"]), states=(BASE.states[1], BASE.states[0]))
    both = merged(with_doc(BASE, "B", "mine"), theirs)
    assert [(state.name, state.doc) for state in both.states] == [("B", "mine"), ("A", "first")]


def test_moved_decisions_are_matched() -> None:
    first = ("states", "A", "transitions", 0)
    ours = reorder_decision(BASE, first, 1)
    theirs = update_state(
        BASE, "A", lambda state: replace(state, transitions=(Transition(to="B", guard=Guard(when="y")), Stay()))
    )
    assert merged(ours, theirs).states[0].transitions == (Stay(), Transition(to="B", guard=Guard(when="y")))
    added = update_state(BASE, "A", lambda state: replace(state, transitions=(Stay(doc="new"), *state.transitions)))
    assert merged(added, theirs).states[0].transitions[1] == Transition(to="B", guard=Guard(when="y"))


def test_guards_in_groups_and_code_in_actions_are_merged() -> None:
    group = DecisionGroup(guard=Guard(when="x"), then=(Transition(to="B"),), otherwise=(Transition(to="C"),))
    run = RunCode(code=Code(texts=(("python", "a\nb\nc\n"),)))
    base = update_state(BASE, "A", lambda state: replace(state, transitions=(group,), enter=(run,)))
    ours = update_state(
        base,
        "A",
        lambda state: replace(
            state,
            transitions=(replace(group, then=(Transition(to="B", doc="mine"),)),),
            enter=(RunCode(code=Code(texts=(("python", "A\nb\nc\n"),))),),
        ),
    )
    theirs = update_state(
        base,
        "A",
        lambda state: replace(
            state,
            transitions=(replace(group, guard=Guard(when="y")),),
            enter=(RunCode(code=Code(texts=(("python", "a\nb\nC\n"),))),),
        ),
    )
    result = merge_designs(base, ours, theirs)
    assert result.conflicts == ()
    assert result.design.states[0].transitions == (
        replace(group, guard=Guard(when="y"), then=(Transition(to="B", doc="mine"),)),
    )
    assert result.design.states[0].enter == (RunCode(code=Code(texts=(("python", "A\nb\nC\n"),))),)


def test_assignments_and_declarations_are_merged() -> None:
    def assign(values: tuple[tuple[str, str], ...]) -> Design:
        return update_state(BASE, "B", lambda state: replace(state, actions=(Assign(values=values),)))

    both = merged(assign((("n", "5"), ("m", "2"))), assign((("n", "1"), ("m", "6"))))
    assert both.states[1].actions == (Assign(values=(("n", "5"), ("m", "6"))),)
    ours = replace(BASE, variables=(Declaration(name="count", type="int"), Declaration(name="m")))
    theirs = replace(BASE, variables=(Declaration(name="n", type="int", doc="how many"), Declaration(name="m")))
    assert merged(ours, theirs).variables[0] == Declaration(name="count", type="int", doc="how many")


def test_a_name_used_for_two_items_stays_with_ours() -> None:
    ours = replace(BASE, variables=(Declaration(name="k", type="int"), Declaration(name="m")))
    theirs = replace(BASE, variables=(*BASE.variables, Declaration(name="k", doc="another"), Declaration(name="z")))
    result = merge_designs(BASE, ours, theirs)
    assert [conflict.path for conflict in result.conflicts] == [("variables", "k")]
    assert result.design.variables == (ours.variables[0], BASE.variables[1], Declaration(name="z"))
    chosen = merge_designs(BASE, ours, theirs, theirs_at=[("variables", "k")]).design
    assert chosen.variables == (Declaration(name="k", doc="another"), BASE.variables[1], Declaration(name="z"))


@pytest.mark.parametrize("count", [2, 3])
def test_a_name_that_one_side_uses_twice_is_no_conflict(count: int) -> None:
    """It is a finding of that side."""
    twice = tuple(Declaration(name="k", doc=str(number)) for number in range(count))
    ours = replace(BASE, variables=(*BASE.variables, *twice))
    documented = replace(BASE.variables[0], doc="how many")
    theirs = replace(BASE, variables=(documented, BASE.variables[1]))
    for both in (merged(ours, theirs), merged(theirs, ours)):
        assert both.variables == (documented, BASE.variables[1], *twice)


@given(designs, designs)
def test_a_side_without_changes_yields_the_other_side(base: Design, side: Design) -> None:
    assert merge_designs(base, side, base).design == side
    assert merge_designs(base, base, side).design == side
    assert merge_designs(base, side, side).design == side


@given(designs, designs, designs)
def test_any_three_designs_merge_and_choices_are_applied(base: Design, ours: Design, theirs: Design) -> None:
    result = merge_designs(base, ours, theirs)
    chosen = {conflict.path for conflict in result.conflicts}
    again = merge_designs(base, ours, theirs, theirs_at=chosen)
    assert bool(again.conflicts) == bool(result.conflicts)


@given(designs, states)
def test_independent_edits_both_survive(base: Design, state: State) -> None:
    free = replace(state, name="Zz9_new", transitions=())
    ours, theirs = add_state(base, free), replace(base, doc="zz9 theirs")
    for result in (merge_designs(base, ours, theirs), merge_designs(base, theirs, ours)):
        assert result.conflicts == ()
        assert result.design == replace(ours, doc="zz9 theirs")
