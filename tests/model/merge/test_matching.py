"""Items of two versions are matched by id, even if nothing else is equal."""

from vicode.model.design import Assign, Call, Code, Design, Guard, RunCode, State, Transition
from vicode.model.merge import find_renamed_states, match_items, merge_designs


def design(*states: State) -> Design:
    return Design(component="Player", initial=states[0].name, states=states)


def test_decisions_with_equal_ids_match() -> None:
    old = (Transition(to="A", guard=Guard(when="a"), id="x"), Transition(to="B", guard=Guard(when="b"), id="y"))
    new = (Transition(to="C", guard=Guard(when="c"), id="y"), Transition(to="D", guard=Guard(when="d"), id="x"))
    assert match_items(old, new, is_keyed=False) == {0: 1, 1: 0}


def test_actions_with_equal_ids_match() -> None:
    old = (RunCode(code=Code(texts=(("python", "a()"),)), id="x"), Assign(values=(("n", "1"),)))
    new = (
        Assign(values=(("n", "1"),)),
        RunCode(code=Code(texts=(("python", "b()"),))),
        RunCode(code=Code(texts=(("python", "c()"),)), id="x"),
    )
    assert match_items(old, new, is_keyed=False) == {0: 2, 1: 0}


def test_a_changed_item_matches_beside_an_unchanged_one() -> None:
    first, changed, added = Assign(values=(("n", "1"),)), Assign(values=(("m", "2"),)), Call(alias="legs")
    assert match_items((first, Assign(values=())), (first, changed, added), is_keyed=False) == {0: 0, 1: 1}
    assert match_items((Assign(values=()), first), (added, changed, first), is_keyed=False) == {0: 1, 1: 2}


def test_empty_ids_do_not_match() -> None:
    old = (Transition(to="A", guard=Guard(when="a")),)
    new = (Transition(to="B", guard=Guard(when="b")),)
    assert match_items(old, new, is_keyed=False) == {}


def test_a_renamed_state_is_found_by_its_id() -> None:
    old = design(State(name="A", id="one", doc="old"), State(name="B", id="two"))
    new = design(State(name="C", id="two", at=(1, 2)), State(name="D", id="one", doc="new", final=True))
    assert find_renamed_states(old, new) == {"A": "D", "B": "C"}


def test_a_renamed_state_is_found_by_its_old_name_as_id() -> None:
    old = design(State(name="A", doc="old"), State(name="B"))
    new = design(State(name="B"), State(name="D", id="A", doc="new"))
    assert find_renamed_states(old, new) == {"A": "D"}


def test_edits_of_both_sides_meet_in_the_decision_with_the_same_id() -> None:
    first, second = Transition(to="B", guard=Guard(when="a"), id="x"), Transition(to="B", guard=Guard(when="b"), id="y")
    changed = Transition(to="A", guard=Guard(when="c"), id="x")
    base, ours, theirs = (
        design(State(name="A", transitions=transitions), State(name="B"))
        for transitions in (
            (first, second),
            (second, changed),
            (Transition(to="B", guard=Guard(when="a"), doc="their doc", id="x"), second),
        )
    )
    result = merge_designs(base, ours, theirs)
    assert result.conflicts == ()
    expected = Transition(to="A", guard=Guard(when="c"), doc="their doc", id="x")
    assert result.design.states[0].transitions == (second, expected)
