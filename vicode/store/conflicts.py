"""Merge conflicts in the text of a file: entries between the markers <<<<<<<, ======= and >>>>>>>.

vicode and git write the same markers. vicode puts the name of the item after "ours: " and "theirs: ": parts with the
same name are one conflict. Between the sides, git may write the common ancestor after |||||||.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

_MARKER = re.compile(r"^(<<<<<<<|\|\|\|\|\|\|\||=======|>>>>>>>)(?:[ \t]+(.*?))?[ \t]*\r?$", re.MULTILINE)
_BEGIN, _BASE, _MIDDLE, _END = "<<<<<<<", "|||||||", "=======", ">>>>>>>"
_UNNAMED = "\0"
_OURS_LABEL, _THEIRS_LABEL = "ours: ", "theirs: "


@dataclass(frozen=True, slots=True, kw_only=True)
class ConflictPart:
    """One marked part of a text; `start` and `end` are its offsets, markers included."""

    start: int
    end: int
    ours: str
    theirs: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TextConflict:
    """A conflict with all its parts; `name` is its item, empty in a conflict that git wrote."""

    name: str
    parts: tuple[ConflictPart, ...]

    @property
    def ours(self) -> str:
        return "".join(part.ours for part in self.parts)

    @property
    def theirs(self) -> str:
        return "".join(part.theirs for part in self.parts)


@dataclass(frozen=True, slots=True, kw_only=True)
class LineChange:
    """The lines from `start` to `end` of our text and those of theirs, for the conflict `name`."""

    name: str
    start: int
    end: int
    theirs: tuple[str, ...]


def find_conflicts(text: str) -> tuple[TextConflict, ...]:
    """The conflicts of a text in order; incomplete markers are none."""
    if _BEGIN not in text:
        return ()
    found: list[tuple[str, ConflictPart]] = []
    open_markers: list[re.Match[str]] = []
    for marker in _MARKER.finditer(text):
        kind = marker[1]
        if kind == _BEGIN:
            open_markers = [marker]
        elif kind != _END:
            open_markers += [marker] if open_markers else []
        elif open_markers:
            found += _read_part(text, [*open_markers, marker])
            open_markers = []
    parts: dict[str, list[ConflictPart]] = {}
    for index, (name, part) in enumerate(found):
        parts.setdefault(name or f"{_UNNAMED}{index}", []).append(part)
    return tuple(
        TextConflict(name="" if name.startswith(_UNNAMED) else name, parts=tuple(group))
        for name, group in parts.items()
    )


def resolve_conflicts(text: str, conflicts: Iterable[TextConflict], *, takes_theirs: bool) -> str:
    """The text with one side of some of its conflicts, without their markers."""
    parts = sorted((part for conflict in conflicts for part in conflict.parts), key=lambda part: part.start)
    pieces: list[str] = []
    offset = 0
    for part in parts:
        pieces += [text[offset : part.start], part.theirs if takes_theirs else part.ours]
        offset = part.end
    return "".join([*pieces, text[offset:]])


def format_conflicts(lines: list[str], changes: Iterable[LineChange]) -> str:
    """Our text with markers around the lines that change; the changes do not overlap."""
    pieces: list[str] = []
    offset = 0
    for change in sorted(changes, key=lambda each: (each.start, each.end)):
        ours = lines[change.start : change.end]
        pieces += lines[offset : change.start]
        pieces += [f"{_BEGIN} {_OURS_LABEL}{change.name}\n", *_ended(ours), f"{_MIDDLE}\n"]
        pieces += [*_ended(change.theirs), f"{_END} {_THEIRS_LABEL}{change.name}\n"]
        offset = change.end
    return "".join([*pieces, *lines[offset:]])


def _ended(lines: Iterable[str]) -> list[str]:
    """Lines that end with a line break, as markers need lines of their own."""
    return [line if line.endswith("\n") else f"{line}\n" for line in lines]


def _read_part(text: str, markers: list[re.Match[str]]) -> list[tuple[str, ConflictPart]]:
    """The part between markers with its name; nothing if a marker is missing or repeated."""
    kinds = [kind for kind, _group in groupby(marker[1] for marker in markers)]
    if kinds not in ([_BEGIN, _MIDDLE, _END], [_BEGIN, _BASE, _MIDDLE, _END]) or len(kinds) != len(markers):
        return []
    begin, middle, end = markers[0], markers[-2], markers[-1]
    part = ConflictPart(
        start=begin.start(),
        end=_next_line(text, end),
        ours=text[_next_line(text, begin) : markers[1].start()],
        theirs=text[_next_line(text, middle) : end.start()],
    )
    label = begin[2] or ""
    name = label.removeprefix(_OURS_LABEL)
    return [(name if name != label and end[2] == _THEIRS_LABEL + name else "", part)]


def _next_line(text: str, marker: re.Match[str]) -> int:
    return min(marker.end() + 1, len(text))
