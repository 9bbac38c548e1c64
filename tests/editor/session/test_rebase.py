"""Selections and gestures are rebased onto newer designs."""

from dataclasses import replace

import pytest
from hypothesis import given

from tests.strategies.designs import designs
from vicode.editor.session import rebase_gesture, rebase_selection
from vicode.editor.session.gestures.canvas_gestures import (
    ConnectGesture,
    DeleteGesture,
    LabelGesture,
    LinkGesture,
    MoveGesture,
    NodePosition,
    ReconnectGesture,
)
from vicode.editor.view import ItemRef
from vicode.model.decision_keys import transition_key
from vicode.model.design import DecisionGroup, Design, Guard, State, Stay, Transition, Use
from vicode.model.edits import remove_decisions, remove_states, rename_state, rename_use, reorder_decision
from vicode.model.traversal import iter_decisions

GROUP = DecisionGroup(guard=Guard(when="x"), then=(Stay(), Transition(to="B")))
OLD = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    states=(
        State(name="A", at=(0, 0), requires=("head",), transitions=(Transition(to="B"), GROUP, Stay(doc="last"))),
        State(name="B", at=(9, 9)),
    ),
)


@pytest.mark.parametrize(
    ("of", "key", "new", "found"),
    [
        ("states", "A", rename_state(OLD, "A", "Z"), "Z"),
        ("states", "B", remove_states(OLD, ["B"]), None),
        ("states", "C", replace(OLD, states=(*OLD.states, State(name="C"))), "C"),
        ("states", "C", OLD, "C"),
        ("states", "C", rename_state(OLD, "A", "Z"), None),
        ("components", "head", rename_use(OLD, "head", "neck"), "neck"),
        ("links", "requires/A/head", rename_use(rename_state(OLD, "A", "Z"), "head", "neck"), "requires/Z/neck"),
        ("transitions", "A/0", rename_state(OLD, "A", "Z"), "Z/0"),
        ("transitions", "A/2", remove_decisions(OLD, [("states", "A", "transitions", 0)]), "A/1"),
        ("transitions", "A/0", remove_decisions(OLD, [("states", "A", "transitions", 0)]), None),
        ("transitions", "A/1/then/1", reorder_decision(OLD, ("states", "A", "transitions", 1), 0), "A/0/then/1"),
        ("transitions", "nonsense", OLD, "nonsense"),
        ("transitions", "Z/9", rename_state(OLD, "A", "Z"), None),
        ("design", "", remove_states(OLD, ["B"]), ""),
    ],
)
def test_a_selection_is_rebased(of: str, key: str, new: Design, found: str | None) -> None:
    assert rebase_selection(ItemRef(kind=of, id=key), OLD, new) == (
        None if found is None else ItemRef(kind=of, id=found)
    )


@given(designs, designs)
def test_rebase_never_raises(old: Design, new: Design) -> None:
    for located in iter_decisions(old):
        rebase_selection(ItemRef(kind="transitions", id=transition_key(located.path)), old, new)
    for state in old.states:
        rebase_selection(ItemRef(kind="states", id=state.name), old, new)


def test_a_late_gesture_applies_to_its_original_item() -> None:
    new = remove_decisions(rename_state(OLD, "A", "Z"), [("states", "Z", "transitions", 0)])
    items = (
        ItemRef(kind="transitions", id="A/2"),
        ItemRef(kind="transitions", id="A/0"),
        ItemRef(kind="states", id="A"),
    )
    assert rebase_gesture(DeleteGesture(items=items), OLD, new) == DeleteGesture(
        items=(ItemRef(kind="transitions", id="Z/1"), ItemRef(kind="states", id="Z"))
    )
    late = rebase_gesture(ReconnectGesture(id="A/1", end="target", state="A"), OLD, new)
    assert late == ReconnectGesture(id="Z/0", end="target", state="Z")
    assert rebase_gesture(ReconnectGesture(id="A/0", end="target", state="B"), OLD, new) is None
    assert rebase_gesture(ConnectGesture(source="A"), OLD, new) == ConnectGesture(source="Z")
    assert rebase_gesture(ConnectGesture(source="@common", target="A"), OLD, new) == ConnectGesture(
        source="@common", target="Z"
    )
    label = LabelGesture(id="A/2", at=(0.5, 7))
    assert rebase_gesture(label, OLD, new) == LabelGesture(id="Z/1", at=(0.5, 7))
    move = MoveGesture(items=(NodePosition(kind="states", id="A", x=1, y=2),))
    assert rebase_gesture(move, OLD, new) == MoveGesture(items=(NodePosition(kind="states", id="Z", x=1, y=2),))
    link = LinkGesture(kind_of_link="requires", state="A", component="head")
    renamed = rename_use(rename_state(OLD, "A", "Z"), "head", "neck")
    assert rebase_gesture(link, OLD, renamed) == LinkGesture(kind_of_link="requires", state="Z", component="neck")
