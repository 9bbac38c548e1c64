"""Folded block scalars."""

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from vicode.store.yaml_writer import format_block_text

words = st.text("abcdef", min_size=1, max_size=30)


@pytest.mark.parametrize("text", ["word", "two  spaces", "a\ttab and more", "two lines\nof text"])
def test_a_text_that_folding_would_change_is_not_folded(text: str) -> None:
    block = format_block_text(text, 2, folded=True)
    assert block is None or block.startswith("|")
    assert block is None or yaml.safe_load(f"doc: {block}\n")["doc"] == text


@given(st.lists(words, min_size=2, max_size=40), st.sampled_from(["", "\n"]))
def test_a_folded_text_is_read_back(parts: list[str], end: str) -> None:
    text = " ".join(parts) + end
    block = format_block_text(text, 2, folded=True)
    assert block is not None
    assert block.startswith(">")
    assert all(len(line) <= 102 for line in block.split("\n"))
    assert yaml.safe_load(f"doc: {block}\n")["doc"] == text
