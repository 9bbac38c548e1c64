"""No program that the configuration of a repository names runs when vicode reads the repository."""

import contextlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.cli.command_runner import lamps, vicode
from tests.cli.git_folder import ENVIRONMENT, commit, git, init
from tests.cli.hostile_repository import READING, SIGNER, HostileRepository, make_hostile, program_keys, run_plain_git
from vicode.git import GitError, Repository, find_repository, merge_lines
from vicode.services.design_diff.revisions import compare_with_revision, list_revisions
from vicode.store import read_design

__all__ = ["lamps"]

ROOT = Path(__file__).parents[2]
COMMANDS = {
    "vicode/services/design_diff/file_pairs.py": (
        ("diff",),
        ("diff", "HEAD~1"),
        ("diff", "{missing}", "HEAD"),
        ("diff", "HEAD~2...HEAD", "--", "lamps/lamp.yaml"),
    ),
    "vicode/services/design_diff/revision_search.py": (("show", "abcdef", "lamps"), ("show", "000000")),
    "vicode/services/design_version.py": (("tournament", "HEAD~1:lamps", "lamps", "--out", "tournament"),),
    "vicode/services/run_preparation.py": (("run", "lamps/lamp.yaml", "--ticks", "1", "--trace", "run.trace"),),
    "vicode/cli/merge.py": (("merge", "--generated", "--path=lamps/generated/lamp.py", "base", "ours", "theirs"),),
    "vicode/services/tracked_projects.py": (
        ("hook", "pre-commit"),
        ("hook", "pre-merge-commit"),
        ("hook", "post-merge"),
    ),
    "vicode/cli/hook.py": (("hook", "install"),),
    "vicode/services/git_hooks.py": (("hook", "install"), ("hook", "install", "--uninstall")),
    "vicode/sync/history.py": (("gen", "lamps"), ("sync", "lamps")),
}
"""Commands for each module that reads repositories; the editor has a test of its own."""
EDITOR_MODULES = {"vicode/services/design_diff/revisions.py", "vicode/editor/panels/versions/revisions_dialog.py"}
METHODS: dict[str, Callable[[Repository], Any]] = {
    "resolve": lambda each: each.resolve("HEAD~1"),
    "has_revision": lambda each: each.has_revision("main"),
    "head": lambda each: each.head,
    "merge_base": lambda each: each.merge_base("HEAD", "HEAD~1"),
    "relative": lambda each: each.relative(each.root / "lamps"),
    "read": lambda each: each.read("HEAD", "lamps/lamp.yaml"),
    "find_content": lambda each: each.find_content("lamps/lamp.yaml", b"x", limit=3),
    "list_changed": lambda each: each.list_changed("HEAD", None),
    "list_blobs": lambda each: each.list_blobs("HEAD"),
    "list_tracked": lambda each: each.list_tracked(["lamps"]),
    "list_staged": lambda each: each.list_staged(),
    "is_modified": lambda each: each.is_modified(["."]),
    "log": lambda each: each.log(["lamps"], all_branches=True),
    "log_file": lambda each: each.log_file("lamps/lamp.yaml", limit=9),
    "config": lambda each: each.config("core.pager"),
    "set_config": lambda each: each.set_config("merge.vicode.name", "x"),
    "git_path": lambda each: each.git_path("hooks"),
    "stage": lambda each: each.stage(["lamps"]),
    "write_tree": lambda each: each.write_tree(),
    "parents": lambda each: each.parents("HEAD"),
    "replace_tree_of_head": lambda each: each.replace_tree_of_head(),
}
OMITTED = ("filter.x.process", "diff.x.command", "diff.external", "core.fsmonitor")


