"""Which old members of a collection became which new ones."""

from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from typing import cast

from vicode.store.schema_types import FormatValue

_MIN_SIMILARITY = 0.5
_MAX_COMPARISONS = 20_000


def match_names(old: Sequence[tuple[str, FormatValue]], new: Sequence[tuple[str, FormatValue]]) -> list[int | None]:
    """For every new pair the number of the old one: the same name, else a renamed one of like content."""
    numbers = {name: number for number, (name, _value) in enumerate(old)}
    matches = [numbers.get(name) for name, _value in new]
    old_values, new_values = [value for _name, value in old], [value for _name, value in new]
    _match_equal(old_values, new_values, matches)
    _match_similar(old_values, new_values, matches)
    return matches


def match_items(old: Sequence[FormatValue], new: Sequence[FormatValue]) -> list[int | None]:
    """For every new item the number of the old one: equal in order, equal but moved, changed in its place, or alike."""
    matches: list[int | None] = [None] * len(new)
    for block in SequenceMatcher(None, old, new, autojunk=False).get_matching_blocks():
        for step in range(block.size):
            matches[block.b + step] = block.a + step
    _match_equal(old, new, matches)
    _match_ids(old, new, matches)
    _match_gaps(len(old), matches)
    _match_similar(old, new, matches)
    return matches


def longest_increasing_subsequence(numbers: Iterable[int]) -> set[int]:
    """The longest rising selection of distinct numbers: those that can stay while the others move."""
    best: list[list[int]] = []
    for number in numbers:
        chain = next((chain for chain in reversed(best) if chain[-1] < number), [])
        if len(chain) == len(best):
            best.append([*chain, number])
        elif number < best[len(chain)][-1]:
            best[len(chain)] = [*chain, number]
    return set(best[-1]) if best else set()


def similarity(old: FormatValue, new: FormatValue) -> float:
    """How much of two values is the same, from 0 to 1."""
    if old == new:
        return 1.0
    if not isinstance(old, tuple) or not isinstance(new, tuple) or not old or not new:
        return 0.0
    if all(isinstance(each, float | int) for each in (*old, *new)):
        # Another position is hardly another thing.
        return 0.5
    if _is_pairs(old) and _is_pairs(new):
        before, after = _as_dict(old), _as_dict(new)
        names = {*before, *after}
        return sum(similarity(before.get(name, ""), after.get(name, "")) for name in names) / len(names)
    return sum(map(similarity, old, new)) / max(len(old), len(new))


def _is_pairs(value: tuple[FormatValue, ...]) -> bool:
    return all(isinstance(each, tuple) and len(each) == 2 and isinstance(each[0], str) for each in value)


def _as_dict(value: FormatValue) -> dict[str, FormatValue]:
    return dict(cast("tuple[tuple[str, FormatValue], ...]", value))


def _unmatched(count: int, matches: list[int | None]) -> tuple[list[int], list[int]]:
    taken = set(matches)
    old_left = [number for number in range(count) if number not in taken]
    return old_left, [number for number, match in enumerate(matches) if match is None]


def _match_equal(old: Sequence[FormatValue], new: Sequence[FormatValue], matches: list[int | None]) -> None:
    old_left, new_left = _unmatched(len(old), matches)
    waiting: dict[FormatValue, list[int]] = {}
    for number in reversed(old_left):
        waiting.setdefault(old[number], []).append(number)
    for number in new_left:
        if waiting.get(new[number]):
            matches[number] = waiting[new[number]].pop()


def _match_ids(old: Sequence[FormatValue], new: Sequence[FormatValue], matches: list[int | None]) -> None:
    old_left, new_left = _unmatched(len(old), matches)
    by_id = {_get_id(old[number]): number for number in reversed(old_left)}
    for number in new_left:
        id_ = _get_id(new[number])
        if id_ is not None and id_ in by_id:
            matches[number] = by_id.pop(id_)


def _get_id(value: FormatValue) -> FormatValue | None:
    return _as_dict(value).get("id") if isinstance(value, tuple) and _is_pairs(value) else None


def _match_gaps(old_count: int, matches: list[int | None]) -> None:
    """Pair what stands between the same neighbours, when it is as many as before."""
    taken = set(matches)
    for first, last in _gaps(matches):
        before = matches[first - 1] if first else -1
        assert before is not None
        count = last - first
        run = []
        number = before + 1
        while number < old_count and number not in taken:
            run.append(number)
            number += 1
        if len(run) == count:
            matches[first:last] = run


def _gaps(matches: list[int | None]) -> list[tuple[int, int]]:
    gaps: list[tuple[int, int]] = []
    start: int | None = None
    for number, match in enumerate([*matches, -1]):
        if match is None and start is None:
            start = number
        elif match is not None and start is not None:
            gaps.append((start, number))
            start = None
    return gaps


def _match_similar(old: Sequence[FormatValue], new: Sequence[FormatValue], matches: list[int | None]) -> None:
    old_left, new_left = _unmatched(len(old), matches)
    if len(old_left) * len(new_left) > _MAX_COMPARISONS:
        return
    scored = [
        (-similarity(old[before], new[after]), abs(before - after), before, after)
        for before in old_left
        for after in new_left
    ]
    taken: set[int] = set()
    for score, _distance, before, after in sorted(scored):
        if -score >= _MIN_SIMILARITY and before not in taken and matches[after] is None:
            matches[after] = before
            taken.add(before)
