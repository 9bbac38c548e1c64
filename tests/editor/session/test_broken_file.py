"""A broken file is read with its mistakes at their characters, and only ever written over the text that was opened."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session import Workspace
from vicode.editor.session.broken_file import FileModifiedError, parse_text, read_file_text, write_fixed_text

BROKEN = "vicode: 1\ncomponent: A\nstats:\n  S: {}\n"


def test_mistakes_stand_at_their_characters() -> None:
    reading = parse_text(BROKEN, "a.yaml")
    (mark,) = (mark for mark in reading.marks if "stats" in mark.message)
    assert BROKEN[mark.start : mark.end] == "stats"
    assert mark.line == 3
    assert "did you mean 'states'?" in mark.message


def test_it_is_written_only_over_what_was_opened(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text(BROKEN)
    mended = BROKEN.replace("stats", "states")
    with pytest.raises(FileModifiedError):
        write_fixed_text(file, mended, "another text")
    write_fixed_text(file, mended, read_file_text(file))
    assert file.read_text() == mended
    file.unlink()
    with pytest.raises(FileModifiedError):
        write_fixed_text(file, mended, mended)


def test_broken_files_are_named_inside_their_folder(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "b.yaml").write_text("component: [\n")
    (tmp_path / "a.yaml").write_text("vicode: 1\ncomponent: A\ninitial: S\nstates: {S: {}}\n")
    assert Workspace(tmp_path, key="k").broken_file_names == ("deep/b.yaml",)


@given(st.text(max_size=60) | st.text("a: b\n[]{}\r\t'\"é😀\u2028", max_size=60))
def test_no_text_makes_it_raise(text: str) -> None:
    assert all(0 <= mark.start <= mark.end <= len(text) for mark in parse_text(text, "a.yaml").marks)
