"""Extract and inline change two files, each in one step of undo."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.editor.session import DocumentSession, Library, Workspace
from vicode.editor.session.project.extraction import extract_states, inline_state
from vicode.editor.view import ItemRef
from vicode.model.design import State
from vicode.store import CommentedFile, open_project

LAMP = """\
vicode: 1
component: Lamp
initial: Off
uses: {eyes: Eyes}
variables: {n: 0}
states:
  Off: {at: [0, 0], transitions: [{to: Dim, when: eyes.seen}]}
  Dim: {at: [200, 0], transitions: [{to: Bright, after: 1}]}  # slowly
  Bright:
    at: [400, 0]
    actions: [set: {n: n + 1}]
    transitions: [{to: Dim, when: n > 9}, {to: Off, when: not eyes.seen}]
"""
PROJECT = "vicode: 1\nproject: Lamps\ncomponents: {Eyes: {implementation: world, outputs: {seen: bool}}}\n"


@pytest.fixture
def lamps(tmp_path: Path) -> Workspace:
    (tmp_path / "project.yaml").write_text(PROJECT)
    (tmp_path / "lamp.yaml").write_text(LAMP)
    return Library(tmp_path).workspaces[0]


def opened(workspace: Workspace, component: str = "Lamp") -> DocumentSession:
    document = workspace.open_document(component)
    assert document is not None
    return DocumentSession(document.shared, "me")


def names(folder: Path) -> dict[str, list[str]]:
    """The states of the designs on disk, which have no findings but that of the world."""
    project = open_project(folder).project
    assert {finding.rule.code for finding in check_project(project)} == {"P210"}
    return {design.component: [state.name for state in design.states] for design in project.designs}


def test_extract_writes_both_files_and_undo_restores_them(lamps: Workspace) -> None:
    before = opened(lamps).design
    result = extract_states(lamps, opened(lamps), ["Dim", "Bright"], "Glow")
    assert result.error == ""
    assert result.new_selection == (ItemRef(kind="states", id="Glow"),)
    parts = {"Lamp": ["Off", "Glow"], "Glow": ["Start", "Dim", "Bright", "ToOff"]}
    assert names(lamps.folder) == parts
    assert opened(lamps).undo() == ""
    assert opened(lamps).design == before
    assert names(lamps.folder) == {"Lamp": ["Off", "Dim", "Bright"]}
    assert opened(lamps).redo() == ""
    assert names(lamps.folder) == parts


def test_inline_deletes_the_file_and_undo_restores_it(lamps: Workspace) -> None:
    whole = opened(lamps).design
    extract_states(lamps, opened(lamps), ["Dim", "Bright"], "Glow")
    text = (lamps.folder / "glow.yaml").read_text()
    result = inline_state(lamps, opened(lamps), "Glow")
    assert result.error == ""
    assert result.new_selection == (ItemRef(kind="states", id="Dim"), ItemRef(kind="states", id="Bright"))
    assert replace(opened(lamps).design, uses=whole.uses) == whole
    assert not (lamps.folder / "glow.yaml").exists()
    assert opened(lamps).undo() == ""
    assert (lamps.folder / "glow.yaml").read_text() == text
    assert names(lamps.folder)["Lamp"] == ["Off", "Glow"]


def test_a_changed_component_stays(lamps: Workspace) -> None:
    extract_states(lamps, opened(lamps), ["Dim", "Bright"], "Glow")
    opened(lamps, "Glow").edit("doc", lambda design: replace(design, states=(*design.states, State(name="New"))))
    assert opened(lamps).undo() == "Undo or redo failed: Glow has other changes: save or undo them first"
    assert inline_state(lamps, opened(lamps), "Glow").error.startswith("Glow has other changes")
    assert names(lamps.folder)["Lamp"] == ["Off", "Glow"]


def test_what_cannot_be_done_changes_nothing(lamps: Workspace) -> None:
    document, design = opened(lamps), opened(lamps).design
    assert "there is already a component Eyes" in extract_states(lamps, document, ["Dim"], "Eyes").error
    assert "several places" in extract_states(lamps, document, ["Off", "Bright"], "Part").error
    assert inline_state(lamps, document, "Off").error == "Off requires no component with a design"
    lamps.project = replace(lamps.project, languages=("xabsl",))
    assert extract_states(lamps, document, ["Dim", "Bright"], "Glow").error.startswith("XABSL cannot")
    assert document.design == design


COMMENTED = """\
# The whole lamp
vicode: 1
component: Lamp
initial: Off
uses: {eyes: Eyes}
variables:
  m: 0  # stays
  n: 0  # counts
states:
  # of Off
  Off: {at: [0, 0], transitions: [{to: Dim, when: eyes.seen}], enter: [set: {m: m + 1}]}
  # before Dim
  Dim: {at: [200, 0], transitions: [{to: Bright, after: 1}]}  # behind Dim
  Bright:  # of Bright
    at: [400, 0]
    # inside
    actions: [set: {n: n + 1}]
    transitions:
      - {to: Dim, when: n > 9}  # of the first
      # above the second
      - {to: Off, when: not eyes.seen}
"""
MOVED = ["counts", "before Dim", "behind Dim", "of Bright", "inside", "of the first", "above the second"]


def comments(path: Path) -> list[str]:
    return [comment.text for comment in CommentedFile(path.read_text()).comments]


def test_comments_move_with_their_states_and_come_back(lamps: Workspace) -> None:
    lamp, glow = lamps.folder / "lamp.yaml", lamps.folder / "glow.yaml"
    lamp.write_text(COMMENTED)
    lamps.sync_from_disk()
    assert extract_states(lamps, opened(lamps), ["Dim", "Bright"], "Glow").error == ""
    assert comments(glow) == MOVED
    assert "Dim: {at: [200, 0], transitions: [{to: Bright, after: 1}]}  # behind Dim" in glow.read_text()
    assert comments(lamp) == ["The whole lamp", "stays", "of Off"]
    glow.write_text(glow.read_text().replace("# inside", "# changed"))
    lamps.sync_from_disk()
    assert inline_state(lamps, opened(lamps), "Glow").error == ""
    back = ["changed" if each == "inside" else each for each in MOVED]
    assert sorted(comments(lamp)) == sorted(["The whole lamp", "stays", "of Off", *back])
    owners = {
        each.text: CommentedFile(lamp.read_text()).owner_of(each) for each in CommentedFile(lamp.read_text()).comments
    }
    assert [owners[each][:2] for each in ("counts", "before Dim", "changed")] == [
        ("variables", "n"),
        ("states", "Dim"),
        ("states", "Bright"),
    ]
    assert opened(lamps).undo() == ""
    assert (comments(glow), comments(lamp)) == (back, ["The whole lamp", "stays", "of Off"])
    assert opened(lamps).undo() == ""
    assert sorted(comments(lamp)) == sorted(["The whole lamp", "stays", "of Off", *back])
    assert opened(lamps).is_saved
