"""Merges two concurrent changes of a text, as the browser does in `text_merge.js`."""

from typing import NamedTuple


class TextChange(NamedTuple):
    """The replacement of the characters from `start` to `end` by `text`."""

    start: int
    end: int
    text: str


def find_change(old: str, new: str) -> TextChange:
    """The smallest region of `old` whose replacement gives `new`."""
    start, limit = 0, min(len(old), len(new))
    while start < limit and old[start] == new[start]:
        start += 1
    kept = 0
    while kept < limit - start and old[len(old) - 1 - kept] == new[len(new) - 1 - kept]:
        kept += 1
    return TextChange(start, len(old) - kept, new[start : len(new) - kept])


def merge_texts(base: str, ours: str, theirs: str) -> str:
    """The text with both changes of `base`: what one side deleted is gone, what each side inserted is kept.

    At the same place, the text of `ours` comes first: who types on stays together.
    """
    if base in (ours, theirs) or ours == theirs:
        return theirs if ours == base else ours
    changes = sorted((find_change(base, ours), find_change(base, theirs)), key=lambda change: change.start)
    merged, at = "", 0
    for change in changes:
        merged += _kept(base, at, change.start, changes) + change.text
        at = change.start
    return merged + _kept(base, at, len(base), changes)


def _kept(base: str, start: int, end: int, changes: list[TextChange]) -> str:
    """The characters from `start` to `end` that no change replaces."""
    kept = ""
    for change in changes:
        kept += base[start : min(change.start, end)]
        start = max(start, min(change.end, end))
    return kept + base[start:end]
