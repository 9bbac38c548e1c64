"""Sizes of nodes on the canvas, and the occupied area.

The canvas measures text in the browser; here widths are estimated, rather too wide than too narrow.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.diagram.text_metrics import LABEL_FONT, shorten, text_width
from vicode.model.design import Point

GAP = 30.0
"""Minimum distance in pixels between automatically placed boxes."""

NOTE_LINE_HEIGHT, NOTE_PADDING = 16.0, 12.0
_NOTE_TEXT_WIDTH, _MAX_NOTE_LINES = 200.0, 40
_HEIGHT = 60.0
MIN_WIDTH, _MAX_WIDTH = 140.0, 280.0
_CELL_SIZE = (320.0, 120.0)
_WIDE_CHARACTERS = frozenset("mwMW@%")


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """Width and height in pixels."""

    width: float
    height: float


COMMON_SIZE = Size(width=140.0, height=40.0)


def state_size(name: str) -> Size:
    """The box of a state: wider for a long name, up to a limit at which the canvas shortens it."""
    return Size(width=_box_width(name, 44), height=_HEIGHT)


def use_size(alias: str, component: str) -> Size:
    """The hexagon of a used component, with its name in a small font below the alias."""
    return Size(width=max(_box_width(alias, 64), _box_width(component, 44)), height=_HEIGHT)


def note_lines(text: str) -> list[str]:
    """The text of a note, wrapped."""
    lines: list[str] = []
    for paragraph in text.strip().splitlines()[:_MAX_NOTE_LINES] or [""]:
        line = ""
        for word in paragraph.split():
            longer = f"{line} {word}".strip()
            if line and text_width(longer, LABEL_FONT) > _NOTE_TEXT_WIDTH:
                lines.append(line)
                longer = word
            line = longer
        lines.append(shorten(line, LABEL_FONT, _NOTE_TEXT_WIDTH) if line else "")
    return lines[:_MAX_NOTE_LINES]


def note_size(text: str) -> Size:
    """The box of a note around its lines."""
    lines = note_lines(text)
    width = max(text_width(line, LABEL_FONT) for line in lines) + 2 * NOTE_PADDING + 4
    return Size(width=max(80, math.ceil(width / 20) * 20), height=len(lines) * NOTE_LINE_HEIGHT + 2 * NOTE_PADDING)


def estimate_text_width(text: str) -> float:
    """The approximate width of text in a bold font of 14 pixels."""
    return sum(map(_character_width, " ".join(text[:120].split())))


class OccupancyGrid:
    """The placed boxes in a coarse grid, so that a query does not depend on their number."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[Point, Size]]] = {}

    def occupy(self, at: Point, size: Size) -> None:
        """Mark a box with this center as occupied."""
        for cell in _cells(at, size):
            self._cells.setdefault(cell, []).append((at, size))

    def is_free(self, at: Point, size: Size, gap: float = GAP) -> bool:
        """Whether a box with this center keeps its distance from all others."""
        wide = Size(width=size.width + 2 * gap, height=size.height + 2 * gap)
        return not any(_overlap(at, wide, *other) for cell in _cells(at, wide) for other in self._cells.get(cell, ()))

    def occupy_first_free(self, candidates: Iterable[Point], size: Size) -> Point:
        at = next(position for position in candidates if self.is_free(position, size))
        self.occupy(at, size)
        return at


def _cells(at: Point, size: Size) -> Iterator[tuple[int, int]]:
    left, right = at[0] - size.width / 2, at[0] + size.width / 2
    top, bottom = at[1] - size.height / 2, at[1] + size.height / 2
    for column in range(math.floor(left / _CELL_SIZE[0]), math.floor(right / _CELL_SIZE[0]) + 1):
        for row in range(math.floor(top / _CELL_SIZE[1]), math.floor(bottom / _CELL_SIZE[1]) + 1):
            yield column, row


def _overlap(at: Point, size: Size, other: Point, other_size: Size) -> bool:
    return (
        abs(at[0] - other[0]) < (size.width + other_size.width) / 2
        and abs(at[1] - other[1]) < (size.height + other_size.height) / 2
    )


def _box_width(text: str, around: float) -> float:
    room = math.ceil((estimate_text_width(text) + around) / 20) * 20.0
    return min(_MAX_WIDTH, max(MIN_WIDTH, room))


def _character_width(letter: str) -> float:
    if ord(letter) > 0x2E80:
        return 15.0
    if letter in _WIDE_CHARACTERS:
        return 13.0
    return 10.0 if letter.isupper() else 8.5
