"""A change of one item of a design, and its description in words."""

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import SequenceMatcher
from enum import StrEnum
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Decision, Stay, Transition

_MAX_LENGTH = 100
_CONTEXT_LENGTH = 30


class ChangeKind(StrEnum):
    """What happened to an item. MOVED is a change of its position in the diagram or of its place in a list."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"
    MOVED = "moved"
    RENAMED = "renamed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One change.

    Attributes:
        kind: What happened to the item.
        subject: The item in words, such as "state Kick"; after a rename, with its new name.
        path: The path of the item in the new version; of a removed item, its path in the old version.
        attribute: The changed attribute in words; empty if the item as a whole was added, removed, moved or renamed.
        old: The old value as text; empty if there was none.
        new: The new value as text.
    """

    kind: ChangeKind
    subject: str
    path: DesignPath
    attribute: str = ""
    old: str = ""
    new: str = ""


_SIGNS = {
    ChangeKind.ADDED: "+",
    ChangeKind.REMOVED: "-",
    ChangeKind.CHANGED: "~",
    ChangeKind.MOVED: ">",
    ChangeKind.RENAMED: "=",
}


def describe_change(change: Change) -> str:
    """One line, such as "~ guard LookForBall → FollowBall: near → near and seen"."""
    sign = _SIGNS[change.kind]
    match change.kind:
        case ChangeKind.ADDED | ChangeKind.REMOVED:
            value = _shorten(change.new or change.old)
            return f"{sign} {change.subject}{': ' if value else ''}{value}"
        case ChangeKind.RENAMED:
            kind = change.subject.removesuffix(change.new)
            return f"{sign} renamed {kind}{change.old} → {change.new}"
        case ChangeKind.MOVED:
            return f"{sign} moved {change.subject}: {change.old or '(automatic)'} → {change.new or '(automatic)'}"
    blocks = _changed_blocks(change)
    if _is_shown_in_lines(blocks):
        removed, added = (sum(len(block[side]) for block in blocks) for side in (0, 1))
        counts = f"{_count_lines(change.old)} → {_count_lines(change.new)} (+{added} -{removed})"
        return f"{sign} {_attribute_of(change)}: {counts}"
    if blocks:
        ((removed_lines, added_lines),) = blocks
        return f"{sign} {_attribute_of(change)}: {_describe_pair(*removed_lines, *added_lines)}"
    return f"{sign} {_attribute_of(change)}: {_describe_pair(change.old, change.new)}"


def changed_lines(change: Change) -> tuple[str, ...]:
    """The lines that a change of several lines removes and adds, with their signs; empty for other changes."""
    blocks = _changed_blocks(change)
    if not _is_shown_in_lines(blocks):
        return ()
    signed = (lines for removed, added in blocks for lines in (("-", removed), ("+", added)))
    return tuple(f"{sign} {line}" for sign, lines in signed for line in lines)


def describe_changes(changes: Iterable[Change]) -> tuple[str, ...]:
    """The lines of all changes; the lines that differ are indented below their change."""
    return tuple(
        line
        for change in changes
        for line in (describe_change(change), *(f"    {each}" for each in changed_lines(change)))
    )


def describe_decision(source: str, decision: Decision) -> str:
    """The subject of a decision, such as "transition Wait → Kick"."""
    match decision:
        case Transition(to=to):
            return f"transition {source} → {to}"
        case Stay():
            return f"stay in {source}"
        case _:
            return f"decision of {source}"


def describe_values(old: object, new: object, describe: Callable[[Any], str]) -> tuple[str, str]:
    """Both values as texts that differ, also where the values have the same description."""
    before, after = describe(old), describe(new)
    return (before, after) if before != after else (repr(old), repr(new))


def _attribute_of(change: Change) -> str:
    """The changed attribute with its item; the name of a transition is clear without its kind."""
    if not change.attribute or not change.subject:
        return change.attribute or change.subject
    if change.subject.startswith("transition "):
        return f"{change.attribute} {change.subject.removeprefix('transition ')}"
    return f"{change.attribute} of {change.subject}"


_Block = tuple[list[str], list[str]]


def _changed_blocks(change: Change) -> list[_Block]:
    """The removed and added lines of each place where a changed text of several lines differs."""
    if change.kind is not ChangeKind.CHANGED or "\n" not in change.old + change.new:
        return []
    before, after = change.old.splitlines(), change.new.splitlines()
    opcodes = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    return [(before[a:b], after[c:d]) for kind, a, b, c, d in opcodes if kind != "equal"]


def _is_shown_in_lines(blocks: list[_Block]) -> bool:
    """A single line that changed stands in the line of its change."""
    return bool(blocks) and [tuple(map(len, block)) for block in blocks] != [(1, 1)]


def _describe_pair(old: str, new: str) -> str:
    """Both texts in one line; where they look the same, the part that differs, in quotation marks."""
    before, after = _shorten(old) or "(none)", _shorten(new) or "(none)"
    if before == after:
        same = next((at for at, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
        start = max(0, same - _CONTEXT_LENGTH)
        parts = (json.dumps(text[start : start + _MAX_LENGTH], ensure_ascii=False) for text in (old, new))
        before, after = (f"{'…' * bool(start)}{part}" for part in parts)
    return f"{before} → {after}"


def _count_lines(text: str) -> str:
    count = text.count("\n") + 1
    return f"{count} line{'s' * (count != 1)}" if text else "(none)"


def _shorten(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= _MAX_LENGTH else f"{line[: _MAX_LENGTH - 1]}…"
