"""Edits of designs change only their target."""

from dataclasses import replace

from vicode.model.design import (
    COMMON,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.edits import (
    add_modulation,
    add_requirement,
    add_state,
    add_transition,
    add_use,
    assign_id,
    move_nodes,
    remove_decisions,
    remove_link,
    remove_states,
    remove_uses,
    rename_state,
    rename_use,
    reorder_decision,
    replace_decision,
    unique_name,
    update_state,
)
from vicode.model.traversal import find_decision, iter_transitions

TREE = DecisionGroup(guard=Guard(when="seen"), then=(Transition(to="B"), Stay()), otherwise=(Transition(to="A"),))
DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    common=CommonSection(transitions=(Transition(to="B", guard=Guard(when="head.tired or done(head)")),)),
    states=(
        State(name="A", transitions=(Transition(to="B"), TREE), requires=("head",)),
        State(
            name="B", transitions=(Transition(to="A"),), actions=(Call(alias="head", arguments=(("pan", "head.pan"),)),)
        ),
    ),
)


def targets(design: Design) -> list[tuple[str, str]]:
    return [(at.source, at.decision.to) for at in iter_transitions(design) if isinstance(at.decision, Transition)]


def test_rename_state_updates_transitions_and_keeps_the_id() -> None:
    renamed = rename_state(DESIGN, "B", "Back")
    assert [(state.name, state.id) for state in renamed.states] == [("A", ""), ("Back", "")]
    assert targets(renamed) == [(COMMON, "Back"), ("A", "Back"), ("A", "Back"), ("A", "A"), ("Back", "A")]
    assert rename_state(DESIGN, "A", "First").initial == "First"
    assert rename_state(DESIGN, "B", "A") == DESIGN


def test_rename_state_with_code_uses_the_first_name_as_id() -> None:
    code = RunCode(code=Code(texts=(("python", "pass"),)))
    with_code = update_state(DESIGN, "B", lambda state: replace(state, enter=(code,)))
    there = rename_state(rename_state(with_code, "B", "C"), "C", "D")
    assert there.states[1].id == "B"


def test_remove_states_removes_transitions_and_replaces_the_initial_state() -> None:
    smaller = remove_states(DESIGN, ["A"])
    assert smaller.initial == "B"
    assert targets(smaller) == [(COMMON, "B")]
    assert targets(remove_states(DESIGN, ["B"])) == [("A", "A")]
    assert remove_states(DESIGN, ["A", "B"]).initial == ""


def test_assign_id_creates_unique_ids() -> None:
    twice = add_transition(add_transition(DESIGN, "B", "A"), "B", "A")
    for index in (1, 2, 2):
        twice = assign_id(twice, ("states", "B", "transitions", index))
    ids = [at.decision.id for at in iter_transitions(twice) if at.source == "B"]
    assert ids == ["", "b_to_a", "b_to_a2"]
    assert targets(add_transition(DESIGN, COMMON, "A"))[1] == (COMMON, "A")


def test_decisions_in_groups_are_replaced_moved_and_removed() -> None:
    path = ("states", "A", "transitions", 1, "then", 0)
    changed = replace_decision(DESIGN, path, Stay(doc="wait"))
    found = find_decision(changed, path)
    assert found is not None
    assert found.decision == Stay(doc="wait")
    moved = reorder_decision(DESIGN, path, 1)
    assert isinstance(find_decision(moved, path).decision, Stay)  # type: ignore[union-attr]
    both = remove_decisions(DESIGN, [path, ("states", "A", "transitions", 0)])
    assert targets(both)[1:] == [("A", "A"), ("B", "A")]


def test_removals_do_not_shift_each_other() -> None:
    state = State(name="A", transitions=tuple(Transition(to="A", doc=str(number)) for number in range(12)))
    design = Design(component="C", states=(state,))
    smaller = remove_decisions(design, [("states", "A", "transitions", index) for index in (2, 9, 10, 11)])
    assert [item.doc for item in smaller.states[0].transitions] == ["0", "1", "3", "4", "5", "6", "7", "8"]


def test_uses_and_links() -> None:
    used = add_use(DESIGN, "Head")
    assert [use.alias for use in used.uses] == ["head", "head2"]
    linked = add_modulation(add_requirement(used, "B", "head2"), "A", "head2")
    assert linked.states[1].requires == ("head2",)
    assert linked.states[0].modulates == (Call(alias="head2"),)
    assert add_modulation(add_requirement(linked, "B", "head2"), "A", "head2") == linked
    assert remove_link(linked, "A", "head2", modulates=True).states[0].modulates == ()
    assert remove_link(DESIGN, "B", "head", modulates=True).states[1].actions == ()
    gone = remove_uses(DESIGN, ["head"])
    assert (gone.uses, gone.states[0].requires, gone.states[1].actions) == ((), (), ())


def test_rename_use_updates_expressions_calls_and_links() -> None:
    renamed = rename_use(DESIGN, "head", "neck")
    assert renamed.uses == (Use(alias="neck", component="Head"),)
    assert renamed.states[0].requires == ("neck",)
    assert renamed.states[1].actions == (Call(alias="neck", arguments=(("pan", "neck.pan"),)),)
    assert renamed.common.transitions[0].guard.when == "neck.tired or done(neck)"


def test_move_and_names() -> None:
    moved = move_nodes(DESIGN, {"A": (1, 2)}, {"head": (3, 4)}, (5, 6))
    assert (moved.states[0].at, moved.uses[0].at, moved.common.at) == ((1, 2), (3, 4), (5, 6))
    assert move_nodes(DESIGN, {"Nowhere": (1, 2)}) == DESIGN
    assert move_nodes(moved, {"A": (7, 8)}).common.at == (5, 6)
    assert add_state(Design(component="C"), State(name="S")).initial == "S"
    assert unique_name("State", {"State", "State2"}) == "State3"
