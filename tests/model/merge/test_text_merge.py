"""Text merges by lines and by characters."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.model.merge import merge_characters, merge_lines

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


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "merged"),
    [
        ("the ball", "the red ball", "the ball rolls", "the red ball rolls"),
        ("", "mine", "theirs", "minetheirs"),
        ("seen", "not seen", "seen and near", "not seen and near"),
        ("a\nb", "a\nb!", "?a\nb", "?a\nb!"),
    ],
)
def test_concurrent_typing_is_kept(base: str, ours: str, theirs: str, merged: str) -> None:
    assert merge_characters(base, ours, theirs) == merged


@given(texts, texts)
def test_unchanged_side_yields_the_other_side(base: str, text: str) -> None:
    for merge in (merge_lines, merge_characters):
        assert merge(base, text, base) == text
        assert merge(base, base, text) == text
        assert merge(base, text, text) == text


@given(texts, st.text("XY", max_size=4), st.text("UV", max_size=4), st.integers(0, 12), st.integers(0, 12))
def test_no_inserted_character_is_lost(base: str, mine: str, yours: str, here: int, there: int) -> None:
    merged = merge_characters(base, base[:here] + mine + base[here:], base[:there] + yours + base[there:])
    assert mine in merged
    assert yours in merged
    assert "".join(each for each in merged if each not in "XYUV") == base
