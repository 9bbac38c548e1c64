"""Finds the conflict markers that git left in a generated file: the file is not read until they are removed."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from vicode.regions import find_regions
from vicode.store import ConflictPart, find_conflicts, resolve_conflicts

_MARKER = re.compile(r"(?:<{7,}|\|{7,}|>{7,})(?: .*)?")


@dataclass(frozen=True, slots=True, kw_only=True)
class MergeConflict:
    """One place with markers.

    Attributes:
        regions: The ids of the regions in it, empty outside regions.
        lines: The lines of its markers.
        ours: The text of our side; empty, like theirs, if markers are missing.
        theirs: The text of their side.
    """

    regions: tuple[str, ...] = ()
    lines: tuple[int, ...]
    ours: str = ""
    theirs: str = ""


def find_merge_conflicts(text: str, generated: str, comment: str) -> tuple[MergeConflict, ...]:
    """Find the conflicts in a file; lines that are generated, such as those of a text with markers, are none."""
    known = set(generated.split("\n"))
    lines = text.split("\n")
    marked = [
        number
        for number, line in enumerate(lines, start=1)
        if _MARKER.fullmatch(line.rstrip("\r")) and line.rstrip("\r") not in known
    ]
    if not marked:
        return ()
    complete = [each for each in _list_complete(text, comment) if each.lines[0] in marked]
    seen = {number for each in complete for number in each.lines}
    single = (MergeConflict(lines=(number,)) for number in marked if number not in seen)
    return tuple(sorted((*complete, *single), key=lambda each: each.lines))


def _list_complete(text: str, comment: str) -> Iterator[MergeConflict]:
    conflicts = find_conflicts(text)
    sides = [resolve_conflicts(text, conflicts, takes_theirs=is_theirs) for is_theirs in (False, True)]
    regions = [find_regions(side, comment).regions for side in sides]
    parts = sorted((part for conflict in conflicts for part in conflict.parts), key=lambda part: part.start)
    removed = [0, 0]
    for part in parts:
        before = text.count("\n", 0, part.start) + 1
        names: dict[str, None] = {}
        for index, side in enumerate((part.ours, part.theirs)):
            first = before - removed[index]
            last = first + max(side.count("\n"), 1) - 1
            names |= {each.id: None for each in regions[index] if each.line <= last and first <= each.end_line}
            removed[index] += text.count("\n", part.start, part.end) - side.count("\n")
        numbers = _marker_lines(text, part, before)
        yield MergeConflict(regions=tuple(names), lines=numbers, ours=part.ours, theirs=part.theirs)


def _marker_lines(text: str, part: ConflictPart, first: int) -> tuple[int, ...]:
    """The lines of the markers of a part, found by the sides between them."""
    lines = text[part.start : part.end].rstrip("\n").split("\n")
    base = 1 + part.ours.count("\n")
    middle = len(lines) - 2 - part.theirs.count("\n")
    return tuple(first + offset for offset in dict.fromkeys((0, base, middle, len(lines) - 1)))
