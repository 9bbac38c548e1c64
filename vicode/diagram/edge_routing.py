"""Routes of all edges and positions of their labels, by the algorithm of the canvas.

Curves come first, pair of nodes by pair; then labels, short edges first, since these have the fewest places. A label
takes the cheapest of some dozens of positions: far from the middle of its edge costs a little, covering a line more, a
text or a box most; if all are bad, its text is shortened. Nothing is optimized as a whole: each label is placed once,
and once more if another one finds no free place and covers it.
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from vicode.diagram.diagram_model import Diagram, DiagramEdge, DiagramNode
from vicode.diagram.edge_curves import (
    CLEARANCE,
    curve_length,
    parallel_curves,
    point_on_curve,
    reading_order,
    sample_curve,
    self_loop_curves,
)
from vicode.diagram.edge_labels import EdgeLabel, make_edge_label, shorter_labels, textless_labels
from vicode.diagram.spatial_index import CubicBezier, ObstacleIndex, PointIndex, Rect, RectIndex
from vicode.diagram.transition_labels import GuardKind
from vicode.model.design import Point

# Costs of overlaps, highest first. A position farther along its edge is cheaper than covering a line.
_BOX_COST, _LABEL_COST, _EDGE_COST, _USE_EDGE_COST = 12.0, 8.0, 1.4, 0.7
# With more edges, labels ignore lines: there are too many to avoid.
_MAX_AVOIDED_EDGES = 600
_SAMPLE_DISTANCE = 8.0
# Fractions of the edge and offsets from it (1: next to the line, 2: a little farther), best first.
_LABEL_POSITIONS = sorted(
    (
        (abs(part - 0.5) * 2.4 + abs(side) * 1.2, part, side)
        for part in (0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8, 0.14, 0.86)
        for side in (0, 1, -1, 2, -2)
    ),
    key=lambda position: position[0],
)
_LOOP_OFFSETS = ((0.0, 0), (0.4, 0), (0.8, 1), (1.2, -1))
# Fallback: positions at growing distance from the line, so that every label is readable.
_DISTANT_POSITIONS = [
    (side, part) for side in (3, -3, 4, -4, 5, -5, 6, -6) for part in (0.5, 0.42, 0.58, 0.34, 0.66, 0.2, 0.8)
]
_DISTANT_LOOP_OFFSETS = (0, 1, -1, 2, -2, 3, -3)
_VERTICAL_OFFSETS = sorted(range(-40, 44, 4), key=abs)
_DISTANT_STEP = 14.0


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeRoute:
    """The curve of an edge, and its label with the center position."""

    edge: DiagramEdge
    curve: CubicBezier
    label: EdgeLabel | None
    label_position: Point


def route_edges(diagram: Diagram) -> tuple[EdgeRoute, ...]:
    """A route for every edge, in the order of the diagram."""
    router = _EdgeRouter(diagram)
    curves = [route for pair in router.edge_pairs() for route in router.route_pair(pair)]
    # Pairs with the fewest choices first.
    curves.sort(key=lambda route: curve_length(route[1]))
    routes = {edge.key: router.place_label(edge, curve, label) for edge, curve, label in curves}
    for key in router.overlapping:
        router.resolve_overlap(key, routes)
    return tuple(routes[edge.key] for edge in diagram.edges)


class _EdgeRouter:
    """Routes pair by pair, avoiding what is already placed."""

    def __init__(self, diagram: Diagram) -> None:
        self.nodes = {node.key: node for node in diagram.nodes}
        self.boxes, self.labels, self.lines, self.titles = RectIndex(), RectIndex(), PointIndex(), RectIndex()
        self.obstacles = ObstacleIndex(CLEARANCE)
        self.overlapping: list[str] = []
        has_labels = any(edge.label or edge.order or edge.guard_kind is not GuardKind.ALWAYS for edge in diagram.edges)
        self.avoids_edges = has_labels and len(diagram.edges) <= _MAX_AVOIDED_EDGES
        self._edges_at: dict[str, list[DiagramEdge]] = defaultdict(list)
        self._pairs: dict[tuple[str, ...], list[DiagramEdge]] = defaultdict(list)
        self._links = {edge.key for edge in diagram.edges if edge.edge_type != "transition"}
        for node in diagram.nodes:
            rect = Rect.from_center(node.center, node.size)
            self.boxes.add(node.key, rect)
            self.obstacles.add(node.key, rect)
        for frame in diagram.frames:
            self.titles.add(frame.key, frame.title_rect)
        for edge in diagram.edges:
            self._pairs[tuple(sorted((edge.source, edge.target)))].append(edge)
            for end in {edge.source, edge.target}:
                self._edges_at[end].append(edge)

    def edge_pairs(self) -> Iterator[list[DiagramEdge]]:
        """The edges of each pair of nodes in reading order: forward edges first, each direction in priority order."""
        for edges in self._pairs.values():
            first, _second = reading_order(*self._ends(edges[0]))
            yield sorted(edges, key=lambda edge: (edge.source != first.key, edge.order))

    def route_pair(self, edges: Sequence[DiagramEdge]) -> Iterator[tuple[DiagramEdge, CubicBezier, EdgeLabel | None]]:
        """The curves of one pair, with their preferred labels."""
        source, target = self._ends(edges[0])
        labels = [make_edge_label(edge, (source, target), parallel_count=len(edges)) for edge in edges]
        if source is target:
            others = [node for edge in self._edges_at[source.key] for node in self._ends(edge) if node is not source]
            curves = self_loop_curves(source, labels, others, self.boxes)
        else:
            curves = parallel_curves(edges, labels, (source, target), self.obstacles)
        for edge, curve, label in zip(edges, curves, labels, strict=True):
            if self.avoids_edges:
                count = max(2, math.ceil(curve_length(curve) / _SAMPLE_DISTANCE))
                self.lines.add(edge.key, sample_curve(curve, count))
            yield edge, curve, label

    def place_label(self, edge: DiagramEdge, curve: CubicBezier, wanted: EdgeLabel | None) -> EdgeRoute:
        """The route with the best label position; if every position overlaps something, a shorter label may fit."""
        if wanted is None:
            return EdgeRoute(edge=edge, curve=curve, label=None, label_position=point_on_curve(curve, 0.5))
        if edge.label_at is not None:
            part, shift = edge.label_at
            label, at = wanted, _offset_point(curve, min(1.0, max(0.0, part)), shift)
        else:
            label, at = self._find_label_position(edge, curve, wanted)
            if not self._is_free(Rect.from_center(at, label.size)):
                self.overlapping.append(edge.key)
        self.labels.add(edge.key, Rect.from_center(at, label.size))
        return EdgeRoute(edge=edge, curve=curve, label=label, label_position=at)

    def resolve_overlap(self, key: str, routes: dict[str, EdgeRoute]) -> None:
        """Move the labels that a label overlaps, where they have room."""
        for other in sorted(self._overlapping_labels(routes[key]) - {key}):
            route = routes[other]
            if route.edge.label_at is not None or route.label is None:
                continue
            self.labels.remove(other, Rect.from_center(route.label_position, route.label.size))
            label, at = self._find_label_position(route.edge, route.curve, route.label)
            routes[other] = replace(route, label=label, label_position=at)
            self.labels.add(other, Rect.from_center(at, label.size))

    def _overlapping_labels(self, route: EdgeRoute) -> set[str]:
        assert route.label is not None
        return self.labels.overlapping(Rect.from_center(route.label_position, route.label.size).expanded(2))

    def _ends(self, edge: DiagramEdge) -> tuple[DiagramNode, DiagramNode]:
        return self.nodes[edge.source], self.nodes[edge.target]

    def _find_label_position(self, edge: DiagramEdge, curve: CubicBezier, wanted: EdgeLabel) -> tuple[EdgeLabel, Point]:
        best, chosen, least = point_on_curve(curve, 0.5), wanted, math.inf
        for label in (wanted, *shorter_labels(edge, wanted)):
            for price, at in _label_positions(edge, curve, label):
                if price >= least:
                    break
                cost = price + self._overlap_cost(Rect.from_center(at, label.size), edge.key, least - price)
                if cost < least:
                    best, chosen, least = at, label, cost
            if least < _LABEL_COST:
                return chosen, best
        return self._find_distant_position(edge, curve, label) or (chosen, best)

    def _find_distant_position(
        self, edge: DiagramEdge, curve: CubicBezier, shortest: EdgeLabel
    ) -> tuple[EdgeLabel, Point] | None:
        """A position at a greater distance that hides no text; if necessary for the priority alone."""
        for label in (shortest, *textless_labels(edge)):
            near = [at for _price, at in _label_positions(edge, curve, label)] if label is not shortest else []
            for at in (*near, *_distant_positions(edge, curve, label)):
                if self._is_free(Rect.from_center(at, label.size)):
                    return label, at
        return None

    def _is_free(self, rect: Rect) -> bool:
        """Whether a label there overlaps no box, no other label and no title."""
        wide = rect.expanded(2)
        return not any(index.overlapping(wide) for index in (self.boxes, self.labels, self.titles))

    def _overlap_cost(self, rect: Rect, own: str, enough: float) -> float:
        """The cost of what a label there covers; stops adding at `enough`."""
        wide = rect.expanded(2)
        texts = len(self.labels.overlapping(wide)) + len(self.titles.overlapping(wide))
        crowd = _BOX_COST * len(self.boxes.overlapping(wide)) + _LABEL_COST * texts
        if crowd >= enough:
            return crowd
        hidden = self.lines.within(rect) - {own}
        links = len(hidden & self._links)
        return crowd + _USE_EDGE_COST * links + _EDGE_COST * (len(hidden) - links)


def _label_positions(edge: DiagramEdge, curve: CubicBezier, label: EdgeLabel) -> Iterator[tuple[float, Point]]:
    """Candidate positions with their costs, best first."""
    if edge.source == edge.target:
        yield from (
            (price, _loop_label_position(curve, label, slip, is_out=price > 0)) for price, slip in _LOOP_OFFSETS
        )
        return
    for price, part, side in _LABEL_POSITIONS:
        yield price, _position_beside_curve(curve, label, part, side) if side else point_on_curve(curve, part)


def _distant_positions(edge: DiagramEdge, curve: CubicBezier, label: EdgeLabel) -> Iterator[Point]:
    if edge.source == edge.target:
        hung = [_loop_label_position(curve, label, slip, is_out=True) for slip in _DISTANT_LOOP_OFFSETS]
        return ((x, y + rise) for rise in _VERTICAL_OFFSETS for x, y in hung)
    return (_position_beside_curve(curve, label, part, side) for side, part in _DISTANT_POSITIONS)


def _loop_label_position(curve: CubicBezier, label: EdgeLabel, slip: int, *, is_out: bool) -> Point:
    """The label of a self-loop is at its outermost point, so that the loop remains visible."""
    apex = point_on_curve(curve, 0.5)
    out = (apex[0] - (curve[0] + curve[6]) / 2, apex[1] - (curve[1] + curve[7]) / 2)
    if abs(out[0]) < abs(out[1]):
        return (apex[0] + slip * label.size.width * 0.4, apex[1] + (math.copysign(9, out[1]) if is_out else 0))
    return (apex[0] + math.copysign(label.size.width / 2 - 8, out[0]), apex[1] + slip * 18)


def _position_beside_curve(curve: CubicBezier, label: EdgeLabel, part: float, side: int) -> Point:
    """A position next to the line that keeps the line visible."""
    dx, dy = _direction(curve, part)
    reach = (abs(dy) * label.size.width + abs(dx) * label.size.height) / 2
    beyond = 3 if abs(side) == 1 else 9 + _DISTANT_STEP * (abs(side) - 2)
    shift = math.copysign(reach + beyond, side)
    x, y = point_on_curve(curve, part)
    return (x - dy * shift, y + dx * shift)


def _offset_point(curve: CubicBezier, part: float, shift: float) -> Point:
    """The point of the curve at `part`, shifted to the right of its direction."""
    x, y = point_on_curve(curve, part)
    dx, dy = _direction(curve, part)
    return (x - dy * shift, y + dx * shift)


def _direction(curve: CubicBezier, part: float) -> Point:
    behind, ahead = point_on_curve(curve, max(0.0, part - 0.02)), point_on_curve(curve, min(1.0, part + 0.02))
    dx, dy = ahead[0] - behind[0], ahead[1] - behind[1]
    length = math.hypot(dx, dy) or 1
    return (dx / length, dy / length)
