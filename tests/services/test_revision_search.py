"""A design is found by its hash in the commits of a repository, and else in the work tree."""

from pathlib import Path

from tests.cli.git_folder import commit, init
from vicode.model.design_hash import hash_design
from vicode.services.design_diff.revision_search import find_design
from vicode.store import open_project

TEXT = "vicode: 1\ncomponent: Wave\ninitial: Up\nstates: {Up: {doc: up}}\n"


def test_the_committed_version_is_found_after_an_edit(tmp_path: Path) -> None:
    file = tmp_path / "wave.yaml"
    init(tmp_path)
    file.write_text(TEXT, encoding="utf-8")
    revision = commit(tmp_path, "first")
    committed = hash_design(open_project(tmp_path).project, "Wave")
    file.write_text(TEXT.replace("doc: up", "doc: higher"), encoding="utf-8")
    edited = hash_design(open_project(tmp_path).project, "Wave")
    old, new = find_design(tmp_path, committed), find_design(tmp_path, edited)
    assert old is not None
    assert old.texts == {"wave.yaml": TEXT}
    assert old.commit is not None
    assert old.commit.revision == revision
    assert new is not None
    assert new.commit is None
    assert find_design(tmp_path, "0" * 12) is None
