"""The revisions of a design in git, also before its file was renamed."""

from pathlib import Path

import pytest

from tests.cli.git_folder import commit, git, init
from vicode.git import GitError
from vicode.model.design import Design
from vicode.services.design_diff.revisions import compare_with_revision, list_revisions
from vicode.store import read_design

TEXT = "vicode: 1\ncomponent: Wave\ninitial: Up\nstates:\n  Up:\n    doc: up\n  Down:\n    doc: down\n    at: [0, 0]\n"


def design_of(file: Path) -> Design:
    design = read_design(file.read_text(encoding="utf-8")).design
    assert design is not None
    return design


def test_revisions_follow_a_renamed_file(tmp_path: Path) -> None:
    (tmp_path / "wave.yaml").write_text(TEXT, encoding="utf-8")
    init(tmp_path)
    git(tmp_path, "mv", "wave.yaml", "waves.yaml")
    commit(tmp_path, "rename")
    file = tmp_path / "waves.yaml"
    file.write_text(TEXT.replace("doc: up", "doc: higher"), encoding="utf-8")
    commit(tmp_path, "higher")
    found = list_revisions(file)
    assert [(each.subject, each.author, each.path) for each in found] == [
        ("higher", "Ana", "waves.yaml"),
        ("rename", "Ana", "waves.yaml"),
        ("begin", "Ana", "wave.yaml"),
    ]
    newest, _rename, oldest = found
    assert compare_with_revision(file, newest, design_of(file)).lines == ()
    compared = compare_with_revision(file, oldest, design_of(file))
    assert compared.lines == ("~ description of state Up: up → higher",)
    assert compared.picture.startswith("<svg")


def test_an_unreadable_revision(tmp_path: Path) -> None:
    file = tmp_path / "wave.yaml"
    file.write_text("states: [", encoding="utf-8")
    init(tmp_path)
    (revision,) = list_revisions(file)
    assert compare_with_revision(file, revision, Design(component="Wave")).error


def test_no_repository_and_no_commit(tmp_path: Path) -> None:
    file = tmp_path / "wave.yaml"
    file.write_text(TEXT, encoding="utf-8")
    with pytest.raises(GitError, match="is not in a git repository"):
        list_revisions(file)
    git(tmp_path, "init", "-q")
    assert list_revisions(file) == ()
