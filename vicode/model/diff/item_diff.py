"""Compares attributes and lists of items; shared by designs and projects."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Declaration, Point
from vicode.model.diff.changes import Change, ChangeKind, describe_declaration, describe_value
from vicode.model.merge.matching import item_key, match_items
from vicode.model.sequences import longest_increasing_subsequence

Subject = Callable[[Any], str]
Content = Callable[[Any], str]
Compare = Callable[[DesignPath, Any, Any], Iterator[Change]]

_DECLARATION_ATTRIBUTES = {
    "type": "type",
    "initial": "value",
    "unit": "unit",
    "range": "range",
    "doc": "description",
    "xabsl_name": "XABSL name",
    "tunable": "tunable",
    "arguments": "arguments",
}


def diff_attributes(
    path: DesignPath, subject: str, old: Any, new: Any, attributes: Mapping[str, str]
) -> Iterator[Change]:
    """Compare fields; `attributes` maps their names to words."""
    for field, word in attributes.items():
        before, after = getattr(old, field), getattr(new, field)
        if before != after:
            yield Change(
                kind=ChangeKind.CHANGED,
                subject=subject,
                path=(*path, field),
                attribute=word,
                old=describe_value(before),
                new=describe_value(after),
            )


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
        old, new, matches, lambda item, _index: (*path, str(item_key(item))), subject=subject, content=content
    )
    for before, after in sorted(matches.items(), key=lambda pair: pair[1]):
        here = (*path, str(item_key(new[after])))
        name, renamed = str(item_key(old[before])), str(item_key(new[after]))
        if name != renamed:
            yield Change(kind=ChangeKind.RENAMED, subject=subject(new[after]), path=here, old=name, new=renamed)
        yield from compare(here, old[before], new[after])
    yield from _diff_order(old, new, matches, lambda index: (*path, str(item_key(new[index]))), subject)


def diff_ordered(
    path: DesignPath, old: Sequence[Any], new: Sequence[Any], *, subject: Subject, content: Content, compare: Compare
) -> Iterator[Change]:
    """Compare lists whose order is significant."""
    matches = match_items(old, new, is_keyed=False)
    yield from _diff_presence(old, new, matches, lambda _item, index: (*path, index), subject=subject, content=content)
    for before, after in sorted(matches.items(), key=lambda pair: pair[1]):
        yield from compare((*path, after), old[before], new[after])
    yield from _diff_order(old, new, matches, lambda index: (*path, index), subject)


def diff_declarations(
    path: DesignPath, old: Sequence[Declaration], new: Sequence[Declaration], kind: str, owner: str = ""
) -> Iterator[Change]:
    def subject(declaration: Declaration) -> str:
        return f"{kind} {declaration.name}{owner}"

    def compare(here: DesignPath, before: Declaration, after: Declaration) -> Iterator[Change]:
        return diff_attributes(here, subject(after), before, after, _DECLARATION_ATTRIBUTES)

    return diff_keyed(path, old, new, subject=subject, content=describe_declaration, compare=compare)


def _diff_presence(
    old: Sequence[Any],
    new: Sequence[Any],
    matches: Mapping[int, int],
    path_of: Callable[[Any, int], DesignPath],
    *,
    subject: Subject,
    content: Content,
) -> Iterator[Change]:
    for index, item in enumerate(old):
        if index not in matches:
            where = path_of(item, index)
            yield Change(kind=ChangeKind.REMOVED, subject=subject(item), path=where, old=content(item))
    taken = set(matches.values())
    for index, item in enumerate(new):
        if index not in taken:
            yield Change(kind=ChangeKind.ADDED, subject=subject(item), path=path_of(item, index), new=content(item))


def _diff_order(
    old: Sequence[Any],
    new: Sequence[Any],
    matches: Mapping[int, int],
    path_of: Callable[[int], DesignPath],
    subject: Subject,
) -> Iterator[Change]:
    """The items that changed their place among those in both lists."""
    kept = sorted(matches)
    ranks = {index: rank for rank, index in enumerate(sorted(matches.values()))}
    unmoved = longest_increasing_subsequence(matches[index] for index in kept)
    for rank, index in enumerate(kept):
        target = matches[index]
        if target not in unmoved:
            yield Change(
                kind=ChangeKind.MOVED,
                subject=subject(new[target]),
                path=path_of(target),
                attribute="place",
                old=f"place {rank + 1} of {len(old)}",
                new=f"place {ranks[target] + 1} of {len(new)}",
            )


def _describe_point(point: Point | None) -> str:
    return f"{point[0]:g}, {point[1]:g}" if point else ""
