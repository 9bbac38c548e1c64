"""The way of every arrow, found as the canvas finds it: arrows between one pair of nodes fan out, boxes are passed."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from vicode.diagram.boxes import Size
from vicode.diagram.chips import Chip, chip_of
from vicode.diagram.figure import Arrow, Figure, Node
from vicode.diagram.ground import Rect, Rects
from vicode.model.design import Point

Curve = tuple[float, float, float, float, float, float, float, float]
"""A cubic one: start, two controls, end."""

HEX_SLANT = 16.0
_LANE, _CLEARANCE = 34.0, 8.0
# Tried in this order: straight first, then ever wider bows to either side around boxes in the way.
_BOWS = (0.0, 45.0, -45.0, 85.0, -85.0, 135.0, -135.0, 200.0, -200.0, 280.0, -280.0)
_SIDES = ((0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0))
_PLACES = (0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8)
_SHIFTS = (0.0, -14.0, 14.0, -26.0, 26.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """The curve of an arrow, and its label with the place for its middle."""

    arrow: Arrow
    curve: Curve
    chip: Chip | None
    at: Point


def routes_of(figure: Figure) -> tuple[Route, ...]:
    """A route for every arrow, in the figure's order."""
    router = _Router(figure)
    routes = {route.arrow.key: route for pair in router.pairs() for route in router.route(pair)}
    return tuple(routes[arrow.key] for arrow in figure.arrows)


def point_at(curve: Curve, t: float) -> Point:
    """The point of a curve at a share of its way."""
    u = 1 - t
    a, b, c, d = u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t
    return (
        a * curve[0] + b * curve[2] + c * curve[4] + d * curve[6],
        a * curve[1] + b * curve[3] + c * curve[5] + d * curve[7],
    )


