"""Gestures of the canvas edit the open design; invalid ones change nothing."""

from dataclasses import replace
from typing import Any, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.editor.session.conftest import apply_gesture, open_design
from vicode.editor.session import DocumentSession, apply_edit
from vicode.editor.session.gestures.canvas_gestures import (
    ConnectGesture,
    CreateGesture,
    DeleteGesture,
    DisableGesture,
    LabelGesture,
    LinkGesture,
    MoveGesture,
    NodePosition,
    ReconnectGesture,
    RenameGesture,
    ReorderGesture,
    StateFlagGesture,
)
from vicode.editor.view import ItemKind, ItemRef
from vicode.model.design import COMMON, Call, DecisionGroup, Design, Guard, State, Transition, Use
from vicode.model.traversal import iter_transitions

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    states=(
        State(
            name="A", transitions=(Transition(to="B"), DecisionGroup(guard=Guard(when="x"), then=(Transition(to="A"),)))
        ),
        State(name="B"),
    ),
)


def names(document: DocumentSession) -> list[str]:
    return [state.name for state in document.design.states]


def arrows(document: DocumentSession) -> list[tuple[str, str]]:
    located = iter_transitions(document.design)
    return [(at.source, at.decision.to) for at in located if isinstance(at.decision, Transition)]


def test_create_selects_the_new_state(document: DocumentSession) -> None:
    outcome = apply_gesture(document, {"kind": "create", "x": 10.4, "y": 20})
    assert outcome.new_selection == (ItemRef(kind="states", id="State"),)
    assert document.design.states[-1].at == (10, 20)
    apply_gesture(document, {"kind": "create", "x": 0, "y": 0})
    assert names(document) == ["A", "B", "State", "State2"]


def test_a_named_state_is_one_edit(document: DocumentSession) -> None:
    outcome = apply_gesture(document, {"kind": "create", "x": 0, "y": 0, "name": "Sound", "select": False})
    assert outcome.new_selection is None
    apply_gesture(document, {"kind": "connect", "source": "Sound", "target": None, "x": 0, "y": 9, "name": "Echo"})
    assert names(document) == ["A", "B", "Sound", "Echo"]
    assert arrows(document)[-1] == ("Sound", "Echo")
    document.undo()
    assert names(document) == ["A", "B", "Sound"]
    document.undo()
    assert document.design == DESIGN


@pytest.mark.parametrize(("name", "word"), [("A", "already"), ("no name", "name")])
def test_a_state_with_an_impossible_name_gets_a_free_one(document: DocumentSession, name: str, word: str) -> None:
    outcome = apply_gesture(document, {"kind": "create", "x": 0, "y": 0, "name": name})
    assert word in outcome.error
    assert outcome.new_selection == (ItemRef(kind="states", id="State"),)
    assert names(document) == ["A", "B", "State"]


def test_a_refused_state_is_an_error(document: DocumentSession, monkeypatch: pytest.MonkeyPatch) -> None:
    # The canvas draws the state already, until an error makes it load the design again.
    monkeypatch.setattr(type(document.shared), "find_lost_content", lambda _shared, _design: "it would be lost")
    assert apply_gesture(document, {"kind": "create", "x": 0, "y": 0, "name": "Sound"}).error
    assert names(document) == ["A", "B"]


def test_naming_a_new_state_is_part_of_its_creation(document: DocumentSession) -> None:
    for name in ("First", "Second"):
        apply_gesture(document, {"kind": "create", "x": 0, "y": 0})
        apply_gesture(document, {"kind": "rename", "item": {"of": "states", "id": "State"}, "name": name})
        assert document.undo_label == f"add state {name}"
    apply_gesture(document, {"kind": "rename", "item": {"of": "states", "id": "Second"}, "name": "Third"})
    for expected in (["A", "B", "First", "Second"], ["A", "B", "First"], ["A", "B"]):
        document.undo()
        assert names(document) == expected


