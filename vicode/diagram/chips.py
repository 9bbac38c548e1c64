"""The label on an arrow: what it says and how large it is."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from vicode.diagram.boxes import Size
from vicode.diagram.figure import Arrow, Node
from vicode.diagram.labels import Kind
from vicode.diagram.lettering import LABEL, shorten, text_width

PADDING = 8.0
_HEIGHT, _ICON, _ORDER = 22.0, 15.0, 18.0
_MOST_ROOM, _CROWDED_ROOM, _LEAST_ROOM = 150.0, 100.0, 60.0
_SHORTER = (90.0, 50.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Chip:
    """`order` is the number in front with what separates it, `icon` the sign of its kind or nothing."""

    order: str
    icon: Kind | None
    text: str
    order_width: float
    icon_width: float
    size: Size


def chip_of(arrow: Arrow, ends: tuple[Node, Node], *, beside: int = 1) -> Chip | None:
    """The label of an arrow between two nodes, None when there is nothing to say; `beside`: so many share the way."""
    if arrow.of != "transition":
        return None
    used = (_ORDER if arrow.order else 0) + (_ICON if _icon_of(arrow) else 0)
    return _chip_with(arrow, max(_LEAST_ROOM, _room_between(*ends, beside=beside) - used))


def shorter_chips(arrow: Arrow, chip: Chip) -> Iterator[Chip]:
    """The label with ever less of its text."""
    for room in _SHORTER:
        shorter = _chip_with(arrow, room) if text_width(chip.text, LABEL) > room + 10 else None
        if shorter:
            yield shorter


def bare_chips(arrow: Arrow) -> Iterator[Chip]:
    """The label without its text, if something is left then."""
    bare = _chip_with(replace(arrow, label=""), 0)
    if bare:
        yield bare


def _chip_with(arrow: Arrow, room: float) -> Chip | None:
    order, icon = str(arrow.order) if arrow.order else "", _icon_of(arrow)
    text = shorten(arrow.label, LABEL, room)
    if not order and not text and not icon:
        return None
    if order and (text or icon):
        order += " · "
    order_width = text_width(order, LABEL) + 1 if order else 0.0
    icon_width = _ICON if icon else 0.0
    total = math.ceil(2 * PADDING + order_width + icon_width + text_width(text, LABEL))
    size = Size(width=total, height=_HEIGHT)
    return Chip(order=order, icon=icon, text=text, order_width=order_width, icon_width=icon_width, size=size)


def _icon_of(arrow: Arrow) -> Kind | None:
    return arrow.kind if arrow.kind in (Kind.TIMER, Kind.CODE, Kind.TREE) else None


def _room_between(source: Node, target: Node, *, beside: int) -> float:
    """Side by side no wider than the gap, else it would be pushed off its arrow; less where many share a steep way."""
    if source is target:
        return _MOST_ROOM
    gap = abs(target.at[0] - source.at[0]) - (source.size.width + target.size.width) / 2
    if gap < 30 or gap < 2 * (abs(target.at[1] - source.at[1]) - source.size.height):
        return _CROWDED_ROOM if beside > 2 else _MOST_ROOM
    return min(_MOST_ROOM, max(_LEAST_ROOM, gap - 30))
