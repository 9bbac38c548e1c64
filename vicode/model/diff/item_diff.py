"""Compares attributes and lists of items; shared by designs and projects."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any, Protocol

from vicode.findings import DesignPath
from vicode.matching import find_unmoved
from vicode.model.design import Declaration, Point
from vicode.model.diff.changes import Change, ChangeKind, describe_values
from vicode.model.merge.matching import Matches, item_key, match_items
from vicode.model.words import describe_declaration, describe_number, describe_value, field_word

Subject = Callable[[Any], str]
Content = Callable[[Any], str]
Compare = Callable[[DesignPath, Any, Any], Iterator[Change]]
CompareAt = Callable[[DesignPath, DesignPath, Any, Any], Iterator[Change]]
"""Compares items at paths in the old and in the new version."""


class PathOf(Protocol):
    """The path of an item of the old or the new list."""

    def __call__(self, item: Any, index: int, /, *, is_old: bool) -> DesignPath: ...


def diff_fields(
    path: DesignPath, subject: str, old: Any, new: Any, apart: Collection[str] = ("name",)
) -> Iterator[Change]:
    """Compare all fields of two records of one class, except those that the caller compares apart."""
    for field in fields(new):
        if field.compare and field.name not in ("at", *apart):
            before, after, word = getattr(old, field.name), getattr(new, field.name), field_word(type(new), field.name)
            yield from diff_values((*path, field.name), subject, before, after, describe_value, attribute=word)
    yield from diff_positions(path, subject, getattr(old, "at", None), getattr(new, "at", None))


def diff_values(
    path: DesignPath, subject: str, old: Any, new: Any, describe: Callable[[Any], str], *, attribute: str = ""
) -> Iterator[Change]:
    if old != new:
        before, after = describe_values(old, new, describe)
        yield Change(kind=ChangeKind.CHANGED, subject=subject, path=path, attribute=attribute, old=before, new=after)


def diff_positions(path: DesignPath, subject: str, old: Point | None, new: Point | None) -> Iterator[Change]:
    if old != new:
        yield Change(
            kind=ChangeKind.MOVED, subject=subject, path=path, old=_describe_point(old), new=_describe_point(new)
        )


def diff_keyed(
    path: DesignPath, old: Sequence[Any], new: Sequence[Any], *, subject: Subject, content: Content, compare: Compare
) -> Iterator[Change]:
    """Compare lists of items with names. An item that has only another name at the same place is renamed."""
    matches = match_items(old, new, is_keyed=True)
    yield from _diff_presence(
        old, new, matches, lambda item, _index, **_: (*path, str(item_key(item))), subject=subject, content=content
    )
    for before, after in sorted(matches.items(), key=lambda pair: pair[1]):
        here = (*path, str(item_key(new[after])))
        name, renamed = str(item_key(old[before])), str(item_key(new[after]))
        if name != renamed:
            yield Change(kind=ChangeKind.RENAMED, subject=subject(new[after]), path=here, old=name, new=renamed)
        yield from compare(here, old[before], new[after])
    yield from _diff_order(
        path,
        matches,
        old,
        new,
        path_of=lambda index: (*path, str(item_key(new[index]))),
        subject=subject,
        is_keyed=True,
    )


def diff_ordered(
    path: DesignPath,
    old: Sequence[Any],
    new: Sequence[Any],
    *,
    subject: Subject,
    content: Content,
    compare: CompareAt,
    old_path: DesignPath | None = None,
) -> Iterator[Change]:
    """Compare lists whose order is significant; `old_path` is the path of the old list, if it differs."""
    there = path if old_path is None else old_path
    matches = match_described(old, new, lambda item: f"{subject(item)}: {content(item)}")
    yield from _diff_presence(
        old,
        new,
        matches,
        lambda _item, index, *, is_old: (*(there if is_old else path), index),
        subject=subject,
        content=content,
    )
    for before, after in sorted(matches.items(), key=lambda pair: pair[1]):
        yield from compare((*there, before), (*path, after), old[before], new[after])
    yield from _diff_order(
        path, matches, old, new, path_of=lambda index: (*path, index), subject=subject, is_keyed=False
    )


def diff_declarations(
    path: DesignPath, old: Sequence[Declaration], new: Sequence[Declaration], kind: str, owner: str = ""
) -> Iterator[Change]:
    def subject(declaration: Declaration) -> str:
        return f"{kind} {declaration.name}{owner}"

    def compare(here: DesignPath, before: Declaration, after: Declaration) -> Iterator[Change]:
        return diff_fields(here, subject(after), before, after)

    return diff_keyed(path, old, new, subject=subject, content=describe_declaration, compare=compare)


def _diff_presence(
    old: Sequence[Any],
    new: Sequence[Any],
    matches: Mapping[int, int],
    path_of: PathOf,
    *,
    subject: Subject,
    content: Content,
) -> Iterator[Change]:
    for index, item in enumerate(old):
        if index not in matches:
            where = path_of(item, index, is_old=True)
            yield Change(kind=ChangeKind.REMOVED, subject=subject(item), path=where, old=content(item))
    taken = set(matches.values())
    for index, item in enumerate(new):
        if index not in taken:
            where = path_of(item, index, is_old=False)
            yield Change(kind=ChangeKind.ADDED, subject=subject(item), path=where, new=content(item))


def match_described(old: Sequence[Any], new: Sequence[Any], describe: Callable[[Any], str]) -> Matches:
    """Match the items of lists; also those with the same description, and a replaced one of which one field differs."""
    matches = match_items(old, new, is_keyed=False)
    taken = set(matches.values())
    added = [index for index in range(len(new)) if index not in taken]
    for index in [index for index in range(len(old)) if index not in matches]:
        text, gap = describe(old[index]), _find_gap(index, matches, len(old), len(new))
        target = next((each for each in added if describe(new[each]) == text), None)
        if target is None and gap in added and _differs_once(old[index], new[gap]):
            target = gap
        if target is not None:
            matches[index] = target
            added.remove(target)
    return matches


def _find_gap(index: int, matches: Matches, olds: int, news: int) -> int:
    """The index of the only new item between the neighbors of an old one; -1 if there are more or none."""
    before = matches.get(index - 1, -3) if index else -1
    after = matches.get(index + 1, -3) if index + 1 < olds else news
    return before + 1 if before + 2 == after else -1


def _differs_once(old: Any, new: Any) -> bool:
    if type(old) is not type(new):
        return False
    return [getattr(old, field.name) == getattr(new, field.name) for field in fields(old)].count(False) == 1


def _diff_order(
    path: DesignPath,
    matches: Mapping[int, int],
    old: Sequence[Any],
    new: Sequence[Any],
    *,
    path_of: Callable[[int], DesignPath],
    subject: Subject,
    is_keyed: bool,
) -> Iterator[Change]:
    """The items that changed their place among those in both lists."""
    kept = sorted(matches)
    ranks = {index: rank for rank, index in enumerate(sorted(matches.values()))}
    unmoved = find_unmoved(matches[index] for index in kept)
    moved = [(rank, matches[index]) for rank, index in enumerate(kept) if matches[index] not in unmoved]
    if any(rank == ranks[target] for rank, target in moved):
        # Places do not describe an item that moved past others and has its old place again.
        labels = {
            matches[index]: str(item_key(new[matches[index]])) if is_keyed else str(rank + 1)
            for rank, index in enumerate(kept)
        }
        yield Change(
            kind=ChangeKind.CHANGED,
            subject=f"{path[-1]}{_describe_owner(path[:-1])}",
            path=path,
            attribute="order",
            old=", ".join(labels.values()),
            new=", ".join(labels[index] for index in sorted(labels)),
        )
        return
    for rank, target in moved:
        yield Change(
            kind=ChangeKind.MOVED,
            subject=subject(new[target]),
            path=path_of(target),
            attribute="place",
            old=f"place {rank + 1} of {len(old)}",
            new=f"place {ranks[target] + 1} of {len(new)}",
        )


def _describe_owner(path: DesignPath) -> str:
    """The item that contains a list, such as " of state Kick"; empty for the lists of a file."""
    if not path:
        return ""
    if isinstance(path[-1], int):
        return f" of decision {path[-1] + 1}{_describe_owner(path[:-2])}"
    if path == ("common",):
        return " of common section"
    return f" of state {path[-1]}" if path[0] == "states" else f" of {path[-1]}"


def _describe_point(point: Point | None) -> str:
    return ", ".join(map(describe_number, point)) if point else ""
