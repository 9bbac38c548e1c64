"""Three-way merges of designs and texts."""

from vicode.model.merge.design_merge import Conflict, MergeResult, merge_designs
from vicode.model.merge.matching import find_renamed_states, find_renamed_uses, item_key, match_items
from vicode.model.merge.text_merge import contains_edits, merge_characters, merge_lines

__all__ = [
    "Conflict",
    "MergeResult",
    "contains_edits",
    "find_renamed_states",
    "find_renamed_uses",
    "item_key",
    "match_items",
    "merge_characters",
    "merge_designs",
    "merge_lines",
]
