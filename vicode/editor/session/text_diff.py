"""A side-by-side diff of two texts, without long unchanged parts."""

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher
from enum import StrEnum


class LineStatus(StrEnum):
    """The status of a row; GAP stands for omitted unchanged lines."""

    SAME = "same"
    CHANGED = "changed"
    ADDED = "added"
    REMOVED = "removed"
    GAP = "gap"


@dataclass(frozen=True, slots=True, kw_only=True)
class DiffRow:
    """A line of the old text next to one of the new text; a number is 0 if there is no line.

    The text of a gap is in `old`.
    """

    status: LineStatus
    old_number: int = 0
    old: str = ""
    new_number: int = 0
    new: str = ""


def side_by_side(old: str, new: str, context: int = 3) -> tuple[DiffRow, ...]:
    """The changed lines with `context` unchanged lines around them; empty for equal texts."""
    olds, news = old.splitlines(), new.splitlines()
    # autojunk would ignore frequent lines, of which generated code has many.
    matcher = SequenceMatcher(None, olds, news, autojunk=False)
    rows: list[DiffRow] = []
    before = 0
    for group in matcher.get_grouped_opcodes(context):
        first = group[0][1]
        if first > before:
            rows.append(_gap(first - before))
        rows += [row for part in group for row in _rows(olds, news, part)]
        before = group[-1][2]
    if rows and len(olds) > before:
        rows.append(_gap(len(olds) - before))
    return tuple(rows)


def _gap(count: int) -> DiffRow:
    return DiffRow(status=LineStatus.GAP, old=f"{count} unchanged line{'s' * (count != 1)}")


def _rows(olds: list[str], news: list[str], part: tuple[str, int, int, int, int]) -> Iterator[DiffRow]:
    tag, old_from, old_to, new_from, new_to = part
    for at in range(max(old_to - old_from, new_to - new_from)):
        has_old, has_new = old_from + at < old_to, new_from + at < new_to
        if tag == "equal":
            change = LineStatus.SAME
        elif has_old and has_new:
            change = LineStatus.CHANGED
        else:
            change = LineStatus.REMOVED if has_old else LineStatus.ADDED
        yield DiffRow(
            status=change,
            old_number=old_from + at + 1 if has_old else 0,
            old=olds[old_from + at] if has_old else "",
            new_number=new_from + at + 1 if has_new else 0,
            new=news[new_from + at] if has_new else "",
        )
