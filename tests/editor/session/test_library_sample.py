"""The sample project in a folder without designs."""

from pathlib import Path

import pytest

from vicode.editor.session import Library
from vicode.editor.session.trust import is_trusted


def test_the_sample_is_a_project_of_the_opened_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_STATE", str(tmp_path / "state"))
    library = Library(tmp_path)
    assert library.find_initial_design() is None
    added = library.add_sample()
    assert library.find_initial_design() == (added, "Player")
    assert added.key == "forward"
    assert [workspace.key for workspace in Library(tmp_path).workspaces] == ["forward"]


def test_code_that_comes_from_the_editor_is_trusted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_STATE", str(tmp_path / "state"))
    folder, other = tmp_path / "new", tmp_path / "other"
    folder.mkdir()
    assert Library(folder).ensure_project().is_trusted
    assert not is_trusted(tmp_path / "state", folder)
    assert Library(folder).add_sample().is_trusted
    assert is_trusted(tmp_path / "state", folder / "forward")
    other.mkdir()
    (other / "hands.py").write_text("", encoding="utf-8")
    assert not Library(other).ensure_project().is_trusted


def test_a_folder_of_the_same_name_is_kept(tmp_path: Path) -> None:
    (tmp_path / "forward").mkdir()
    (tmp_path / "forward" / "notes.txt").write_text("mine", encoding="utf-8")
    library = Library(tmp_path)
    with pytest.raises(FileExistsError, match="not an empty folder"):
        library.add_sample()
    assert library.workspaces == []
    assert [path.name for path in (tmp_path / "forward").iterdir()] == ["notes.txt"]
