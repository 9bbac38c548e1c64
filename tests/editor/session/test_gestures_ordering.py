"""Gestures that reorder, label, mark and align."""

from typing import Any

import pytest

from tests.editor.session.conftest import apply_gesture
from vicode.editor.session import DocumentSession, EditResult
from vicode.editor.view import ItemRef
from vicode.model.design import DecisionGroup, Design, Guard, State, Stay, Transition

DESIGN = Design(
    component="Player",
    initial="A",
    states=(
        State(
            name="A",
            transitions=(
                Transition(to="B"),
                Stay(),
                DecisionGroup(guard=Guard(when="x"), then=(Transition(to="A"), Transition(to="B"))),
                Transition(to="A"),
            ),
        ),
        State(name="B"),
    ),
)


def do(document: DocumentSession, kind: str, **payload: Any) -> EditResult:
    return apply_gesture(document, {"kind": kind, **payload})


def kinds(document: DocumentSession) -> str:
    return "".join(type(item).__name__[0] + getattr(item, "to", "") for item in document.design.states[0].transitions)


def test_a_transition_moves_up_and_down(document: DocumentSession) -> None:
    assert kinds(document) == "TBSDTA"
    assert do(document, "reorder", id="A/0", by=1).new_selection == (ItemRef(kind="transitions", id="A/1"),)
    assert kinds(document) == "STBDTA"
    do(document, "reorder", id="A/3", by=-1)
    assert kinds(document) == "STBTAD"
    document.undo()
    document.undo()
    do(document, "reorder", id="A/0", by=-1)
    do(document, "reorder", id="A/3", by=1)
    assert document.design == DESIGN


def test_a_transition_moves_to_the_position_of_another(document: DocumentSession) -> None:
    assert do(document, "reorder", id="A/0", onto="A/3").new_selection == (ItemRef(kind="transitions", id="A/3"),)
    assert kinds(document) == "SDTATB"
    assert "branch" in do(document, "reorder", id="A/3", onto="A/1/then/0").error
    do(document, "reorder", id="A/1/then/0", onto="A/1/then/1")
    group = document.design.states[0].transitions[1]
    assert isinstance(group, DecisionGroup)
    assert group.then == (Transition(to="B"), Transition(to="A"))


def test_a_label_keeps_its_position(document: DocumentSession) -> None:
    do(document, "label", id="A/0", at=[0.25049, -12.4])
    assert document.design.states[0].transitions[0] == Transition(to="B", label_at=(0.25, -12))
    do(document, "label", id="A/0", at=[9, 1e9])
    assert document.design.states[0].transitions[0] == Transition(to="B", label_at=(1, 2000))
    do(document, "label", id="A/0", at=[-9, -1e9])
    assert document.design.states[0].transitions[0] == Transition(to="B", label_at=(0, -2000))
    do(document, "label", id="A/0", at=None)
    assert document.design == DESIGN
    assert document.undo_label == "move label"


def test_nudges_are_one_edit(document: DocumentSession) -> None:
    for offset in (10, 20, 30):
        do(document, "label", id="A/0", at=[0.5, offset], by="nudge")
    for x in (10, 20, 30):
        do(document, "move", items=[{"of": "states", "id": "A", "x": x, "y": 0}], how="nudge")
    assert document.design.states[0].at == (30, 0)
    document.undo()
    assert document.design.states[0].at is None
    assert document.design.states[0].transitions[0] == Transition(to="B", label_at=(0.5, 30))
    document.undo()
    assert document.design == DESIGN


def test_a_state_becomes_initial_or_final(document: DocumentSession) -> None:
    do(document, "mark", mark="initial", id="B")
    assert document.design.initial == "B"
    do(document, "mark", mark="final", id="B")
    assert document.design.states[1].final
    do(document, "mark", mark="final", id="B")
    assert not document.design.states[1].final


def test_alignments_have_labels(document: DocumentSession) -> None:
    items = [{"of": "states", "id": name, "x": 5, "y": index} for index, name in enumerate("AB")]
    do(document, "move", items=items, how="align-left")
    assert document.undo_label == "align left edges"
    do(document, "move", items=items[:1], how="<script>")
    assert "script" not in document.undo_label


@pytest.mark.parametrize(
    "payload",
    [
        {"kind": "reorder", "id": "A/9", "by": 1},
        {"kind": "reorder", "id": "A", "by": 1},
        {"kind": "reorder", "id": "A/0", "by": "up"},
        {"kind": "reorder", "id": "A/0", "onto": "A"},
        {"kind": "reorder", "id": "A/0", "onto": "A/x"},
        {"kind": "label", "id": "A/1", "at": [0, 0]},
        {"kind": "label", "id": "A/0", "at": [float("nan"), 0]},
        {"kind": "label", "id": "A/0", "at": [0, float("inf")]},
        {"kind": "label", "id": "A/0", "at": "ab"},
        {"kind": "label", "id": "A/0", "at": [1, 2, 3]},
        {"kind": "label", "id": "Nowhere/0", "at": None},
        {"kind": "mark", "mark": "initial", "id": "Ghost"},
    ],
)
def test_invalid_gestures_change_nothing(document: DocumentSession, payload: dict[str, Any]) -> None:
    assert apply_gesture(document, payload).error
    assert document.design == DESIGN