def test_connect_to_another_state_itself_and_a_new_state(document: DocumentSession) -> None:
    outcome = apply_gesture(document, {"kind": "connect", "source": "B", "target": "A", "x": None, "y": None})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="B/0"),)
    apply_gesture(document, {"kind": "connect", "source": "B", "target": "B"})
    apply_gesture(document, {"kind": "connect", "source": "B", "target": None, "x": 5, "y": 5})
    apply_gesture(document, {"kind": "connect", "source": COMMON, "target": "A"})
    assert arrows(document) == [(COMMON, "A"), ("A", "B"), ("A", "A"), ("B", "A"), ("B", "B"), ("B", "State")]


def test_the_guard_of_a_new_transition_is_part_of_its_creation(document: DocumentSession) -> None:
    gesture = {"kind": "connect", "source": "B", "target": "A", "guard": "x < 0.5 after 500 ms"}
    apply_gesture(document, gesture)
    apply_gesture(document, {**gesture, "target": None, "name": "Echo", "guard": "20 s"})
    guards = [each.guard for each in document.design.states[1].transitions if isinstance(each, Transition)]
    assert guards == [Guard(when="x < 0.5", after="0.5"), Guard(after="20")]
    document.undo()
    document.undo()
    assert document.design == DESIGN


def test_a_guard_is_typed_over_the_one_that_its_user_saw(document: DocumentSession) -> None:
    gesture = {"kind": "guard", "id": "A/0", "base": "x"}
    apply_gesture(document, {**gesture, "text": "x < 0.5 after 2 s", "base": ""})
    first = document.design.states[0].transitions[0]
    assert first.guard == Guard(when="x < 0.5", after="2")
    # Another user has changed it meanwhile: both edits are kept.
    apply_gesture(document, {**gesture, "text": "x < 0.55 after 2 s", "base": "x < 0.5 after 2 s"})
    apply_gesture(document, {**gesture, "text": "not x < 0.5 after 2 s", "base": "x < 0.5 after 2 s"})
    first = document.design.states[0].transitions[0]
    assert first.guard == Guard(when="not x < 0.55", after="2")
    assert apply_gesture(document, {**gesture, "id": "A/9", "text": "y"}).error


def test_disable_toggles_all_given_items(document: DocumentSession) -> None:
    items = [{"of": "states", "id": "B"}, {"of": "transitions", "id": "A/1/then/0"}, {"of": "components", "id": "head"}]
    apply_gesture(document, {"kind": "disable", "items": items[:1]})
    assert document.design.states[1].disabled
    apply_gesture(document, {"kind": "disable", "items": items})
    group = document.design.states[0].transitions[1]
    assert isinstance(group, DecisionGroup)
    assert (document.design.states[1].disabled, group.then[0].disabled) == (True, True)
    apply_gesture(document, {"kind": "disable", "items": items})
    assert document.design == DESIGN
    assert apply_gesture(document, {"kind": "disable", "items": items[2:]}).error


def test_connect_by_the_name_of_a_state_that_the_browser_does_not_have_yet(document: DocumentSession) -> None:
    apply_gesture(document, {"kind": "connect", "source": "B", "target": None, "name": "A", "x": 5, "y": 5})
    assert [state.name for state in document.design.states] == ["A", "B"]
    assert arrows(document) == [("A", "B"), ("A", "A"), ("B", "A")]


def test_reconnect_moves_an_end(document: DocumentSession) -> None:
    apply_gesture(document, {"kind": "reconnect", "id": "A/0", "end": "target", "state": "A"})
    assert arrows(document)[0] == ("A", "A")
    outcome = apply_gesture(document, {"kind": "reconnect", "id": "A/0", "end": "source", "state": "B"})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="B/0"),)
    assert arrows(document) == [("A", "A"), ("B", "A")]


def test_a_transition_becomes_common(document: DocumentSession) -> None:
    outcome = apply_gesture(document, {"kind": "reconnect", "id": "A/0", "end": "source", "state": COMMON})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="@common/0"),)
    assert arrows(document) == [(COMMON, "B"), ("A", "A")]
    assert apply_gesture(document, {"kind": "reconnect", "id": "@common/0", "end": "target", "state": COMMON}).error


