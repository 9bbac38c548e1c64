"""Three-way merges of designs: what two sides made of one base comes together, what both touched is told."""

from vicode.model.merging.designs import Conflict, Merged, merge
from vicode.model.merging.matching import match, renamed_states, renamed_uses
from vicode.model.merging.texts import merge_lines, merge_typing

__all__ = ["Conflict", "Merged", "match", "merge", "merge_lines", "merge_typing", "renamed_states", "renamed_uses"]