@pytest.fixture(params=["config", "include", "worktree"])
def hostile(lamps: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> HostileRepository:
    for name, value in ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    for name in ("base", "ours", "theirs"):
        (lamps.parent / name).write_text(name, encoding="utf-8")
    programs = lamps.parent.parent / f"{lamps.parent.name}-programs"
    made = make_hostile(lamps.parent, programs, request.param, () if request.param == "config" else OMITTED)
    assert not made.take_witnesses()
    return made


def test_the_keys_contain_those_that_are_known_to_name_programs() -> None:
    known = {
        *("core.fsmonitor", "core.pager", "core.editor", "core.sshCommand", "core.askPass", "core.gitProxy"),
        *("credential.helper", "diff.external", "diff.x.command", "diff.x.textconv", "filter.x.clean"),
        *("filter.x.process", "filter.x.smudge", "gpg.program", "gpg.x.program", "merge.x.driver", "pager.log"),
        *("alias.x", "core.alternateRefsCommand", "remote.x.uploadpack", "sequence.editor"),
    }
    assert known <= {*program_keys()}
    assert len(program_keys()) > 400


def test_git_itself_runs_the_programs(hostile: HostileRepository) -> None:
    missing = ("show", f"{hostile.missing}:lamps/lamp.yaml")
    run_plain_git(hostile.root, (*READING, ("log", "-p", "-2"), missing, ("diff", "--ext-diff", "HEAD~3", "HEAD~1")))
    expected = {"core.sshCommand", "gpg.program"}
    is_omitted = "filter.x.process" not in hostile.keys
    expected |= {"filter.x.clean", "diff.x.textconv"} if is_omitted else {"filter.x.process", "core.fsmonitor"}
    assert expected <= hostile.take_witnesses()


def test_no_command_runs_a_program(hostile: HostileRepository, capsys: pytest.CaptureFixture[str]) -> None:
    for commands in COMMANDS.values():
        for command in commands:
            vicode(*(word.format(missing=hostile.missing) for word in command))
            assert hostile.take_witnesses() == set(), command
    (hostile.root / ".git" / "vicode-generated").write_text(f"{'0' * 40}\n{'0' * 40}\n", encoding="utf-8")
    vicode("hook", "post-merge")
    assert hostile.take_witnesses() == set()


def test_content_that_is_not_here_is_an_error(hostile: HostileRepository, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("diff", hostile.missing, "--", "lamps/lamp.yaml") == 2
    assert "vicode: " in capsys.readouterr().err
    repository = find_repository(hostile.root)
    with pytest.raises(GitError, match="was not fetched"):
        repository.read(hostile.missing, "lamps/lamp.yaml")
    assert repository.read(hostile.missing, "lamps") is None
    assert repository.read("HEAD", "lamps/module") is None
    assert hostile.take_witnesses() == set()


def test_the_history_of_the_editor_runs_no_program(hostile: HostileRepository) -> None:
    file = hostile.root / "lamps" / "lamp.yaml"
    design = read_design(file.read_text(encoding="utf-8")).design
    assert design is not None
    signed, missing, first = list_revisions(file)
    assert compare_with_revision(file, signed, design).lines == ("~ time Lit → Dark: 0.4 → 0.2",)
    with pytest.raises(GitError, match="was not fetched"):
        compare_with_revision(file, missing, design)
    assert compare_with_revision(file, first, design).lines == ()
    assert hostile.take_witnesses() == set()


def test_no_method_runs_a_program(hostile: HostileRepository) -> None:
    assert {name for name in vars(Repository) if not name.startswith("_")} - {"root"} == set(METHODS)
    for name, call in METHODS.items():
        # The default program for signatures has no key.
        with contextlib.suppress(GitError) if name == "replace_tree_of_head" else contextlib.nullcontext():
            call(find_repository(hostile.root))
        assert hostile.take_witnesses() == set(), name
    # The style of conflicts has no valid value.
    with contextlib.suppress(GitError):
        merge_lines(*(hostile.root / name for name in ("ours", "base", "theirs")))
    assert hostile.take_witnesses() == set()


def test_each_module_that_reads_repositories_is_tested() -> None:
    assert _modules_with(r"^ *(from vicode\.git import|import vicode\.git|from vicode import .*\bgit\b)") == {
        *COMMANDS,
        *EDITOR_MODULES,
    }


def test_one_module_calls_git() -> None:
    assert _modules_with(r"""(?<![\w.])["']git["']""") == {"vicode/git.py"}


def _modules_with(pattern: str) -> set[str]:
    return {
        path.relative_to(ROOT).as_posix()
        for path in ROOT.glob("vicode/**/*.py")
        if re.search(pattern, path.read_text(encoding="utf-8"), re.MULTILINE)
    }


def test_no_private_folder_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own").mkdir()
    (tmp_path / "temporary").mkdir()
    init(tmp_path / "own")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    repository = find_repository(tmp_path / "own")
    first = repository.head
    assert [*(tmp_path / "temporary").iterdir()]
    second = commit(tmp_path / "own", "second")
    git(tmp_path / "own", "checkout", "-q", "--detach", "HEAD~1")
    git(tmp_path / "own", "tag", "new", second)
    git(tmp_path / "own", "pack-refs", "--all")
    assert (repository.resolve("HEAD"), repository.resolve("new")) == (first, second)
    del repository
    assert [*(tmp_path / "temporary").iterdir()] == []


def test_a_work_tree_elsewhere_is_refused(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    (tmp_path / "own").mkdir()
    init(tmp_path / "own")
    git(tmp_path / "own", "config", "core.worktree", str(tmp_path / "other"))
    with pytest.raises(GitError, match="is not in a git repository"):
        find_repository(tmp_path / "own")


def test_paths_outside_of_the_work_tree_are_left_out(tmp_path: Path) -> None:
    init(tmp_path)
    (tmp_path / "a.yaml").write_text("a", encoding="utf-8")
    commit(tmp_path, "a")
    blob = git(tmp_path, "rev-parse", "HEAD:a.yaml").strip()
    entry = b"100644 %s\0" + bytes.fromhex(blob)
    inner = _write_tree(tmp_path, entry % b"b.yaml")
    outer = _write_tree(tmp_path, b"40000 ..\0" + bytes.fromhex(inner) + entry % b"a.yaml")
    assert [*find_repository(tmp_path).list_blobs(outer)] == ["a.yaml"]


def _write_tree(folder: Path, content: bytes) -> str:
    (folder / "tree").write_bytes(content)
    return git(folder, "hash-object", "-t", "tree", "-w", "--literally", "tree").strip()


def test_a_linked_work_tree_is_read(lamps: Path) -> None:
    init(lamps)
    git(lamps, "worktree", "add", "-q", "-b", "side", str(lamps.parent / "side"))
    side = lamps.parent / "side"
    (side / "lamp.yaml").write_text("x", encoding="utf-8")
    head = commit(side, "side")
    repository = find_repository(side)
    assert (repository.head, repository.resolve("HEAD@{1}")) == (head, git(lamps, "rev-parse", "main").strip())
    assert not repository.is_modified(["."])
    assert [each.new for each in repository.list_changed("main", None)] == ["lamp.yaml"]


def test_the_configuration_of_the_user_signs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    signer, witness = tmp_path / "signer", tmp_path / "witness"
    for file, text in ((signer, SIGNER), (witness, f"#!/bin/sh\n: > {tmp_path}/witnessed\nexit 1\n")):
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)
    (tmp_path / "user").write_text(f"[gpg]\nprogram = {signer}\n", encoding="utf-8")
    (tmp_path / "own").mkdir()
    init(tmp_path / "own")
    for name, value in (("gpg.program", str(witness)), ("commit.gpgSign", "true")):
        git(tmp_path / "own", "config", name, value)
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(tmp_path / "user"))
    find_repository(tmp_path / "own").replace_tree_of_head()
    assert "-----BEGIN PGP SIGNATURE-----" in git(tmp_path / "own", "cat-file", "commit", "HEAD")
    assert not (tmp_path / "witnessed").exists()
