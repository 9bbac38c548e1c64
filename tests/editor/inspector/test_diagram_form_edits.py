"""Edits of the forms of frames and notes."""

import pytest

from tests.editor.inspector.test_form_edits import edit
from tests.editor.session.conftest import open_design
from vicode.editor.session import DocumentSession
from vicode.editor.view import ItemRef
from vicode.model.design import Design, DiagramFrame, DiagramNote, State

FRAME = {"of": "frames", "id": "Near"}
NOTE = {"of": "notes", "id": "note"}
DESIGN = Design(
    component="Player",
    initial="A",
    states=(State(name="A"), State(name="B"), State(name="C")),
    frames=(DiagramFrame(name="Near", states=("A", "B")), DiagramFrame(name="Far", states=("C",))),
    notes=(DiagramNote(name="note", text="Looks twice."),),
)


@pytest.fixture
def document() -> DocumentSession:
    return open_design(DESIGN)


def test_a_frame_is_renamed_colored_and_gets_other_states(document: DocumentSession) -> None:
    renamed = edit(document, "name", FRAME, path="name", base="Near", text=" Close by ")
    assert renamed.renamed == (ItemRef(kind="frames", id="Near"), ItemRef(kind="frames", id="Close by"))
    # The browser still says the old title.
    edit(document, "choose", FRAME, rev=0, path="color", value="green")
    edit(document, "choose-several", FRAME, rev=0, path="states", base=["A", "B"], value=["B", "C"])
    assert document.design.frames[0] == DiagramFrame(name="Close by", color="green", states=("B", "C"))


def test_a_title_that_is_taken_and_a_frame_without_states_are_refused(document: DocumentSession) -> None:
    assert "Far" in edit(document, "name", FRAME, path="name", base="Near", text="Far").error
    empty = edit(document, "choose-several", FRAME, path="states", base=["A", "B"], value=[])
    assert "at least one state" in empty.error
    assert edit(document, "choose", FRAME, path="color", value="plaid").error
    assert document.design == DESIGN


def test_a_note_is_written_and_removed(document: DocumentSession) -> None:
    edit(document, "text", NOTE, path="text", base="Looks twice.", text="Looks once.")
    assert document.design.notes[0].text == "Looks once."
    assert edit(document, "press", NOTE, action="remove").new_selection == ()
    assert document.design.notes == ()
    assert edit(document, "text", NOTE, rev=1, path="text", base="", text="x").error == "this item no longer exists"


def test_a_removed_frame_leaves_its_states(document: DocumentSession) -> None:
    assert edit(document, "press", FRAME, action="remove").new_selection == ()
    assert [frame.name for frame in document.design.frames] == ["Far"]
    assert document.design.states == DESIGN.states


def test_a_button_of_another_form_does_nothing(document: DocumentSession) -> None:
    for item in (FRAME, NOTE, {"of": "states", "id": "A"}):
        for action in ("add-card", "remove-card", "move-card", "add-stay", "remove-row", "move-row"):
            path = "modulates/head" if "card" in action else "transitions"
            assert edit(document, "press", item, action=action, path=path, to="1").error or item["of"] == "states"
    assert edit(document, "press", {"of": "states", "id": "A"}, action="remove").error
    assert document.design.frames == DESIGN.frames
