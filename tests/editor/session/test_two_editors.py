"""Two editors on one folder: no save is lost, and each editor knows of the other."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.editor.session import DocumentSession, Library, texts
from vicode.editor.session import workspace as workspace_module
from vicode.editor.session.recovery.autosave import AutosaveService
from vicode.editor.session.recovery.open_folders import OpenFolders
from vicode.editor.session.recovery.recovery_store import RecoveryStore
from vicode.store import FileChangedError, read_design, replace_text

SAVES = 25
SAVING = f"""\
import sys
from dataclasses import replace
from pathlib import Path
from vicode.editor.session import Library
(workspace,) = Library(Path(sys.argv[1])).workspaces
document, mine = workspace.open_document("Shared"), sys.argv[2]
for number in range({SAVES}):
    states = lambda design: tuple(
        replace(state, doc=f"{{number}}") if state.name == f"{{mine}}{{number}}" else state for state in design.states
    )
    document.edit("doc", lambda design: replace(design, states=states(design)))
    workspace.save(document)
"""


def test_two_editors_at_once_lose_no_save(tmp_path: Path) -> None:
    states = "".join(f"  {name}{number}: {{}}\n" for name in "AB" for number in range(SAVES))
    (tmp_path / "shared.yaml").write_text(f"vicode: 1\ncomponent: Shared\ninitial: A0\nstates:\n{states}")
    editors = [subprocess.Popen([sys.executable, "-c", SAVING, str(tmp_path), name]) for name in "AB"]
    assert [editor.wait() for editor in editors] == [0, 0]
    design = read_design((tmp_path / "shared.yaml").read_text()).design
    assert design is not None
    assert [state.name for state in design.states if not state.doc] == []


def test_a_save_between_merge_and_replacement_is_merged_too(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    document, theirs = _opened(folder), [_opened(folder)]

    def replace_later(path: Path, old: str | None, new: str) -> None:
        if theirs:
            _edit(theirs.pop(), "Attend the other goal")
        replace_text(path, old, new)

    _edit(document, "mine", section="doc", is_saved=False)
    monkeypatch.setattr(workspace_module, "replace_text", replace_later)
    Library(folder).workspaces[0].save(document)
    design = read_design(document.file.read_text()).design
    assert design is not None
    assert (design.doc, design.states[0].doc) == ("mine", "Attend the other goal")


def test_a_changed_file_is_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    replace_text(path, None, "one")
    with pytest.raises(FileChangedError):
        replace_text(path, None, "two")
    with pytest.raises(FileChangedError):
        replace_text(path, "zero", "two")
    replace_text(path, "one", "two")
    assert path.read_text() == "two"


def test_each_editor_knows_of_the_other(project: Path, tmp_path: Path) -> None:
    first, second = (AutosaveService(Library(project), RecoveryStore(tmp_path / "state")) for _ in range(2))
    workspace = first.library.workspaces[0]
    document = workspace.open_document("Player")
    assert document is not None
    first.find_other_editors(0)
    assert not workspace.has_other_editor
    second.find_other_editors(0)
    first.find_other_editors(0)
    assert workspace.has_other_editor
    assert second.library.workspaces[0].has_other_editor
    assert document.shared.notice.text == texts.OTHER_EDITOR
    second.close()
    first.find_other_editors(0)
    assert not workspace.has_other_editor
    first.close()
    assert not [file for file in (tmp_path / "state" / "open").rglob("*") if file.is_file()]


def test_the_mark_of_a_killed_editor_is_removed(tmp_path: Path) -> None:
    killed, other = OpenFolders(tmp_path / "open"), OpenFolders(tmp_path / "open")
    assert not killed.has_other_editor(tmp_path)
    for mark in killed._own.values():
        mark.release()
    assert not other.has_other_editor(tmp_path)
    other.close()


def _opened(folder: Path) -> DocumentSession:
    document = Library(folder).workspaces[0].open_document("Player")
    assert document is not None
    return document


def _edit(document: DocumentSession, text: str, section: str = "states", *, is_saved: bool = True) -> None:
    """Change the doc of the design, or that of its first state."""
    first = document.design.states[0]
    states = (replace(first, doc=text), *document.design.states[1:])
    document.edit(
        "doc", lambda design: replace(design, doc=text) if section == "doc" else replace(design, states=states)
    )
    if is_saved:
        Library(document.file.parent).workspaces[0].save(document)
