"""Matches the members of a new collection to those of the old one."""

from collections.abc import Sequence
from typing import cast

from vicode.matching import Match, match_equal, match_similar, unmatched
from vicode.store.schema_types import FormatValue


def match_names(old: Sequence[tuple[str, FormatValue]], new: Sequence[tuple[str, FormatValue]]) -> list[Match]:
    """For each new pair the index of the old pair with the same name, or else with equal or similar content."""
    indices = {name: index for index, (name, _value) in enumerate(old)}
    matches = [indices.get(name) for name, _value in new]
    old_values, new_values = [value for _name, value in old], [value for _name, value in new]
    match_equal(old_values, new_values, matches)
    _match_similar(old_values, new_values, matches)
    return matches


def match_items(old: Sequence[FormatValue], new: Sequence[FormatValue]) -> list[Match]:
    """For each new item the index of the matching old item, None if there is none.

    Items match in this order: equal items of a common subsequence, equal items that moved, items with the same id,
    changed items between matched neighbors, similar items.
    """
    matches: list[Match] = [None] * len(new)
    match_equal(old, new, matches)
    _match_ids(old, new, matches)
    _match_gaps(len(old), matches)
    _match_similar(old, new, matches)
    return matches


def similarity(old: FormatValue, new: FormatValue) -> float:
    """The similarity of two values, from 0 to 1 (equal)."""
    if old == new:
        return 1.0
    if not isinstance(old, tuple) or not isinstance(new, tuple) or not old or not new:
        return 0.0
    if all(isinstance(item, float | int) for item in (*old, *new)):
        # Positions often change without any other change.
        return 0.5
    if _is_pairs(old) and _is_pairs(new):
        before, after = _as_dict(old), _as_dict(new)
        names = {*before, *after}
        return sum(similarity(before.get(name, ""), after.get(name, "")) for name in names) / len(names)
    return sum(map(similarity, old, new)) / max(len(old), len(new))


def _is_pairs(value: tuple[FormatValue, ...]) -> bool:
    return all(isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], str) for item in value)


def _as_dict(value: FormatValue) -> dict[str, FormatValue]:
    return dict(cast("tuple[tuple[str, FormatValue], ...]", value))


def _match_ids(old: Sequence[FormatValue], new: Sequence[FormatValue], matches: list[Match]) -> None:
    old_left, new_left = unmatched(len(old), matches)
    by_id = {_get_id(old[index]): index for index in reversed(old_left)}
    for index in new_left:
        id_ = _get_id(new[index])
        if id_ is not None and id_ in by_id:
            matches[index] = by_id.pop(id_)


def _get_id(value: FormatValue) -> FormatValue | None:
    return _as_dict(value).get("id") if isinstance(value, tuple) and _is_pairs(value) else None


def _match_gaps(old_count: int, matches: list[Match]) -> None:
    """Match unmatched items between the same neighbors if their number is unchanged."""
    matched = set(matches)
    for first, last in _gaps(matches):
        before = matches[first - 1] if first else -1
        assert before is not None
        count = last - first
        old_gap = []
        index = before + 1
        while index < old_count and index not in matched:
            old_gap.append(index)
            index += 1
        if len(old_gap) == count:
            matches[first:last] = old_gap


def _gaps(matches: list[Match]) -> list[tuple[int, int]]:
    gaps: list[tuple[int, int]] = []
    start: int | None = None
    for index, match in enumerate([*matches, -1]):
        if match is None and start is None:
            start = index
        elif match is not None and start is not None:
            gaps.append((start, index))
            start = None
    return gaps


def _match_similar(old: Sequence[FormatValue], new: Sequence[FormatValue], matches: list[Match]) -> None:
    match_similar(len(old), matches, lambda before, after: similarity(old[before], new[after]))
