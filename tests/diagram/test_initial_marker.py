"""The marker of the initial state lies on no arrow and no label."""

import pytest

from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.edge_routing import route_edges
from vicode.diagram.initial_marker import Corner, initial_corner, marker_rect
from vicode.diagram.spatial_index import Rect
from vicode.model.design import Design, Point, State, Transition


@pytest.mark.parametrize(
    ("others", "corner"),
    [
        ((), (-1, -1)),
        (((-200, -130),), (1, -1)),
        (((-200, -130), (200, -130)), (-1, 1)),
        (((-200, -130), (200, -130), (-200, 130)), (1, 1)),
    ],
)
def test_the_marker_is_at_a_free_corner(others: tuple[Point, ...], corner: Corner) -> None:
    back = (Transition(to="Start"),)
    states = [State(name=f"Other{index}", at=at, transitions=back) for index, at in enumerate(others)]
    design = Design(component="Robot", initial="Start", states=(State(name="Start", at=(0, 0)), *states))
    diagram = build_diagram(design)
    start = next(node for node in diagram.nodes if node.initial)
    assert initial_corner(start, diagram, route_edges(diagram)) == corner


def test_the_bounds_of_the_marker_are_outside_its_node() -> None:
    diagram = build_diagram(Design(component="Robot", initial="Start", states=(State(name="Start", at=(0, 0)),)))
    (start,) = diagram.nodes
    half = start.size.width / 2
    assert marker_rect(start, (1, 1)) == Rect(half - 27, 30, half + 18, 56)
    assert marker_rect(start, (-1, -1)) == Rect(-half - 18, -56, -half + 27, -30)
