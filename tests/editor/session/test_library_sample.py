"""The sample project in a folder without designs."""

from pathlib import Path

import pytest

from vicode.editor.session import Library


def test_the_sample_is_a_project_of_the_opened_folder(tmp_path: Path) -> None:
    library = Library(tmp_path)
    assert library.initial_design is None
    added = library.add_sample()
    assert library.initial_design == (added, "Player")
    assert added.key == "forward"
    assert [workspace.key for workspace in Library(tmp_path).workspaces] == ["forward"]


def test_a_folder_of_the_same_name_is_kept(tmp_path: Path) -> None:
    (tmp_path / "forward").mkdir()
    (tmp_path / "forward" / "notes.txt").write_text("mine", encoding="utf-8")
    library = Library(tmp_path)
    with pytest.raises(FileExistsError, match="not an empty folder"):
        library.add_sample()
    assert library.workspaces == []
    assert [path.name for path in (tmp_path / "forward").iterdir()] == ["notes.txt"]
