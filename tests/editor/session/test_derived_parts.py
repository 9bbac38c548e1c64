"""Edits of what a competence means are refused in the editor; all others keep it."""

from dataclasses import replace
from pathlib import Path

from vicode.editor.session.document import DocumentSession, SharedDocument
from vicode.model.design import State
from vicode.model.diff import ChangeKind, diff_designs
from vicode.model.edits import add_state, move_nodes, remove_states, rename_state
from vicode.model.lowering import lower_design
from vicode.store import read_design, save_design

TEXT = """\
vicode: 1
component: Fetch
uses: {eyes: Eyes}
competence:
  goal: eyes.near
  steps:
    Look: {requires: [eyes]}
"""


def open_fetch(tmp_path: Path) -> DocumentSession:
    design = read_design(TEXT).design
    assert design is not None
    file = tmp_path / "fetch.yaml"
    file.write_text(TEXT)
    return DocumentSession(SharedDocument(file=file, disk_text=TEXT, saved=design, check=lambda _design: ()), "ana")


def test_a_derived_state_cannot_be_edited(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Rename", lambda design: replace(design, states=design.states[:-1]))
    assert document.is_saved
    assert document.shared.notice.text == (
        "Not changed: this part is derived from 'competence'; edit it in the form of the design"
    )


def test_a_derived_state_can_be_moved(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Move", lambda design: move_nodes(design, {"Look": (10.0, 20.0), "Choose": (-5.0, 0.0)}))
    text = save_design(document.design)
    assert "positions: {Choose: [-5, 0], Look: [10, 20]," in text
    saved = read_design(text).design
    assert saved == document.design
    assert saved is not None
    assert [state.at for state in saved.states[:2]] == [(-5.0, 0.0), (10.0, 20.0)]


def test_a_renamed_step_keeps_its_position_and_a_removed_one_loses_it(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Move", lambda design: move_nodes(design, {"Look": (10.0, 20.0)}))
    document.edit("Rename", lambda design: rename_state(design, "Look", "Search"))
    assert " Search: [10, 20]" in save_design(document.design)
    document.edit("Remove", lambda design: remove_states(design, {"Search"}))
    assert "Search" not in save_design(document.design)


def test_moving_a_derived_state_is_a_move_in_a_diff() -> None:
    old = read_design(TEXT).design
    new = lower_design(move_nodes(old, {"Look": (10.0, 20.0)}))
    assert [(change.kind, change.subject, change.new) for change in diff_designs(old, new)] == [
        (ChangeKind.MOVED, "state Look", "10, 20")
    ]


def test_an_edit_beside_it_is_kept(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Describe", lambda design: replace(design, doc="Fetches."))
    assert document.design.doc == "Fetches."
    assert [state.name for state in document.design.states] == ["Choose", "Look", "Done", "Failed"]
    assert document.shared.notice.text == ""


def test_a_state_beside_a_competence_is_refused(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Add", lambda design: add_state(design, State(name="Foo")))
    assert document.is_saved
    assert document.shared.notice.text == (
        "Not changed: the states of this design are the steps of its competence; add one in the form of the design"
    )