def test_a_new_source_keeps_the_transitions_of_all_states(document: DocumentSession) -> None:
    moved = Transition(to="B", guard=Guard(when="x"), doc="moved", id="m")
    states = (
        State(name="A", transitions=(Transition(to="A", doc="first"), moved)),
        State(name="B", transitions=(Transition(to="A", doc="kept"), Transition(to="B", doc="also kept"))),
        State(name="C", transitions=tuple(Transition(to="C", doc=f"{number}") for number in range(3))),
    )
    document.edit("prepare", lambda design: replace(design, states=states))
    outcome = apply_gesture(document, {"kind": "reconnect", "id": "A/1", "end": "source", "state": "B"})
    assert outcome.new_selection == (ItemRef(kind="transitions", id="B/2"),)
    assert tuple(replace(state, at=None) for state in document.design.states) == (
        replace(states[0], transitions=states[0].transitions[:1]),
        replace(states[1], transitions=(*states[1].transitions, moved)),
        states[2],
    )


def test_branches_of_a_tree_keep_their_source(document: DocumentSession) -> None:
    outcome = apply_gesture(document, {"kind": "reconnect", "id": "A/1/then/0", "end": "source", "state": "B"})
    assert "tree" in outcome.error
    apply_gesture(document, {"kind": "reconnect", "id": "A/1/then/0", "end": "target", "state": "B"})
    assert arrows(document) == [("A", "B"), ("A", "B")]


def test_rename_rejects_used_and_invalid_names(document: DocumentSession) -> None:
    for name in ("B", "two words", "", "<b>"):
        assert apply_gesture(document, {"kind": "rename", "item": {"of": "states", "id": "A"}, "name": name}).error
    apply_gesture(document, {"kind": "rename", "item": {"of": "states", "id": "A"}, "name": " on "})
    assert names(document) == ["on", "B"]
    apply_gesture(document, {"kind": "rename", "item": {"of": "components", "id": "head"}, "name": "neck"})
    assert document.design.uses[0].alias == "neck"
    assert apply_gesture(document, {"kind": "rename", "item": {"of": "components", "id": "neck"}, "name": "1x"}).error


def test_link_and_delete(document: DocumentSession) -> None:
    for kind in ("requires", "modulates"):
        payload = {"kind": "link", "kind_of_link": kind, "state": "B", "component": "head"}
        apply_gesture(document, payload)
    assert document.design.states[1].requires == ("head",)
    assert document.design.states[1].modulates == (Call(alias="head"),)
    items = [{"of": "links", "id": "requires/B/head"}, {"of": "transitions", "id": "A/0"}]
    apply_gesture(document, {"kind": "delete", "items": items})
    assert document.design.states[1].requires == ()
    assert arrows(document) == [("A", "A")]
    apply_gesture(
        document, {"kind": "delete", "items": [{"of": "states", "id": "A"}, {"of": "components", "id": "head"}]}
    )
    assert (names(document), document.design.uses, document.design.initial) == (["B"], (), "B")
    document.undo()
    assert names(document) == ["A", "B"]


def test_move_is_one_edit(document: DocumentSession) -> None:
    items = [{"of": "states", "id": "A", "x": 1.2, "y": 2}, {"of": "components", "id": "head", "x": 3, "y": 4}]
    apply_gesture(document, {"kind": "move", "items": items})
    assert (document.design.states[0].at, document.design.uses[0].at) == ((1, 2), (3, 4))
    assert document.undo_label == "move 2 items"
    document.undo()
    assert document.design == DESIGN
    document.redo()
    assert document.design.states[0].at == (1, 2)


