"""Text merges by lines."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.model.merge import merge_lines

texts = st.text("ab \n", max_size=12)


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "merged"),
    [
        ("a\nb\nc", "A\nb\nc", "a\nb\nC", "A\nb\nC"),
        ("a\nb\nc", "a\nc", "a\nb\nc\nd", "a\nc\nd"),
        ("a", "b", "c", None),
        ("", "ours", "theirs", None),
        ("a\nb", "x\ny", "x\ny", "x\ny"),
    ],
)
def test_lines_are_merged_unless_they_are_adjacent(base: str, ours: str, theirs: str, merged: str | None) -> None:
    assert merge_lines(base, ours, theirs) == merged


@given(texts, texts)
def test_unchanged_side_yields_the_other_side(base: str, text: str) -> None:
    assert merge_lines(base, text, base) == text
    assert merge_lines(base, base, text) == text
    assert merge_lines(base, text, text) == text
