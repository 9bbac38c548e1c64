"""Design files that cannot be parsed: marks at errors, and saving without overwriting other changes."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import Workspace
from vicode.editor.session.recovery.broken_file import FileModifiedError, parse_text, read_file_text, write_fixed_text

BROKEN = "vicode: 1\ncomponent: A\nstats:\n  S: {}\n"


def test_findings_are_marked_at_their_characters() -> None:
    reading = parse_text(BROKEN, "a.yaml")
    (mark,) = (mark for mark in reading.marks if "stats" in mark.message)
    assert BROKEN[mark.start : mark.end] == "stats"
    assert mark.line == 3
    assert "did you mean 'states'?" in mark.message


def test_saving_fails_if_the_file_has_changed(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text(BROKEN)
    fixed = BROKEN.replace("stats", "states")
    with pytest.raises(FileModifiedError):
        write_fixed_text(file, fixed, "another text")
    write_fixed_text(file, fixed, read_file_text(file))
    assert file.read_text() == fixed
    file.unlink()
    with pytest.raises(FileModifiedError):
        write_fixed_text(file, fixed, fixed)


def test_broken_file_names_are_relative_to_the_project(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "b.yaml").write_text("component: [\n")
    (tmp_path / "a.yaml").write_text("vicode: 1\ncomponent: A\ninitial: S\nstates: {S: {}}\n")
    assert Workspace(tmp_path, key="k").broken_file_names == ("deep/b.yaml",)


def test_a_project_file_with_conflicts_is_broken(tmp_path: Path) -> None:
    conflict = "constants:\n<<<<<<< HEAD\n  a: 1\n=======\n  a: 2\n>>>>>>> topic\n"
    (tmp_path / "project.yaml").write_text(f"vicode: 1\nproject: P\n{conflict}")
    (tmp_path / "a.yaml").write_text("vicode: 1\ncomponent: A\ninitial: S\nstates: {S: {}}\n")
    workspace = Workspace(tmp_path, key="k")
    assert workspace.broken_file_names == ("project.yaml",)
    parsed = parse_text(read_file_text(tmp_path / "project.yaml"), "project.yaml")
    assert [finding.rule.code for finding in parsed.findings] == ["Y113"]
    assert not parsed.is_sound_project
    assert parse_text("vicode: 1\nproject: P\nconstants:\n  a: 2\n", "project.yaml").is_sound_project


@given(st.text(max_size=60) | st.text("a: b\n[]{}\r\t'\"é😀\u2028", max_size=60))
def test_no_text_raises(text: str) -> None:
    assert all(0 <= mark.start <= mark.end <= len(text) for mark in parse_text(text, "a.yaml").marks)
