"""`vicode hook install`: keeps what exists, changes nothing when repeated, and can be removed."""

import os
from pathlib import Path

import pytest

from tests.cli.command_runner import lamps, vicode
from tests.cli.git_folder import commit, git, init
from vicode.git import find_repository

__all__ = ["lamps"]


@pytest.fixture
def repository(lamps: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with the project in the folder `lamps`."""
    init(lamps.parent)
    return lamps.parent


def hook_file(repository: Path) -> Path:
    return repository / ".git" / "hooks" / "pre-commit"


def state_of(repository: Path) -> dict[str, str]:
    hooks = (hook_file(repository).with_name(name) for name in ("pre-commit", "pre-merge-commit", "post-merge"))
    files = (repository / ".gitattributes", *hooks)
    texts = {file.name: file.read_text(encoding="utf-8") for file in files if file.exists()}
    return {**texts, "config": git(repository, "config", "--local", "--list")}


def test_install_and_remove(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = state_of(repository)
    assert vicode("hook", "install") == 0
    assert capsys.readouterr().out.count("\n") == 11
    installed = state_of(repository)
    assert installed[".gitattributes"] == (
        "# vicode hook install: begin\n"
        "/lamps/**/*.y*ml merge=vicode diff=vicode\n"
        "/lamps/generated/** merge=vicode-generated\n"
        "# vicode hook install: end\n"
    )
    assert git(repository, "check-attr", "merge", "lamps/lamp.yaml") == "lamps/lamp.yaml: merge: vicode\n"
    assert hook_file(repository).stat().st_mode & 0o111
    assert vicode("hook", "install") == 0
    assert capsys.readouterr().out == ""
    assert state_of(repository) == installed
    assert vicode("hook", "install", "--uninstall") == 0
    left = state_of(repository)
    assert {name: left[name] for name in before} == before
    assert set(left) == set(before)


def test_existing_hooks_and_attributes_are_kept(repository: Path) -> None:
    attributes, hook = repository / ".gitattributes", hook_file(repository)
    attributes.write_text("*.png binary", encoding="utf-8")
    hook.parent.mkdir(exist_ok=True)
    hook.write_text("#!/usr/bin/env bash\nexec other\n", encoding="utf-8")
    hook.chmod(0o755)
    assert vicode("hook", "install") == 0
    assert attributes.read_text(encoding="utf-8").startswith("*.png binary\n# vicode")
    lines = hook.read_text(encoding="utf-8").splitlines()
    assert (lines[0], lines[-1]) == ("#!/usr/bin/env bash", "exec other")
    assert lines[3].endswith(" -P -m vicode hook pre-commit || exit $?")
    assert vicode("hook", "install", "--uninstall") == 0
    assert hook.read_text(encoding="utf-8") == "#!/usr/bin/env bash\nexec other\n"
    assert attributes.read_text(encoding="utf-8") == "*.png binary\n"


@pytest.mark.parametrize(
    ("text", "mode", "reason"),
    [
        ("#!/usr/bin/env python3\n", 0o755, "is no shell script"),
        ("#!/bin/sh\nexit 0\n", 0o644, "is not executable, so git ignores it"),
    ],
)
def test_a_hook_that_cannot_be_changed_is_reported(
    repository: Path, capsys: pytest.CaptureFixture[str], text: str, mode: int, reason: str
) -> None:
    hook = hook_file(repository)
    hook.parent.mkdir(exist_ok=True)
    hook.write_text(text, encoding="utf-8")
    hook.chmod(mode)
    assert vicode("hook", "install") == 1
    assert reason in capsys.readouterr().err
    assert hook.read_text(encoding="utf-8") == text


def test_a_removed_environment_does_not_stop_commits(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.executable", "/no/such/python")
    assert vicode("hook", "install") == 0
    (repository / "lamps" / "lamp.yaml").write_text("states: [", encoding="utf-8")
    commit(repository, "broken")
    assert git(repository, "log", "-1", "--format=%s") == "broken\n"


def test_a_folder_without_designs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    init(tmp_path)
    assert vicode("hook", "install", str(tmp_path)) == 2
    assert capsys.readouterr().err == f"vicode: no designs in {tmp_path}\n"


def test_folders_may_begin_with_a_dash(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (repository / "lamps").rename(repository / "-lamps")
    git(repository, "add", "--all")
    assert vicode("hook", "pre-commit") == 0, capsys.readouterr()
    assert vicode("hook", "pre-merge-commit") == 0, capsys.readouterr()


@pytest.mark.parametrize("place", ["a folder", "a relative folder", "a link"])
def test_hooks_outside_of_the_repository_are_not_changed(
    repository: Path, tmp_path_factory: pytest.TempPathFactory, place: str, capsys: pytest.CaptureFixture[str]
) -> None:
    outside = tmp_path_factory.mktemp("hooks")
    hook = outside / "pre-commit"
    hook.write_text("#!/bin/sh\n")
    hook.chmod(0o755)
    if place == "a link":
        hook_file(repository).parent.mkdir(exist_ok=True)
        hook_file(repository).symlink_to(hook)
    else:
        path = outside if place == "a folder" else os.path.relpath(outside, repository)
        git(repository, "config", "core.hooksPath", str(path))
    assert vicode("hook", "install") == 1
    assert "outside of the repository" in capsys.readouterr().err
    assert (hook.read_text(), [file.name for file in outside.iterdir()]) == ("#!/bin/sh\n", ["pre-commit"])
    assert vicode("hook", "install", "--uninstall") == 0
    hook.write_text("#!/bin/sh\n# vicode hook install: begin\n")
    assert vicode("hook", "install", "--uninstall") == 1
    assert "remove the lines of vicode from it" in capsys.readouterr().err


def test_hooks_in_a_folder_of_the_repository_are_installed(repository: Path) -> None:
    git(repository, "config", "core.hooksPath", ".githooks")
    assert vicode("hook", "install") == 0
    assert (repository / ".githooks" / "pre-commit").is_file()


def test_hooks_are_installed_from_an_additional_work_tree(repository: Path, tmp_path: Path) -> None:
    commit(repository, "first")
    git(repository, "worktree", "add", "-q", str(tmp_path / "other"))
    assert vicode("hook", "install", str(tmp_path / "other")) == 0
    assert hook_file(repository).is_file()


def test_the_repository_is_known_in_hooks_of_additional_work_trees(
    repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_DIR", str(repository / ".git"))
    # Remembers that it is not set, for the end of the test.
    monkeypatch.setenv("GIT_WORK_TREE", "")
    monkeypatch.delenv("GIT_WORK_TREE")
    assert vicode("hook", "pre-commit") == 0
    assert find_repository(repository / "lamps").root == repository.resolve()