@pytest.mark.parametrize(
    "payload",
    [
        {},
        {"kind": "format the disk"},
        {"kind": "move", "items": [{"of": "states", "id": "A", "x": float("nan"), "y": 0}]},
        {"kind": "move", "items": [{"of": "walls", "id": "A", "x": 1, "y": 0}]},
        {"kind": "move", "items": 7},
        {"kind": "connect", "source": "A", "target": "Nowhere"},
        {"kind": "connect", "source": "Nowhere", "target": "A"},
        {"kind": "rename", "item": {"of": "states", "id": "Nowhere"}, "name": "C"},
        {"kind": "delete", "items": [{"of": "links", "id": "x"}]},
        {"kind": "delete", "items": [{"of": "transitions", "id": "A/0/then/x"}]},
        {"kind": "delete", "items": [{"of": "transitions", "id": "@common"}, {"of": "transitions", "id": "A"}]},
        {"kind": "link", "kind_of_link": "requires", "state": "A", "component": "ghost"},
        {"kind": "reconnect", "id": "A/99", "end": "target", "state": "B"},
    ],
)
def test_malformed_payloads_change_nothing(document: DocumentSession, payload: dict[str, object]) -> None:
    apply_gesture(document, payload)
    assert document.design == DESIGN
    assert document.rev == 0


_NAMES = st.sampled_from(["A", "B", "State", "C", COMMON, "head", "A/0", "B/0", "A/x", "requires/A/head", "A/1/then/0"])
_NUMBERS = st.integers(-900, 900)
_KINDS = st.sampled_from(get_args(ItemKind))
_ITEMS = st.lists(st.builds(ItemRef, kind=_KINDS, id=_NAMES), max_size=3).map(tuple)
_POSITIONS = st.builds(NodePosition, kind=_KINDS, id=_NAMES, x=_NUMBERS, y=_NUMBERS)
_GESTURES = st.one_of(
    st.builds(CreateGesture, x=_NUMBERS, y=_NUMBERS),
    st.builds(ConnectGesture, source=_NAMES, target=st.none() | _NAMES, x=_NUMBERS, y=_NUMBERS),
    st.builds(DeleteGesture, items=_ITEMS),
    st.builds(DisableGesture, items=_ITEMS),
    st.builds(RenameGesture, item=st.builds(ItemRef, kind=_KINDS, id=_NAMES), name=_NAMES),
    st.builds(MoveGesture, items=st.lists(_POSITIONS, max_size=3).map(tuple)),
    st.builds(LinkGesture, kind_of_link=st.sampled_from(["requires", "modulates"]), state=_NAMES, component=_NAMES),
    st.builds(ReconnectGesture, id=_NAMES, end=st.sampled_from(["source", "target"]), state=_NAMES),
    st.builds(ReorderGesture, id=_NAMES, by=_NUMBERS, onto=st.none() | _NAMES),
    st.builds(LabelGesture, id=_NAMES, at=st.none() | st.tuples(_NUMBERS, _NUMBERS)),
    st.builds(StateFlagGesture, mark=st.sampled_from(["initial", "final"]), id=_NAMES),
)


@given(st.lists(_GESTURES | st.sampled_from(["undo", "redo"]), max_size=12))
def test_undoing_all_edits_restores_the_design(gestures: list[Any]) -> None:
    document = open_design(DESIGN)
    for gesture in gestures:
        if isinstance(gesture, str):
            getattr(document, gesture)()
        else:
            apply_edit(document, gesture)
    end = document.design
    steps = len(document.history.path) - 1
    for _step in range(steps):
        document.undo()
    assert document.design == DESIGN
    for _step in range(steps):
        document.redo()
    assert document.design.states == end.states


def test_typing_in_a_field_is_one_entry(document: DocumentSession) -> None:
    for text in ("f", "fo", "foo"):
        document.edit("edit Doc", lambda design, text=text: replace(design, doc=text), coalesce_key="doc")
    assert len(document.history.path) == 2
    document.edit("edit Doc", lambda design: replace(design, doc="bar"), coalesce_key="other")
    assert len(document.history.path) == 3
    document.undo()
    document.edit("edit Doc", lambda design: replace(design, doc="food"), coalesce_key="doc")
    assert len(document.history.path) == 3


def test_subscribers_are_called_until_they_unsubscribe(document: DocumentSession) -> None:
    revs: list[int] = []
    unsubscribe = document.shared.changes.subscribe(lambda changed: revs.append(changed.rev))
    apply_gesture(document, {"kind": "create", "x": 0, "y": 0})
    document.undo()
    unsubscribe()
    document.redo()
    assert revs == [1, 2]
