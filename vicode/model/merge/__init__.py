"""Three-way merges of designs and texts."""

from vicode.model.merge.design_merge import (
    Conflict,
    MergeResult,
    ProjectMergeResult,
    merge_designs,
    merge_projects,
)
from vicode.model.merge.matching import find_renamed_states, find_renamed_uses, item_key, match_items
from vicode.model.merge.text_merge import (
    MergeChunk,
    contains_edits,
    merge_lines,
    merge_texts,
    split_chunks,
)

__all__ = [
    "Conflict",
    "MergeChunk",
    "MergeResult",
    "ProjectMergeResult",
    "contains_edits",
    "find_renamed_states",
    "find_renamed_uses",
    "item_key",
    "match_items",
    "merge_designs",
    "merge_lines",
    "merge_projects",
    "merge_texts",
    "split_chunks",
]
