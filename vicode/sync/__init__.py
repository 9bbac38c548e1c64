"""Generated code that was edited outside: so far the guard that keeps it from being written over."""

from vicode.sync.guard import find_edits_by_file, find_hand_edits

__all__ = ["find_edits_by_file", "find_hand_edits"]
