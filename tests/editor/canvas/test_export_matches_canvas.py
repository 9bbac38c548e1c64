"""Exported diagrams match the canvas: Python routes edges and places labels as JavaScript does."""

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
# A browser measures texts with its fonts, Python with a table: widths of nodes and labels differ by up to a grid step.
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


def test_exported_edges_and_labels_of_shipped_designs_match_the_canvas(show: Show) -> None:
    labels: list[float] = []
    for design in shipped_designs():
        canvas = show(make_scene(Project(name="P", designs=(design,)), design, (), 1))
        drawn = {name: (numbers(path), numbers(at)) for name, path, at in canvas.page.evaluate(DRAWN)}
        for route in route_edges(build_diagram(design)):
            curve, at = drawn[name_of(route.edge.key)]
            assert math.dist(middle(curve), middle(route.curve)) < STEP / 2, route.edge.key
            assert (
                max(abs(canvas_value - value) for canvas_value, value in zip(curve, route.curve, strict=True)) <= STEP
            ), route.edge.key
            assert bool(at) == (route.label is not None), route.edge.key
            labels += [math.dist(at, route.label_position)] if at else []
    # A label that is about as wide as a gap may fit in only one of them.
    assert sum(distance < STEP for distance in labels) >= 0.9 * len(labels)


def numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


def middle(curve: Any) -> Point:
    return point_on_curve(tuple(curve), 0.5)


def name_of(key: str) -> str:
    """Kind and id that the canvas gives to an edge of Python's diagram."""
    kind, colon, rest = key.partition(":")
    if not colon:
        return f"link:{key}"
    path = rest.split("/")
    assert kind == "t"
    return "transition:" + "/".join(path[1:2] + path[3:] if path[0] == "states" else ["@common", *path[2:]])
