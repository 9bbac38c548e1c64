"""The label on an arrow: what it says and how large it is."""

import math
from dataclasses import dataclass

from vicode.diagram.boxes import Size
from vicode.diagram.figure import Arrow
from vicode.diagram.labels import Kind
from vicode.diagram.lettering import LABEL, shorten, text_width

PADDING = 8.0
_HEIGHT, _ICON, _ORDER = 22.0, 15.0, 18.0
_MOST_ROOM, _LEAST_ROOM = 150.0, 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Chip:
    """`order` is the number in front with what separates it, `icon` the sign of its kind or nothing."""

    order: str
    icon: Kind | None
    text: str
    order_width: float
    icon_width: float
    size: Size


def chip_of(arrow: Arrow, *, width: float, height: float) -> Chip | None:
    """The label of an arrow whose ends are so far apart, None when there is nothing to say."""
    if arrow.of != "transition":
        return None
    order = str(arrow.order) if arrow.order else ""
    icon = arrow.kind if arrow.kind in (Kind.TIMER, Kind.CODE, Kind.TREE) else None
    icon_width = _ICON if icon else 0.0
    room = _MOST_ROOM
    if arrow.source != arrow.target:
        room = max(_LEAST_ROOM, _room_between(width, height) - (_ORDER if order else 0) - icon_width)
    text = shorten(arrow.label, LABEL, room)
    if not order and not text and not icon:
        return None
    if order and (text or icon):
        order += " · "
    order_width = text_width(order, LABEL) + 1 if order else 0.0
    total = math.ceil(2 * PADDING + order_width + icon_width + text_width(text, LABEL))
    size = Size(width=total, height=_HEIGHT)
    return Chip(order=order, icon=icon, text=text, order_width=order_width, icon_width=icon_width, size=size)


def _room_between(width: float, height: float) -> float:
    """Between two boxes side by side no wider than the gap, else the label would be pushed off its arrow."""
    if width < 2 * height or width < 30:
        return _MOST_ROOM
    return min(_MOST_ROOM, max(_LEAST_ROOM, width - 30))
