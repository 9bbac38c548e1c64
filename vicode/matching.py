"""Matches the items of two versions of a list: which item continues which, and which items did not move."""

from bisect import bisect_left
from collections.abc import Callable, Collection, Hashable, Iterable, Sequence
from difflib import SequenceMatcher

Match = int | None
"""The index of the old item that a new item continues; None for an added item."""

_MIN_SIMILARITY = 0.5
_MAX_COMPARISONS = 20_000


def match_equal(old: Sequence[Hashable], new: Sequence[Hashable], matches: list[Match]) -> None:
    """Match equal items among those without a match: first those in the same order, then moved ones.

    Args:
        old: The old items.
        new: The new items.
        matches: For each new item its old one; completed in place.
    """
    taken = set(matches)
    for block in SequenceMatcher(None, old, new, autojunk=False).get_matching_blocks():
        for step in range(block.size):
            if matches[block.b + step] is None and block.a + step not in taken:
                matches[block.b + step] = block.a + step
                taken.add(block.a + step)
    by_value: dict[Hashable, list[int]] = {}
    for index in reversed(range(len(old))):
        if index not in taken:
            by_value.setdefault(old[index], []).append(index)
    for index, item in enumerate(new):
        if matches[index] is None and by_value.get(item):
            matches[index] = by_value[item].pop()


def match_similar(count: int, matches: list[Match], similarity: Callable[[int, int], float]) -> None:
    """Match the most similar items first among those without a match, the nearest of equally similar ones.

    Nothing is done if there are too many to compare.

    Args:
        count: Number of old items.
        matches: For each new item its old one; completed in place.
        similarity: The similarity of an old and a new item by their indices, from 0 to 1.
    """
    old_left, new_left = unmatched(count, matches)
    if len(old_left) * len(new_left) > _MAX_COMPARISONS:
        return
    scored = [
        (-similarity(before, after), abs(before - after), before, after) for before in old_left for after in new_left
    ]
    taken: set[int] = set()
    for score, _distance, before, after in sorted(scored):
        if -score >= _MIN_SIMILARITY and before not in taken and matches[after] is None:
            matches[after] = before
            taken.add(before)


def unmatched(count: int, matches: Sequence[Match]) -> tuple[list[int], list[int]]:
    """The old items, of which there are `count`, and the new items without a match."""
    taken: Collection[Match] = set(matches)
    old_left = [index for index in range(count) if index not in taken]
    return old_left, [index for index, match in enumerate(matches) if match is None]


def find_unmoved(matches: Iterable[Match]) -> set[int]:
    """The old items that keep their order: a longest increasing subsequence of distinct numbers."""
    ends: list[int] = []  # The smallest end of an increasing subsequence of each length.
    before: dict[int, Match] = {}
    for number in matches:
        if number is not None:
            length = bisect_left(ends, number)
            before[number] = ends[length - 1] if length else None
            ends[length : length + 1] = [number]
    unmoved: set[int] = set()
    last: Match = ends[-1] if ends else None
    while last is not None:
        unmoved.add(last)
        last = before[last]
    return unmoved
