"""Detects edits in generated code, so that generation does not overwrite them."""

from vicode.sync.hand_edits import find_hand_edits, find_hand_edits_by_file

__all__ = ["find_hand_edits", "find_hand_edits_by_file"]
