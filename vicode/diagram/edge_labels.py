"""Labels of edges: text, icon and size."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from vicode.diagram.diagram_model import DiagramEdge, DiagramNode
from vicode.diagram.node_geometry import Size
from vicode.diagram.text_metrics import LABEL_FONT, shorten, text_width
from vicode.diagram.transition_labels import GuardKind, without_aliases

PADDING = 8.0
_HEIGHT, _ICON, _ORDER = 22.0, 15.0, 18.0
_MAX_WIDTH, _CROWDED_WIDTH, _MIN_WIDTH = 150.0, 100.0, 60.0
_SHORTER_WIDTHS = (90.0, 50.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeLabel:
    """`order` is the priority with its separator; `icon` is the guard kind or None."""

    order: str
    icon: GuardKind | None
    text: str
    order_width: float
    icon_width: float
    size: Size


def make_edge_label(
    edge: DiagramEdge, ends: tuple[DiagramNode, DiagramNode], *, parallel_count: int = 1
) -> EdgeLabel | None:
    """The label of an edge between two nodes, None if it is empty. `parallel_count`: edges that share the space."""
    if edge.edge_type != "transition":
        return None
    used = (_ORDER if edge.order else 0) + (_ICON if _guard_icon(edge) else 0)
    return _make_label(edge, max(_MIN_WIDTH, _available_width(*ends, beside=parallel_count) - used))


def shorter_labels(edge: DiagramEdge, label: EdgeLabel) -> Iterator[EdgeLabel]:
    """Yield the label with progressively shorter texts."""
    for room in _SHORTER_WIDTHS:
        shorter = _make_label(edge, room) if text_width(label.text, LABEL_FONT) > room + 10 else None
        if shorter:
            yield shorter


def textless_labels(edge: DiagramEdge) -> Iterator[EdgeLabel]:
    """The label without its text, unless it becomes empty."""
    bare = _make_label(replace(edge, label=""), 0)
    if bare:
        yield bare


def _make_label(edge: DiagramEdge, room: float) -> EdgeLabel | None:
    order, icon = str(edge.order) if edge.order else "", _guard_icon(edge)
    text = edge.label if text_width(edge.label, LABEL_FONT) <= room else without_aliases(edge.label)
    text = shorten(text, LABEL_FONT, room)
    if not order and not text and not icon:
        return None
    if order and (text or icon):
        order += " · "
    order_width = text_width(order, LABEL_FONT) + 1 if order else 0.0
    icon_width = _ICON if icon else 0.0
    total = math.ceil(2 * PADDING + order_width + icon_width + text_width(text, LABEL_FONT))
    size = Size(width=total, height=_HEIGHT)
    return EdgeLabel(order=order, icon=icon, text=text, order_width=order_width, icon_width=icon_width, size=size)


def _guard_icon(edge: DiagramEdge) -> GuardKind | None:
    return edge.guard_kind if edge.guard_kind in (GuardKind.TIMER, GuardKind.CODE, GuardKind.TREE) else None


def _available_width(source: DiagramNode, target: DiagramNode, *, beside: int) -> float:
    """The maximum width of a label between nodes side by side: the gap, or less if parallel edges share a steep gap."""
    if source is target:
        return _MAX_WIDTH
    gap = abs(target.center[0] - source.center[0]) - (source.size.width + target.size.width) / 2
    if gap < 30 or gap < 2 * (abs(target.center[1] - source.center[1]) - source.size.height):
        return _CROWDED_WIDTH if beside > 2 else _MAX_WIDTH
    return min(_MAX_WIDTH, max(_MIN_WIDTH, gap - 30))
