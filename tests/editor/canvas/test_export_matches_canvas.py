"""What is exported is what was seen: Python leads arrows and places labels as the canvas does."""

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

from tests.diagram.diagram_designs import shipped_designs
from tests.editor.canvas.conftest import CanvasDriver, Point
from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.edge_curves import point_on_curve
from vicode.diagram.edge_routing import route_edges
from vicode.editor.view import make_scene
from vicode.model.project import Project

Show = Callable[[Mapping[str, Any]], CanvasDriver]
# A browser measures texts by its fonts, Python by a table: the widths of boxes and labels differ by a step of the grid.
STEP = 20.0
DRAWN = """() => {
  const root = document.querySelector('.vicode-canvas').shadowRoot;
  const labels = Object.fromEntries([...root.querySelectorAll('g.chip')].map(each => [each.dataset.key, each]));
  return [...root.querySelectorAll('g.edge:not(.chip)')].map(line => [
    line.dataset.kind + ':' + line.dataset.id,
    line.querySelector('.hit').getAttribute('d'),
    labels[line.dataset.key]?.dataset.at ?? '',
  ]);
}"""


def test_arrows_and_labels_of_shipped_designs_are_where_the_canvas_has_them(show: Show) -> None:
    labels: list[float] = []
    for design in shipped_designs():
        hand = show(make_scene(Project(name="P", designs=(design,)), design, (), 1))
        drawn = {name: (numbers(path), numbers(at)) for name, path, at in hand.page.evaluate(DRAWN)}
        for route in route_edges(build_diagram(design)):
            curve, at = drawn[name_of(route.edge.key)]
            assert math.dist(middle(curve), middle(route.curve)) < STEP / 2, route.edge.key
            assert max(abs(there - here) for there, here in zip(curve, route.curve, strict=True)) <= STEP, (
                route.edge.key
            )
            assert bool(at) == (route.label is not None), route.edge.key
            labels += [math.dist(at, route.label_position)] if at else []
    # A label as wide as a gap is may find its place in one of them alone.
    assert sum(distance < STEP for distance in labels) >= 0.9 * len(labels)


def numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


def middle(curve: Any) -> Point:
    return point_on_curve(tuple(curve), 0.5)


def name_of(key: str) -> str:
    """How the canvas calls an arrow of Python's."""
    kind, colon, way = key.partition(":")
    if not colon:
        return f"link:{key}"
    path = way.split("/")
    assert kind == "t"
    return "transition:" + "/".join(path[1:2] + path[3:] if path[0] == "states" else ["@common", *path[2:]])
