"""The curves of the arrows between one pair of nodes: lanes beside each other, around boxes, loops on free sides."""

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import pairwise

from vicode.diagram.boxes import Size
from vicode.diagram.chips import Chip
from vicode.diagram.figure import Arrow, Node
from vicode.diagram.ground import Curve, Obstacles, Rect, Rects, Weights
from vicode.model.design import Point

HEX_SLANT = 16.0
CLEARANCE, _LABEL_GAP = 8.0, 6.0
_LEAST_LANE, _MOST_LANE = 24.0, 100.0
# A line starts at least so far from the corners of its boxes.
_INSET = (14.0, 12.0)
# Tried in this order: straight first, then ever wider bows to either side around boxes in the way.
_BOWS = (0.0, 45.0, -45.0, 85.0, -85.0, 135.0, -135.0, 200.0, -200.0, 280.0, -280.0, 370.0, -370.0)
_FLAT_FROM = 85.0
_SIDES = ((0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0))
# What is nearly flat lies across; beyond this share of the width it counts as standing.
_ACROSS = 0.4
_TINY = 1e-9


def fan(
    arrows: Sequence[Arrow], chips: Sequence[Chip | None], ends: tuple[Node, Node], boxes: Obstacles
) -> list[Curve]:
    """Curves for arrows between two nodes, in lane order; the lanes make room for their labels."""
    first, second = reading_order(*ends)
    normal = _normal(first, second)
    pair = (first, second, normal)
    most = min(_room_across(node, normal) for node in (first, second))
    # Of each lane how far beside the centres it begins, and how much of it is left to bending.
    inner = [(max(-most, min(most, lane)), lane) for lane in _lanes(chips, normal)]
    lanes = [(begins, lane - begins) for begins, lane in inner]
    own = {first.key, second.key}
    best: tuple[float, list[Curve]] = math.inf, []
    for bow in _BOWS:
        for is_flat in (False, True) if abs(bow) >= _FLAT_FROM else (False,):
            curves = [
                _bend(arrow, pair, lane=lane, bow=bow, is_flat=is_flat)
                for arrow, lane in zip(arrows, lanes, strict=True)
            ]
            blocked = _boxes_under(curves, own, boxes, best[0])
            if blocked < best[0]:
                best = blocked, curves
            if not blocked:
                return curves
    return best[1]


