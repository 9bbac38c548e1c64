"""Curves of the edges between one pair of nodes: parallel lanes, detours around boxes, self-loops on free sides.

The edges of a pair are one bundle: lanes beside each other, with room for their labels. The bundle is tried straight,
and then with growing bends to both sides, until it crosses no box; otherwise the bend with the fewest crossings is
taken. Each curve is one cubic Bézier.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import pairwise

from vicode.diagram.diagram_model import DiagramEdge, DiagramNode
from vicode.diagram.edge_labels import EdgeLabel
from vicode.diagram.node_geometry import Size
from vicode.diagram.spatial_index import BezierWeights, CubicBezier, ObstacleIndex, Rect, RectIndex
from vicode.model.design import Point

HEX_SLANT = 16.0
CLEARANCE, _LABEL_GAP = 8.0, 6.0
_MIN_LANE, _MAX_LANE = 24.0, 100.0
# Minimum distance of an end from the corners of its box.
_CORNER_INSET = (14.0, 12.0)
# Tried in this order: straight, then increasing curvature to either side of boxes in the way.
_BEND_OFFSETS = (0.0, 45.0, -45.0, 85.0, -85.0, 135.0, -135.0, 200.0, -200.0, 280.0, -280.0, 370.0, -370.0)
_MIN_FLAT_BEND = 85.0
_SIDES = ((0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0))
# Steeper pairs count as vertical.
_MAX_HORIZONTAL_SLOPE = 0.4
_EPSILON = 1e-9


def parallel_curves(
    edges: Sequence[DiagramEdge],
    labels: Sequence[EdgeLabel | None],
    ends: tuple[DiagramNode, DiagramNode],
    obstacles: ObstacleIndex,
) -> list[CubicBezier]:
    """Curves of parallel edges in lane order; lanes leave room for their labels."""
    first, second = reading_order(*ends)
    normal = _normal(first, second)
    pair = (first, second, normal)
    most = min(_width_across(node, normal) for node in (first, second))
    # For each lane, its offset from the centers, and the rest that must come from bending.
    inner = [(max(-most, min(most, lane)), lane) for lane in _lane_offsets(labels, normal)]
    lanes = [(begins, lane - begins) for begins, lane in inner]
    own = {first.key, second.key}
    best: tuple[float, list[CubicBezier]] = math.inf, []
    for bow in _BEND_OFFSETS:
        for is_flat in (False, True) if abs(bow) >= _MIN_FLAT_BEND else (False,):
            curves = [
                _bent_curve(edge, pair, lane=lane, bow=bow, is_flat=is_flat)
                for edge, lane in zip(edges, lanes, strict=True)
            ]
            blocked = _count_crossed_boxes(curves, own, obstacles, best[0])
            if blocked < best[0]:
                best = blocked, curves
            if not blocked:
                return curves
    return best[1]


def self_loop_curves(
    node: DiagramNode, labels: Sequence[EdgeLabel | None], others: Sequence[DiagramNode], boxes: RectIndex
) -> list[CubicBezier]:
    """Self-loops use the sides with the fewest other edges; further ones grow around them."""
    room = max([40.0, *(label.size.width for label in labels if label)])
    sides = sorted(_SIDES, key=lambda side: _side_load(node, side, others) + _side_occupancy(node, side, room, boxes))
    return [_self_loop(node, sides[index % 4], index // 4) for index in range(len(labels))]


def point_on_curve(curve: CubicBezier, t: float) -> Point:
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    a, b, c, d = _weights(t)
    return (a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3)


def sample_curve(curve: CubicBezier, count: int) -> Iterator[Point]:
    """Points of a curve in equal steps, both ends included."""
    return _curve_points(curve, _sample_weights(count))


def curve_length(curve: CubicBezier) -> float:
    """The approximate length of a curve."""
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    points = [
        (a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3) for a, b, c, d in _sample_weights(16)
    ]
    return sum(map(math.dist, points, points[1:]))


def reading_order(a: DiagramNode, b: DiagramNode) -> tuple[DiagramNode, DiagramNode]:
    """The node that is read first: the left one, or the upper one if they are stacked."""
    dx, dy = b.center[0] - a.center[0], b.center[1] - a.center[1]
    is_first = dx > 0 if abs(dx) > _MAX_HORIZONTAL_SLOPE * abs(dy) else dy > 0 or (dy == 0 and a.key < b.key)
    return (a, b) if is_first else (b, a)


def _normal(first: DiagramNode, second: DiagramNode) -> Point:
    """The direction across the edge: downwards, or to the right for stacked nodes."""
    dx, dy = second.center[0] - first.center[0], second.center[1] - first.center[1]
    length = math.hypot(dx, dy) or 1
    sign = 1 if abs(dx) > _MAX_HORIZONTAL_SLOPE * abs(dy) else -1
    return (-sign * dy / length, sign * dx / length)


def _lane_offsets(labels: Sequence[EdgeLabel | None], normal: Point) -> list[float]:
    """The offset of each lane from the center line, so that labels at the same height do not overlap."""
    sizes = [label.size if label else Size(width=0, height=0) for label in labels]
    positions = [0.0]
    for one, other in pairwise(sizes):
        wide = (one.width + other.width) / 2 + _LABEL_GAP
        high = max(one.height, other.height) + _LABEL_GAP
        gap = min(wide / (abs(normal[0]) or _EPSILON), high / (abs(normal[1]) or _EPSILON))
        positions.append(positions[-1] + min(_MAX_LANE, max(_MIN_LANE, gap)))
    return [position - positions[-1] / 2 for position in positions]


def _bent_curve(
    edge: DiagramEdge,
    pair: tuple[DiagramNode, DiagramNode, Point],
    *,
    lane: tuple[float, float],
    bow: float,
    is_flat: bool,
) -> CubicBezier:
    """A curve in a lane: offset as far as the boxes allow, then bent; `bow` adds curvature."""
    first, second, normal = pair
    inner, rest = lane
    apex = rest + bow
    source, target = (first, second) if edge.source == first.key else (second, first)
    start, end = _translated(source.center, normal, inner), _translated(target.center, normal, inner)

    def along(part: float, out: float) -> Point:
        return _translated((start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part), normal, out)

    if is_flat:
        near, far = along(0.12, apex * 4 / 3), along(0.88, apex * 4 / 3)
        return (*_border_point(source, start, near), *near, *far, *_border_point(target, end, far))
    control = along(0.5, apex * 2)
    p, q = _border_point(source, start, control), _border_point(target, end, control)
    return (*p, *quadratic_to_cubic(p, control), *quadratic_to_cubic(q, control), *q)


def _translated(at: Point, by: Point, times: float) -> Point:
    return (at[0] + by[0] * times, at[1] + by[1] * times)


def quadratic_to_cubic(end: Point, control: Point) -> Point:
    """The control point next to an end of the cubic curve that equals a quadratic one."""
    return (end[0] + 2 / 3 * (control[0] - end[0]), end[1] + 2 / 3 * (control[1] - end[1]))


def _width_across(node: DiagramNode, normal: Point) -> float:
    wide = (node.size.width / 2 - _CORNER_INSET[0]) / (abs(normal[0]) or _EPSILON)
    high = (node.size.height / 2 - _CORNER_INSET[1]) / (abs(normal[1]) or _EPSILON)
    return min(wide, high)


def _border_point(node: DiagramNode, start: Point, towards: Point) -> Point:
    """The intersection of the node's border with the ray from a point inside it to another point."""
    dx, dy = towards[0] - start[0], towards[1] - start[1]
    x, y = start[0] - node.center[0], start[1] - node.center[1]
    half_width, half_height = node.size.width / 2, node.size.height / 2
    if not dx and not dy:
        return (node.center[0], node.center[1] - half_height)
    reach = min(_steps_to_border(x, dx, half_width), _steps_to_border(y, dy, half_height))
    if node.node_type == "component":
        slope = HEX_SLANT / half_height
        for sign in (-1, 1):
            reach = min(reach, _steps_to_border(x + sign * slope * y, dx + sign * slope * dy, half_width))
    return (start[0] + dx * reach, start[1] + dy * reach)


