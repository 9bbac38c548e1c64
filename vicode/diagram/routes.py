"""The way of every arrow and the place of its label, found as the canvas finds them."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from vicode.diagram.chips import Chip, bare_chips, chip_of, shorter_chips
from vicode.diagram.figure import Arrow, Figure, Node
from vicode.diagram.ground import Curve, Obstacles, Points, Rect, Rects
from vicode.diagram.labels import Kind
from vicode.diagram.ways import CLEARANCE, fan, length_of, loops, point_at, points_along, reading_order
from vicode.model.design import Point

# What a label would hide, dearer first. A place farther along its line costs less than hiding a line.
_BOX, _LABEL, _LINE, _LINK = 12.0, 8.0, 1.4, 0.7
# In a figure of more arrows labels do not look for lines: there are too many to be spared.
_MOST_PLANNED = 600
_BETWEEN_POINTS = 8.0
# Parts of the way, and how far beside it: 1 is just beside the line, 2 a little farther; the best first.
_PLACES = sorted(
    (
        (abs(part - 0.5) * 2.4 + abs(side) * 1.2, part, side)
        for part in (0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8, 0.14, 0.86)
        for side in (0, 1, -1, 2, -2)
    ),
    key=lambda place: place[0],
)
_LOOP_SLIPS = ((0.0, 0), (0.4, 0), (0.8, 1), (1.2, -1))
# Where nothing of all that is free: ever farther from the line, so that every label can be read.
_FAR_PLACES = [
    (side, part) for side in (3, -3, 4, -4, 5, -5, 6, -6) for part in (0.5, 0.42, 0.58, 0.34, 0.66, 0.2, 0.8)
]
_FAR_SLIPS = (0, 1, -1, 2, -2, 3, -3)
_RISES = sorted(range(-40, 44, 4), key=abs)
_FARTHER = 14.0


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
    ways = [way for pair in router.pairs() for way in router.ways(pair)]
    # Those with the least choice first.
    ways.sort(key=lambda way: length_of(way[1]))
    routes = {arrow.key: router.label(arrow, curve, chip) for arrow, curve, chip in ways}
    for key in router.crowded:
        router.make_room(key, routes)
    return tuple(routes[arrow.key] for arrow in figure.arrows)


class _Router:
    """Knows what is drawn already."""

    def __init__(self, figure: Figure) -> None:
        self.nodes = {node.key: node for node in figure.nodes}
        self.boxes, self.labels, self.lines = Rects(), Rects(), Points()
        self.obstacles = Obstacles(CLEARANCE)
        self.crowded: list[str] = []
        has_labels = any(arrow.label or arrow.order or arrow.kind is not Kind.ALWAYS for arrow in figure.arrows)
        self.is_planned = has_labels and len(figure.arrows) <= _MOST_PLANNED
        self._arrows_at: dict[str, list[Arrow]] = defaultdict(list)
        self._pairs: dict[tuple[str, ...], list[Arrow]] = defaultdict(list)
        self._links = {arrow.key for arrow in figure.arrows if arrow.of != "transition"}
        for node in figure.nodes:
            rect = Rect.around(node.at, node.size)
            self.boxes.add(node.key, rect)
            self.obstacles.add(node.key, rect)
        for arrow in figure.arrows:
            self._pairs[tuple(sorted((arrow.source, arrow.target)))].append(arrow)
            for end in {arrow.source, arrow.target}:
                self._arrows_at[end].append(arrow)

    def pairs(self) -> Iterator[list[Arrow]]:
        """The arrows between each two nodes as they are read: onwards first, each way by its order in the design."""
        for arrows in self._pairs.values():
            first, _second = reading_order(*self._ends(arrows[0]))
            yield sorted(arrows, key=lambda arrow: (arrow.source != first.key, arrow.order))

    def ways(self, arrows: Sequence[Arrow]) -> Iterator[tuple[Arrow, Curve, Chip | None]]:
        """The curves of one pair, with the labels as they are wanted."""
        source, target = self._ends(arrows[0])
        chips = [chip_of(arrow, (source, target), beside=len(arrows)) for arrow in arrows]
        if source is target:
            others = [node for arrow in self._arrows_at[source.key] for node in self._ends(arrow) if node is not source]
            curves = loops(source, chips, others, self.boxes)
        else:
            curves = fan(arrows, chips, (source, target), self.obstacles)
        for arrow, curve, chip in zip(arrows, curves, chips, strict=True):
            if self.is_planned:
                count = max(2, math.ceil(length_of(curve) / _BETWEEN_POINTS))
                self.lines.add(arrow.key, points_along(curve, count))
            yield arrow, curve, chip

    def label(self, arrow: Arrow, curve: Curve, wanted: Chip | None) -> Route:
        """The route with the best place for the label; where any would hide something, a shorter one may not."""
        if wanted is None:
            return Route(arrow=arrow, curve=curve, chip=None, at=point_at(curve, 0.5))
        if arrow.label_at is not None:
            part, shift = arrow.label_at
            chip, at = wanted, _beside(curve, min(1.0, max(0.0, part)), shift)
        else:
            chip, at = self._free_place(arrow, curve, wanted)
            if not self._is_free(Rect.around(at, chip.size)):
                self.crowded.append(arrow.key)
        self.labels.add(arrow.key, Rect.around(at, chip.size))
        return Route(arrow=arrow, curve=curve, chip=chip, at=at)

    def make_room(self, key: str, routes: dict[str, Route]) -> None:
        """Let the labels that a crowded one stands on go elsewhere, where they can."""
        for other in sorted(self._under(routes[key]) - {key}):
            route = routes[other]
            if route.arrow.label_at is not None or route.chip is None:
                continue
            self.labels.remove(other, Rect.around(route.at, route.chip.size))
            chip, at = self._free_place(route.arrow, route.curve, route.chip)
            routes[other] = replace(route, chip=chip, at=at)
            self.labels.add(other, Rect.around(at, chip.size))

    def _under(self, route: Route) -> set[str]:
        assert route.chip is not None
        return self.labels.under(Rect.around(route.at, route.chip.size).grown(2))

    def _ends(self, arrow: Arrow) -> tuple[Node, Node]:
        return self.nodes[arrow.source], self.nodes[arrow.target]

    def _free_place(self, arrow: Arrow, curve: Curve, wanted: Chip) -> tuple[Chip, Point]:
        best, chosen, least = point_at(curve, 0.5), wanted, math.inf
        for chip in (wanted, *shorter_chips(arrow, wanted)):
            for price, at in _places(arrow, curve, chip):
                if price >= least:
                    break
                cost = price + self._crowd(Rect.around(at, chip.size), arrow.key, least - price)
                if cost < least:
                    best, chosen, least = at, chip, cost
            if least < _LABEL:
                return chosen, best
        return self._far_place(arrow, curve, chip) or (chosen, best)

    def _far_place(self, arrow: Arrow, curve: Curve, shortest: Chip) -> tuple[Chip, Point] | None:
        """A place that hides no text, farther away; if need be for the order alone, whose link tells the rest."""
        for chip in (shortest, *bare_chips(arrow)):
            near = [at for _price, at in _places(arrow, curve, chip)] if chip is not shortest else []
            for at in (*near, *_far_places(arrow, curve, chip)):
                if self._is_free(Rect.around(at, chip.size)):
                    return chip, at
        return None

    def _is_free(self, rect: Rect) -> bool:
        """Whether a label there would hide no box and no other label."""
        wide = rect.grown(2)
        return not self.boxes.under(wide) and not self.labels.under(wide)

    def _crowd(self, rect: Rect, own: str, enough: float) -> float:
        """What lies under a rectangle, or would be under a label there; from `enough` on nobody looks further."""
        wide = rect.grown(2)
        crowd = _BOX * len(self.boxes.under(wide)) + _LABEL * len(self.labels.under(wide))
        if crowd >= enough:
            return crowd
        hidden = self.lines.within(rect) - {own}
        links = len(hidden & self._links)
        return crowd + _LINK * links + _LINE * (len(hidden) - links)


def _places(arrow: Arrow, curve: Curve, chip: Chip) -> Iterator[tuple[float, Point]]:
    """Places for a label with what each costs, the best first."""
    if arrow.source == arrow.target:
        yield from ((price, _on_loop(curve, chip, slip, is_out=price > 0)) for price, slip in _LOOP_SLIPS)
        return
    for price, part, side in _PLACES:
        yield price, _by_line(curve, chip, part, side) if side else point_at(curve, part)


def _far_places(arrow: Arrow, curve: Curve, chip: Chip) -> Iterator[Point]:
    if arrow.source == arrow.target:
        hung = [_on_loop(curve, chip, slip, is_out=True) for slip in _FAR_SLIPS]
        return ((x, y + rise) for rise in _RISES for x, y in hung)
    return (_by_line(curve, chip, part, side) for side, part in _FAR_PLACES)


def _on_loop(curve: Curve, chip: Chip, slip: int, *, is_out: bool) -> Point:
    """The label of a loop hangs on its outermost point, so that the loop itself stays visible."""
    apex = point_at(curve, 0.5)
    out = (apex[0] - (curve[0] + curve[6]) / 2, apex[1] - (curve[1] + curve[7]) / 2)
    if abs(out[0]) < abs(out[1]):
        return (apex[0] + slip * chip.size.width * 0.4, apex[1] + (math.copysign(9, out[1]) if is_out else 0))
    return (apex[0] + math.copysign(chip.size.width / 2 - 8, out[0]), apex[1] + slip * 18)


def _by_line(curve: Curve, chip: Chip, part: float, side: int) -> Point:
    """So far beside the line that it stays visible."""
    dx, dy = _direction(curve, part)
    reach = (abs(dy) * chip.size.width + abs(dx) * chip.size.height) / 2
    beyond = 3 if abs(side) == 1 else 9 + _FARTHER * (abs(side) - 2)
    shift = math.copysign(reach + beyond, side)
    x, y = point_at(curve, part)
    return (x - dy * shift, y + dx * shift)


def _beside(curve: Curve, part: float, shift: float) -> Point:
    """To the right of who walks along the curve."""
    x, y = point_at(curve, part)
    dx, dy = _direction(curve, part)
    return (x - dy * shift, y + dx * shift)


def _direction(curve: Curve, part: float) -> Point:
    behind, ahead = point_at(curve, max(0.0, part - 0.02)), point_at(curve, min(1.0, part + 0.02))
    dx, dy = ahead[0] - behind[0], ahead[1] - behind[1]
    length = math.hypot(dx, dy) or 1
    return (dx / length, dy / length)