def loops(node: Node, chips: Sequence[Chip | None], others: Sequence[Node], boxes: Rects) -> list[Curve]:
    """Self loops take the freest sides, away from the nodes it is connected with; further ones grow around those."""
    room = max([40.0, *(chip.size.width for chip in chips if chip)])
    sides = sorted(_SIDES, key=lambda side: _burden(node, side, others) + _taken(node, side, room, boxes))
    return [_loop(node, sides[index % 4], index // 4) for index in range(len(chips))]


def point_at(curve: Curve, t: float) -> Point:
    """The point of a curve at a share of its way."""
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    a, b, c, d = _weights(t)
    return (a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3)


def points_along(curve: Curve, count: int) -> Iterator[Point]:
    """The points of a curve in so many equal steps, both ends included."""
    return _points_of(curve, _all_weights(count))


def length_of(curve: Curve) -> float:
    """About how long a curve is."""
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    points = [(a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3) for a, b, c, d in _all_weights(16)]
    return sum(map(math.dist, points, points[1:]))


def reading_order(a: Node, b: Node) -> tuple[Node, Node]:
    """Of two nodes the one that is read first: the left one, or the upper one of two that stand above each other."""
    dx, dy = b.at[0] - a.at[0], b.at[1] - a.at[1]
    is_first = dx > 0 if abs(dx) > _ACROSS * abs(dy) else dy > 0 or (dy == 0 and a.key < b.key)
    return (a, b) if is_first else (b, a)


def _normal(first: Node, second: Node) -> Point:
    """Across the way from one node to another: downwards, or to the right when they stand above each other."""
    dx, dy = second.at[0] - first.at[0], second.at[1] - first.at[1]
    length = math.hypot(dx, dy) or 1
    sign = 1 if abs(dx) > _ACROSS * abs(dy) else -1
    return (-sign * dy / length, sign * dx / length)


def _lanes(chips: Sequence[Chip | None], normal: Point) -> list[float]:
    """How far each lane lies beside the middle, so that labels at the same height do not touch."""
    sizes = [chip.size if chip else Size(width=0, height=0) for chip in chips]
    places = [0.0]
    for one, other in pairwise(sizes):
        wide = (one.width + other.width) / 2 + _LABEL_GAP
        high = max(one.height, other.height) + _LABEL_GAP
        gap = min(wide / (abs(normal[0]) or _TINY), high / (abs(normal[1]) or _TINY))
        places.append(places[-1] + min(_MOST_LANE, max(_LEAST_LANE, gap)))
    return [place - places[-1] / 2 for place in places]


def _bend(
    arrow: Arrow, pair: tuple[Node, Node, Point], *, lane: tuple[float, float], bow: float, is_flat: bool
) -> Curve:
    """A curve in a lane: as far beside the centres as the boxes allow, the rest of the way, and `bow`, by bending."""
    first, second, normal = pair
    inner, rest = lane
    apex = rest + bow
    source, target = (first, second) if arrow.source == first.key else (second, first)
    start, end = _shifted(source.at, normal, inner), _shifted(target.at, normal, inner)

    def along(part: float, out: float) -> Point:
        return _shifted((start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part), normal, out)

    if is_flat:
        near, far = along(0.12, apex * 4 / 3), along(0.88, apex * 4 / 3)
        return (*_exit(source, start, near), *near, *far, *_exit(target, end, far))
    control = along(0.5, apex * 2)
    p, q = _exit(source, start, control), _exit(target, end, control)
    return (*p, *_two_thirds(p, control), *_two_thirds(q, control), *q)


def _shifted(at: Point, by: Point, times: float) -> Point:
    return (at[0] + by[0] * times, at[1] + by[1] * times)


def _two_thirds(end: Point, control: Point) -> Point:
    return (end[0] + 2 / 3 * (control[0] - end[0]), end[1] + 2 / 3 * (control[1] - end[1]))


def _room_across(node: Node, normal: Point) -> float:
    wide = (node.size.width / 2 - _INSET[0]) / (abs(normal[0]) or _TINY)
    high = (node.size.height / 2 - _INSET[1]) / (abs(normal[1]) or _TINY)
    return min(wide, high)


def _exit(node: Node, start: Point, towards: Point) -> Point:
    """Where the ray from a point within a node towards another point leaves the node's shape."""
    dx, dy = towards[0] - start[0], towards[1] - start[1]
    x, y = start[0] - node.at[0], start[1] - node.at[1]
    half_width, half_height = node.size.width / 2, node.size.height / 2
    if not dx and not dy:
        return (node.at[0], node.at[1] - half_height)
    reach = min(_stretch(x, dx, half_width), _stretch(y, dy, half_height))
    if node.of == "component":
        slope = HEX_SLANT / half_height
        for sign in (-1, 1):
            reach = min(reach, _stretch(x + sign * slope * y, dx + sign * slope * dy, half_width))
    return (start[0] + dx * reach, start[1] + dy * reach)


def _stretch(value: float, by: float, half: float) -> float:
    """How many steps `by` lead from a value within ±half to the border."""
    return (math.copysign(half, by) - value) / by if by else math.inf


def _boxes_under(curves: Sequence[Curve], own: set[str], boxes: Obstacles, enough: float) -> float:
    """How many boxes curves run over, looked up in steps smaller than a box; from `enough` on nobody counts."""
    blocked = 0
    for curve in curves:
        steps = min(120, max(8, math.ceil(length_of(curve) / 24)))
        blocked += boxes.count_under(curve, _all_weights(steps)[1:-1], own, enough - blocked)
        if blocked >= enough:
            break
    return blocked


def _points_of(curve: Curve, weights: Iterable[Weights]) -> Iterator[Point]:
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    return ((a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3) for a, b, c, d in weights)


def _weights(t: float) -> Weights:
    u = 1 - t
    return (u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t)


@cache
def _all_weights(count: int) -> tuple[Weights, ...]:
    """For so many equal steps along a curve; there are few different counts."""
    return tuple(_weights(step / count) for step in range(count + 1))


def _burden(node: Node, side: Point, others: Sequence[Node]) -> float:
    """How much leaves or comes at a side already."""
    # The initial mark sits at the upper left, so that the top is a little worse than it looks.
    burden = 1.5 if side[1] == -1 and node.initial else 0.0
    burden += 0.2 if side[0] else 0.0
    for other in others:
        dx, dy = other.at[0] - node.at[0], other.at[1] - node.at[1]
        burden += max(0.0, (dx * side[0] + dy * side[1]) / (math.hypot(dx, dy) or 1)) ** 2
    return burden


def _taken(node: Node, side: Point, room: float, boxes: Rects) -> float:
    size = Size(width=62 + room - 16, height=70) if side[0] else Size(width=max(room, 80), height=76)
    out = (
        node.at[0] + side[0] * (node.size.width + size.width) / 2,
        node.at[1] + side[1] * (node.size.height + size.height) / 2,
    )
    return 3.0 * len(boxes.under(Rect.around(out, size).grown(4)) - {node.key})


def _loop(node: Node, side: Point, ring: int) -> Curve:
    reach, half = 62.0 + ring * 26, 16.0 + ring * 6
    spread = half + 18
    foot = (node.at[0] + side[0] * node.size.width / 2, node.at[1] + side[1] * node.size.height / 2)

    def at(across: float, out: float) -> Point:
        return (foot[0] - side[1] * across + side[0] * out, foot[1] + side[0] * across + side[1] * out)

    return (*at(-half, 0), *at(-spread, reach), *at(spread, reach), *at(half, 0))
