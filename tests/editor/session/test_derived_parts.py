"""Edits of what a competence means are refused in the editor; all others keep it."""

from dataclasses import replace
from pathlib import Path

from vicode.editor.session.document import DocumentSession, SharedDocument
from vicode.model.edits import move_nodes
from vicode.store import read_design

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


def test_a_derived_state_cannot_be_moved(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Move", lambda design: move_nodes(design, {"Look": (10.0, 20.0)}))
    assert document.is_saved
    assert document.shared.notice.text == (
        "Not changed: this part is derived from 'Look' in 'competence'; edit it in the form of the design"
    )


def test_an_edit_beside_it_is_kept(tmp_path: Path) -> None:
    document = open_fetch(tmp_path)
    document.edit("Describe", lambda design: replace(design, doc="Fetches."))
    assert document.design.doc == "Fetches."
    assert [state.name for state in document.design.states] == ["Choose", "Look", "Done", "Failed"]
    assert document.shared.notice.text == ""
