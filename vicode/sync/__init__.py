"""Generated code that was edited outside: so far the guard that keeps it from being written over."""

from vicode.sync.hand_edits import find_hand_edits, find_hand_edits_by_file

__all__ = ["find_hand_edits", "find_hand_edits_by_file"]
