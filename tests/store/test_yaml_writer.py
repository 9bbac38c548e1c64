"""Folded block scalars."""

import yaml
from hypothesis import given
from hypothesis import strategies as st

from vicode.store.yaml_writer import format_block_text

words = st.text("abcdef", min_size=1, max_size=30)


@given(st.lists(words, min_size=2, max_size=40), st.sampled_from(["", "\n"]))
def test_a_folded_text_is_read_back(parts: list[str], end: str) -> None:
    text = " ".join(parts) + end
    block = format_block_text(text, 2, folded=True)
    assert block is not None
    assert block.startswith(">")
    assert all(len(line) <= 102 for line in block.split("\n"))
    assert yaml.safe_load(f"doc: {block}\n")["doc"] == text
