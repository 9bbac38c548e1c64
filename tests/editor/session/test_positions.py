"""Elements without a position stay where they are shown while others are added, removed or connected."""

from dataclasses import replace

import pytest

from tests.editor.session.conftest import apply_gesture, open_design
from vicode.diagram.layered_layout import complete_layout
from vicode.editor.session import DocumentSession
from vicode.editor.view import ItemRef
from vicode.model.design import CommonSection, Design, State, Transition, Use

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    states=(
        State(name="A", transitions=(Transition(to="B"), Transition(to="C"))),
        State(name="B", transitions=(Transition(to="D"),)),
        State(name="C"),
        State(name="D"),
    ),
    common=CommonSection(transitions=(Transition(to="A"),)),
)
EDITS = [
    {"kind": "create", "x": -900, "y": -900},
    {"kind": "connect", "source": "A", "target": "D"},
    {"kind": "connect", "source": "D", "target": None, "x": 10, "y": 900},
    {"kind": "delete", "items": [{"of": "states", "id": "B"}]},
    {"kind": "rename", "item": {"of": "states", "id": "B"}, "name": "Bystander"},
    {"kind": "mark", "mark": "initial", "id": "D"},
    {"kind": "duplicate", "items": [{"of": "states", "id": "A"}]},
    {"kind": "move", "items": [{"of": "states", "id": "A", "x": -900, "y": -900}]},
]


@pytest.mark.parametrize("edit", EDITS, ids=[f"{edit['kind']}-{number}" for number, edit in enumerate(EDITS)])
def test_other_elements_stay(document: DocumentSession, edit: dict[str, object]) -> None:
    before = complete_layout(document.design)
    assert not apply_gesture(document, edit).error
    after = complete_layout(document.design)
    kept = before.states.keys() & after.states.keys() - ({"A"} if edit["kind"] == "move" else set())
    assert len(kept) >= 3
    assert {name: after.states[name] for name in kept} == {name: before.states[name] for name in kept}
    assert (after.uses, after.common) == (before.uses, before.common)


def test_a_renamed_state_stays(document: DocumentSession) -> None:
    before = complete_layout(document.design).states["B"]
    apply_gesture(document, {"kind": "rename", "item": {"of": "states", "id": "B"}, "name": "A much longer name"})
    apply_gesture(
        document, {"kind": "rename", "item": {"of": "states", "id": "B"}, "name": "Bystander_with_a_long_name"}
    )
    assert complete_layout(document.design).states["Bystander_with_a_long_name"] == before


def test_positions_are_written_only_if_something_would_move(document: DocumentSession) -> None:
    document.edit("describe", lambda design: replace(design, doc="Plays."))
    document.edit(
        "guard", lambda design: replace(design, states=(*design.states[:3], replace(design.states[3], doc="x")))
    )
    assert not any(each.at for each in (*document.design.states, *document.design.uses))
    apply_gesture(document, {"kind": "create", "x": 10, "y": 20})
    assert all(each.at for each in (*document.design.states, *document.design.uses))
    document.undo()
    assert not any(state.at for state in document.design.states)


def test_the_first_state_is_placed_freely() -> None:
    document = open_design(Design(component="Empty"))
    assert apply_gesture(document, {"kind": "create", "x": 10, "y": 20}).new_selection == (
        ItemRef(kind="states", id="State"),
    )
    assert document.design.states[0].at == (10, 20)
