"""Frames and notes in an open design: made, renamed, copied, deleted and undone."""

from dataclasses import replace

from tests.editor.session.conftest import apply_gesture
from vicode.editor.session import DocumentSession, apply_edit
from vicode.editor.session.gestures import clipboard
from vicode.editor.session.gestures.clipboard import DuplicateGesture
from vicode.editor.session.gestures.rebase import rebase_selection
from vicode.editor.view import ItemRef, make_scene
from vicode.editor.view.page_urls import format_selection, parse_selection
from vicode.model.design import Design, DiagramFrame, DiagramNote, State, Transition
from vicode.model.diagram_edits import rename_frame
from vicode.model.edits import remove_states, rename_state
from vicode.model.project import Project
from vicode.model.text_search import TextQuery, find_text, replace_matches

FRAME = DiagramFrame(name="Play", color="red", states=("A", "B"))
NOTE = DiagramNote(name="why", text="Slow ball", at=(0, -100))
DESIGN = Design(
    component="Player",
    initial="A",
    states=(State(name="A", at=(0, 0), transitions=(Transition(to="B"),)), State(name="B", at=(240, 0))),
    frames=(FRAME,),
    notes=(NOTE,),
)


def load(document: DocumentSession, design: Design = DESIGN) -> DocumentSession:
    document.edit("prepare", lambda _old: replace(design, component=_old.component))
    return document


def test_a_frame_is_made_renamed_deleted_and_undone(document: DocumentSession) -> None:
    load(document, replace(DESIGN, frames=()))
    made = apply_gesture(document, {"kind": "frame", "states": ["A", "Ghost", "A"], "title": " Near \n goal "})
    assert made.new_selection == (ItemRef(kind="frames", id="Near goal"),)
    assert document.design.frames == (DiagramFrame(name="Near goal", states=("A",)),)
    apply_gesture(document, {"kind": "frame", "states": ["B"], "title": ""})
    item = {"of": "frames", "id": "Frame"}
    assert "already" in apply_gesture(document, {"kind": "rename", "item": item, "name": "Near goal"}).error
    assert apply_gesture(document, {"kind": "rename", "item": item, "name": " "}).error
    renamed = apply_gesture(document, {"kind": "rename", "item": item, "name": "Far: away"})
    assert renamed.new_selection == (ItemRef(kind="frames", id="Far: away"),)
    apply_gesture(document, {"kind": "delete", "items": [{"of": "frames", "id": "Far: away"}]})
    assert [frame.name for frame in document.design.frames] == ["Near goal"]
    for expected in (["Near goal", "Far: away"], ["Near goal", "Frame"], ["Near goal"], []):
        document.undo()
        assert [frame.name for frame in document.design.frames] == expected


def test_a_frame_needs_states(document: DocumentSession) -> None:
    load(document)
    assert "select" in apply_gesture(document, {"kind": "frame", "states": ["Ghost"], "title": "x"}).error


def test_frames_follow_their_states() -> None:
    assert rename_state(DESIGN, "A", "Z").frames[0].states == ("Z", "B")
    assert remove_states(DESIGN, ["A"]).frames[0].states == ("B",)
    assert remove_states(DESIGN, ["A", "B"]).frames == ()


def test_the_selection_follows_a_renamed_frame() -> None:
    selected = ItemRef(kind="frames", id="Play")
    renamed = rename_frame(DESIGN, "Play", "Game")
    assert rebase_selection(selected, DESIGN, renamed) == ItemRef(kind="frames", id="Game")
    assert rebase_selection(selected, DESIGN, replace(DESIGN, frames=())) is None
    assert parse_selection(format_selection(ItemRef(kind="frames", id="a: b, c/d"))).id == "a: b, c/d"  # type: ignore[union-attr]


def test_duplicates_have_their_own_frame_and_note(document: DocumentSession) -> None:
    load(document)
    kinds = (("states", "A"), ("states", "B"), ("frames", "Play"), ("notes", "why"))
    outcome = apply_edit(document, DuplicateGesture(items=tuple(ItemRef(kind=kind, id=id_) for kind, id_ in kinds)))
    assert document.design.frames == (FRAME, DiagramFrame(name="Play2", color="red", states=("A2", "B2")))
    assert [note.name for note in document.design.notes] == ["why", "why2"]
    assert document.design.notes[1].at not in (None, NOTE.at)
    assert ItemRef(kind="frames", id="Play2") in (outcome.new_selection or ())


def test_a_note_alone_is_copied_and_pasted_at_the_pointer(document: DocumentSession) -> None:
    load(document)
    text = clipboard.copy_as_text(document.design, [ItemRef(kind="notes", id="why")])
    assert text is not None
    clipboard.paste(document, text, (500, 300), (), ())
    assert document.design.notes[1] == DiagramNote(name="why2", text="Slow ball", at=(500, 300))


def test_a_copied_part_of_a_frame_keeps_the_frame_around_it(document: DocumentSession) -> None:
    load(document)
    items = [ItemRef(kind="states", id="B"), ItemRef(kind="frames", id="Play")]
    text = clipboard.copy_as_text(document.design, items)
    assert text is not None
    assert "Play: {color: red, states: [B]}" in text


def test_text_search_finds_and_replaces_in_notes() -> None:
    query = TextQuery(text="ball")
    (match,) = find_text(DESIGN, query).matches
    assert match.path == ("notes", "why", "text")
    assert replace_matches(DESIGN, query, "robot").design.notes[0].text == "Slow robot"


def test_scenes_contain_frames_with_their_states() -> None:
    design = replace(DESIGN, frames=(replace(FRAME, states=("A", "Ghost")),))
    (frame,) = make_scene(Project(name="p", designs=(design,)), design, (), 1)["frames"]
    assert (frame["id"], frame["color"], frame["states"]) == ("Play", "red", ["A"])
