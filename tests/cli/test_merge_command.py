"""`vicode merge`: exit codes and results for designs, generated files and files that are no designs."""

from pathlib import Path

import pytest

from tests.cli.command_runner import BULB, LAMP, lamps, vicode
from vicode.regions import add_header, wrap_region

__all__ = ["lamps"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def merge(folder: Path, base: str, ours: str, theirs: str, *options: str) -> tuple[int, str]:
    """The exit code and the result."""
    for name, text in (("base", base), ("ours", ours), ("theirs", theirs)):
        (folder / name).write_text(text, encoding="utf-8")
    code = vicode("merge", "base", "ours", "theirs", *options)
    return code, (folder / "ours").read_text(encoding="utf-8")


def test_a_clean_merge(folder: Path) -> None:
    ours, theirs = LAMP.replace("after: pause", "after: 3"), LAMP.replace("after: 0.2", "after: 4")
    assert merge(folder, LAMP, ours, theirs) == (0, ours.replace("after: 0.2", "after: 4"))


def test_a_conflict(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ours, theirs = LAMP.replace("after: pause", "after: 3"), LAMP.replace("after: pause", "after: 4")
    code, text = merge(folder, LAMP, ours, theirs, "--path", "lamp.yaml")
    assert code == 1
    assert "<<<<<<< ours: transition 1 of state Dark, after\n" in text
    assert capsys.readouterr().err == "vicode: lamp.yaml: conflict in transition 1 of state Dark, after\n"


def test_a_design_with_errors_is_merged_by_lines(folder: Path) -> None:
    broken = LAMP + "unknown: 1\n"
    assert merge(folder, LAMP, broken, LAMP.replace("pause", "0.3")) == (0, broken.replace("pause", "0.3"))
    code, text = merge(folder, LAMP, broken, LAMP + "other: 1\n")
    assert code == 1
    assert text.endswith("<<<<<<< ours\nunknown: 1\n=======\nother: 1\n>>>>>>> theirs\n")


def test_another_file_is_merged_by_lines(folder: Path) -> None:
    assert merge(folder, "a: 1\nb: 2\nc: 3\n", "a: 0\nb: 2\nc: 3\n", "a: 1\nb: 2\nc: 4\n") == (
        0,
        "a: 0\nb: 2\nc: 4\n",
    )


def test_versions_of_a_generated_file_are_merged_by_lines(folder: Path) -> None:
    base = add_header("a = 1\nb = 1\nc = 1\nd = 1\n", "lamp.yaml")
    ours, theirs = base.replace("a = 1", "a = 2"), base.replace("d = 1", "d = 2")
    assert merge(folder, base, ours, theirs, "--generated", "--path", "lamp.py") == (
        0,
        ours.replace("d = 1", "d = 2"),
    )


def test_versions_that_no_revision_generates_are_a_conflict(folder: Path) -> None:
    base, ours, theirs = (add_header(f"x = {number}\n", "lamp.yaml") for number in range(3))
    code, merged = merge(folder, base, ours, theirs, "--generated", "--path", "lamp.py")
    assert code == 1
    assert "<<<<<<< ours\nx = 1\n=======\nx = 2\n>>>>>>> theirs" in merged


def test_edits_in_generated_files_are_not_lost(folder: Path) -> None:
    text = "def enter():\n" + wrap_region("Dark.enter", "self.count = 1\n", indent="    ")
    base = add_header(text, "lamp.yaml")
    theirs = base.replace("count = 1", "count = 2")
    assert merge(folder, base, base, theirs, "--generated", "--path", "lamp.py") == (0, theirs)
    code, merged = merge(folder, base, base.replace("= 1", "= 3"), theirs, "--generated", "--path", "lamp.py")
    assert code == 1
    assert "<<<<<<< ours" in merged


def test_check_and_gen_report_a_conflict(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ours, theirs = LAMP.replace("after: pause", "after: 3"), LAMP.replace("after: pause", "after: 4")
    merge(lamps.parent, LAMP, ours, theirs)
    (lamps.parent / "ours").replace(lamps / "lamp.yaml")
    capsys.readouterr()
    assert vicode("check", "lamps") == 1
    assert "lamps/lamp.yaml:9:1: error Y113 unresolved-conflict: unresolved merge conflict" in capsys.readouterr().out
    assert vicode("gen", "lamps") == 1
    assert not list(lamps.rglob("lamp.py"))
    assert list(lamps.rglob("bulb.py"))
    assert BULB
