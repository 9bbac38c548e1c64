"""The corner of the initial state where its marker covers the fewest lines and labels, as on the canvas."""

from collections.abc import Iterable

from vicode.diagram.diagram_model import Diagram, DiagramNode
from vicode.diagram.edge_curves import curve_length, sample_curve
from vicode.diagram.edge_routing import EdgeRoute
from vicode.diagram.spatial_index import CubicBezier, Rect

Corner = tuple[int, int]
"""Signs of the horizontal and vertical direction from the center of the node."""

_CORNERS: tuple[Corner, ...] = ((-1, -1), (1, -1), (-1, 1), (1, 1))
_OUT, _RISE, _INSET, _RADIUS = 12, 20, 22, 6
_SAMPLE_DISTANCE = 8


def initial_corner(node: DiagramNode, diagram: Diagram, routes: Iterable[EdgeRoute]) -> Corner:
    """The first corner, upper left first, with the lowest number of covered elements."""
    rects = [Rect.from_center(other.center, other.size) for other in diagram.nodes if other is not node]
    rects += [Rect.from_center(route.label_position, route.label.size) for route in routes if route.label]
    curves = [route.curve for route in routes]

    def covered(corner: Corner) -> int:
        area = marker_rect(node, corner)
        return sum(area.overlaps(rect) for rect in rects) + sum(_crosses(curve, area) for curve in curves)

    return min(_CORNERS, key=covered)


def marker_rect(node: DiagramNode, corner: Corner) -> Rect:
    """The bounds of the marker at a corner."""
    across, down = corner
    half_width, half_height = node.size.width / 2, node.size.height / 2
    xs = sorted(node.center[0] + across * (half_width + shift) for shift in (_OUT + _RADIUS, -_INSET - 5))
    ys = sorted(node.center[1] + down * (half_height + shift) for shift in (_RISE + _RADIUS, 0))
    return Rect(xs[0], ys[0], xs[1], ys[1])


def _crosses(curve: CubicBezier, rect: Rect) -> bool:
    # A curve stays within the bounds of its control points.
    xs, ys = curve[::2], curve[1::2]
    if max(xs) < rect.left or min(xs) > rect.right or max(ys) < rect.top or min(ys) > rect.bottom:
        return False
    points = sample_curve(curve, max(2, round(curve_length(curve) / _SAMPLE_DISTANCE)))
    return any(rect.left < x < rect.right and rect.top < y < rect.bottom for x, y in points)