class _Router:
    def __init__(self, figure: Figure) -> None:
        self.nodes = {node.key: node for node in figure.nodes}
        self.arrows_at: dict[str, list[Arrow]] = defaultdict(list)
        self.boxes, self.labels = Rects(), Rects()
        for node in figure.nodes:
            self.boxes.add(node.key, _rect_of(node))
        self._pairs: dict[tuple[str, ...], list[Arrow]] = defaultdict(list)
        for arrow in figure.arrows:
            self._pairs[tuple(sorted((arrow.source, arrow.target)))].append(arrow)
            for end in {arrow.source, arrow.target}:
                self.arrows_at[end].append(arrow)

    def pairs(self) -> Iterable[list[Arrow]]:
        """The arrows between each two nodes, one direction first, each by its order in the design."""
        for arrows in self._pairs.values():
            yield sorted(arrows, key=lambda arrow: (arrow.source > arrow.target, arrow.order))

    def route(self, arrows: Sequence[Arrow]) -> Iterator[Route]:
        """Route the arrows of one pair together."""
        is_loop = arrows[0].source == arrows[0].target
        curves = self._loops(arrows) if is_loop else self._fan(arrows)
        for arrow, curve in zip(arrows, curves, strict=True):
            chip = chip_of(arrow, width=abs(curve[6] - curve[0]), height=abs(curve[7] - curve[1]))
            at = self._label_place(arrow, curve, chip)
            if chip:
                self.labels.add(arrow.key, Rect.around(at, chip.size))
            yield Route(arrow=arrow, curve=curve, chip=chip, at=at)

    def _label_place(self, arrow: Arrow, curve: Curve, chip: Chip | None) -> Point:
        if arrow.label_at is not None:
            part, shift = arrow.label_at
            return _beside(curve, min(1.0, max(0.0, part)), shift)
        if arrow.source == arrow.target:
            return _loop_label(curve, chip)
        return _place_label(curve, chip, self._crowd)

    def _fan(self, arrows: Sequence[Arrow]) -> list[Curve]:
        # Lanes are counted across the same normal for both directions.
        low, high = sorted((arrows[0].source, arrows[0].target))
        ends = self.nodes[low], self.nodes[high]
        best: tuple[int, list[Curve]] | None = None
        for bow in _BOWS:
            lanes = (bow + (lane - (len(arrows) - 1) / 2) * _LANE for lane in range(len(arrows)))
            curves = [self._bend(arrow, ends, apex) for arrow, apex in zip(arrows, lanes, strict=True)]
            blocked = sum(self._boxes_under(curve, {low, high}) for curve in curves)
            if best is None or blocked < best[0]:
                best = blocked, curves
            if not blocked:
                break
        assert best is not None
        return best[1]

    def _bend(self, arrow: Arrow, ends: tuple[Node, Node], apex: float) -> Curve:
        """A curve whose middle lies `apex` beside the straight line between two nodes."""
        (x0, y0), (x1, y1) = ends[0].at, ends[1].at
        length = math.hypot(x1 - x0, y1 - y0) or 1
        control = ((x0 + x1) / 2 - (y1 - y0) / length * apex * 2, (y0 + y1) / 2 + (x1 - x0) / length * apex * 2)
        start, end = _exit(self.nodes[arrow.source], control), _exit(self.nodes[arrow.target], control)
        return (
            *start,
            start[0] + 2 / 3 * (control[0] - start[0]),
            start[1] + 2 / 3 * (control[1] - start[1]),
            end[0] + 2 / 3 * (control[0] - end[0]),
            end[1] + 2 / 3 * (control[1] - end[1]),
            *end,
        )

    def _boxes_under(self, curve: Curve, own: set[str]) -> int:
        """How many boxes a curve runs over, looked up in steps smaller than a box."""
        steps = min(80, max(8, math.ceil(math.hypot(curve[6] - curve[0], curve[7] - curve[1]) / 36)))
        hit: set[str] = set()
        for step in range(1, steps):
            spot = Rect.around(point_at(curve, step / steps), Size(width=2 * _CLEARANCE, height=2 * _CLEARANCE))
            hit.update(self.boxes.under(spot))
        return len(hit - own)

    def _loops(self, arrows: Sequence[Arrow]) -> list[Curve]:
        """Self loops take the freest sides; further ones grow around the first."""
        node = self.nodes[arrows[0].source]
        sides = sorted(_SIDES, key=lambda side: self._burden(node, side))
        return [_loop(node, sides[index % 4], index // 4) for index in range(len(arrows))]

    def _burden(self, node: Node, side: Point) -> float:
        # The initial mark sits at the upper left, so that the top is a little worse than it looks.
        burden = 1.5 if side[1] == -1 and node.initial else 0.0
        burden += 0.2 if side[0] else 0.0
        for arrow in self.arrows_at[node.key]:
            other = self.nodes[arrow.target if arrow.source == node.key else arrow.source]
            dx, dy = other.at[0] - node.at[0], other.at[1] - node.at[1]
            length = math.hypot(dx, dy) or 1
            burden += max(0.0, (dx * side[0] + dy * side[1]) / length) ** 2
        out = (node.at[0] + side[0] * (node.size.width / 2 + 40), node.at[1] + side[1] * (node.size.height / 2 + 40))
        around = self.boxes.under(Rect.around(out, Size(width=80, height=80)))
        return burden + 3 * len(around - {node.key})

    def _crowd(self, rect: Rect) -> int:
        """How much already lies under a rectangle: boxes weigh more than labels."""
        return 3 * len(self.boxes.under(rect.grown(2))) + 2 * len(self.labels.under(rect))


def _rect_of(node: Node) -> Rect:
    return Rect.around(node.at, node.size)


def _exit(node: Node, towards: Point) -> Point:
    """Where the ray from a node's centre leaves its shape."""
    dx, dy = towards[0] - node.at[0], towards[1] - node.at[1]
    half_width, half_height = node.size.width / 2, node.size.height / 2
    if not dx and not dy:
        return (node.at[0], node.at[1] - half_height)
    reach = min(half_width / abs(dx) if dx else math.inf, half_height / abs(dy) if dy else math.inf)
    if node.of == "component":
        reach = min(reach, half_width / (abs(dx) + HEX_SLANT / half_height * abs(dy)))
    return (node.at[0] + dx * reach, node.at[1] + dy * reach)


def _loop(node: Node, side: Point, ring: int) -> Curve:
    reach, half = 62.0 + ring * 26, 16.0 + ring * 6
    spread = half + 18
    foot = (node.at[0] + side[0] * node.size.width / 2, node.at[1] + side[1] * node.size.height / 2)

    def at(across: float, out: float) -> Point:
        return (foot[0] - side[1] * across + side[0] * out, foot[1] + side[0] * across + side[1] * out)

    return (*at(-half, 0), *at(-spread, reach), *at(spread, reach), *at(half, 0))


def _loop_label(curve: Curve, chip: Chip | None) -> Point:
    """The label of a loop hangs on its outermost point, so that the loop itself stays visible."""
    apex = point_at(curve, 0.5)
    out = apex[0] - (curve[0] + curve[6]) / 2
    if chip is None or abs(out) < abs(apex[1] - (curve[1] + curve[7]) / 2):
        return apex
    return (apex[0] + math.copysign(chip.size.width / 2 - 8, out), apex[1])


def _place_label(curve: Curve, chip: Chip | None, crowd: Callable[[Rect], int]) -> Point:
    """The first free place along the curve, beside it when there is none on it, else the least crowded."""
    best = point_at(curve, 0.5)
    if chip is None:
        return best
    least = math.inf
    for shift in _SHIFTS:
        for t in _PLACES:
            at = _beside(curve, t, shift)
            cost = crowd(Rect.around(at, chip.size))
            if cost < least:
                best, least = at, cost
            if not cost:
                return at
    return best


def _beside(curve: Curve, t: float, shift: float) -> Point:
    x, y = point_at(curve, t)
    behind, ahead = point_at(curve, max(0.0, t - 0.02)), point_at(curve, min(1.0, t + 0.02))
    dx, dy = ahead[0] - behind[0], ahead[1] - behind[1]
    length = math.hypot(dx, dy) or 1
    return (x - dy / length * shift, y + dx / length * shift)
