"""Splits the difference of two versions of a unit into changes that are explained one by one.

A diff has many readings: a changed guard is also a removed and an added `if`. The small reading is tried first, pairs
of statements of one kind, since it keeps most of the design; then whole additions and removals, and these part by part.
"""

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace
from difflib import SequenceMatcher
from itertools import groupby

from vicode.sync.code_items import COMMENT, CodeItem
from vicode.sync.interpret.edit_context import CodeChange
from vicode.sync.interpret.units import Items


def find_changes(old: Items, new: Items) -> Iterator[CodeChange]:
    """Yield the changes of statements of one kind first, then what remains as additions and removals."""
    whole: list[CodeChange] = []
    own, other = ([item.key for item in items] for items in (old, new))
    for tag, first, last, start, end in SequenceMatcher(None, own, other, autojunk=False).get_opcodes():
        if tag == "equal":
            continue
        line = new[min(start, len(new) - 1)].first if new else 1
        change = CodeChange(removed=old[first:last], added=new[start:end], line=line)
        yield from (replace(pair, line=line) for pair in _pairs(change.removed, change.added))
        whole.append(change)
    for change in whole:
        yield change
        yield from (replace(run, line=change.line) for run in _runs(change))


def _pairs(removed: Sequence[CodeItem], added: Sequence[CodeItem]) -> Iterator[CodeChange]:
    """Yield pairs of an old and a new item; what remains between them are additions and removals."""
    signatures = [_signature(item) for item in removed], [_signature(item) for item in added]
    matcher = SequenceMatcher(None, *signatures, autojunk=False)
    for tag, first, last, start, end in matcher.get_opcodes():
        if tag == "equal":
            for old, new in zip(removed[first:last], added[start:end], strict=True):
                if old.key != new.key:
                    yield CodeChange(removed=(old,), added=(new,))
            continue
        if last - first == end - start == 1:
            yield CodeChange(removed=(removed[first],), added=(added[start],))
        for is_added, items in ((False, removed[first:last]), (True, added[start:end])):
            if items and len(removed) > 0 and len(added) > 0:
                yield CodeChange(added=tuple(items)) if is_added else CodeChange(removed=tuple(items))


def _runs(change: CodeChange) -> Iterator[CodeChange]:
    """Yield the additions and removals of a change: whole, by definition, and item by item."""
    for items, is_added in ((change.added, True), (change.removed, False)):
        if not items:
            continue
        parts = [items]
        owned = [tuple(group) for _owner, group in groupby(items, key=_definition_of)]
        parts += [*owned, *(group[1:] for group in owned if isinstance(group[0].node, ast.FunctionDef) and group[1:])]
        parts += _statements(items)
        parts += [(item,) for item in items]
        for part in dict.fromkeys(parts):
            yield CodeChange(added=part) if is_added else CodeChange(removed=part)


def _definition_of(item: CodeItem) -> str:
    return ".".join(item.scope.split(".")[:2])


def _statements(items: tuple[CodeItem, ...]) -> Iterator[tuple[CodeItem, ...]]:
    """Yield each statement with the comments before it and the items nested in it."""
    start = 0
    for index, item in enumerate(items):
        following = items[index + 1] if index + 1 < len(items) else None
        is_inside = following is not None and following.depth > items[start].depth
        if item.kind != COMMENT and not is_inside:
            yield items[start : index + 1]
            start = index + 1
    if start < len(items):
        yield items[start:]


def _signature(item: CodeItem) -> tuple[object, ...]:
    """What a changed item has in common with the old one."""
    match item.node:
        case ast.If():
            about = item.code.split()[0]
        case ast.Assign(targets=[target]) | ast.AugAssign(target=target):
            about = ast.unparse(target)
        case ast.Expr(value=ast.Call(func=function, args=[first, *_rest])):
            name = ast.unparse(function)
            about = f"{name} {ast.unparse(first)}" if name in ("self._call", "State") else name
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            about = name
        case _:
            about = ""
    return (item.kind, item.scope, item.depth, about)