def _steps_to_border(value: float, by: float, half: float) -> float:
    """The number of steps `by` from a value within ±half to the border."""
    return (math.copysign(half, by) - value) / by if by else math.inf


def _count_crossed_boxes(curves: Sequence[CubicBezier], own: set[str], boxes: ObstacleIndex, enough: float) -> float:
    """How many boxes the curves cross, sampled in steps smaller than a box; stops counting at `enough`."""
    blocked = 0
    for curve in curves:
        steps = min(120, max(8, math.ceil(curve_length(curve) / 24)))
        blocked += boxes.count_hit(curve, _sample_weights(steps)[1:-1], own, enough - blocked)
        if blocked >= enough:
            break
    return blocked


def _curve_points(curve: CubicBezier, weights: Iterable[BezierWeights]) -> Iterator[Point]:
    x0, y0, x1, y1, x2, y2, x3, y3 = curve
    return ((a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3) for a, b, c, d in weights)


def _weights(t: float) -> BezierWeights:
    u = 1 - t
    return (u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t)


@cache
def _sample_weights(count: int) -> tuple[BezierWeights, ...]:
    """Cached, because few different step counts occur."""
    return tuple(_weights(step / count) for step in range(count + 1))


def _side_load(node: DiagramNode, side: Point, others: Sequence[DiagramNode]) -> float:
    """How many edges start or end at a side."""
    # The initial mark is at the upper left, which makes the top slightly worse.
    burden = 1.5 if side[1] == -1 and node.initial else 0.0
    burden += 0.2 if side[0] else 0.0
    for other in others:
        dx, dy = other.center[0] - node.center[0], other.center[1] - node.center[1]
        burden += max(0.0, (dx * side[0] + dy * side[1]) / (math.hypot(dx, dy) or 1)) ** 2
    return burden


def _side_occupancy(node: DiagramNode, side: Point, room: float, boxes: RectIndex) -> float:
    size = Size(width=62 + room - 16, height=70) if side[0] else Size(width=max(room, 80), height=76)
    out = (
        node.center[0] + side[0] * (node.size.width + size.width) / 2,
        node.center[1] + side[1] * (node.size.height + size.height) / 2,
    )
    return 3.0 * len(boxes.overlapping(Rect.from_center(out, size).expanded(4)) - {node.key})


def _self_loop(node: DiagramNode, side: Point, ring: int) -> CubicBezier:
    reach, half = 62.0 + ring * 26, 16.0 + ring * 6
    spread = half + 18
    foot = (node.center[0] + side[0] * node.size.width / 2, node.center[1] + side[1] * node.size.height / 2)

    def at(across: float, out: float) -> Point:
        return (foot[0] - side[1] * across + side[0] * out, foot[1] + side[0] * across + side[1] * out)

    return (*at(-half, 0), *at(-spread, reach), *at(spread, reach), *at(half, 0))
