"""A diagram for a card: complete if it is readable at that size, else only boxes and lines."""

from vicode.diagram.diagram_model import Diagram, DiagramNode, build_diagram
from vicode.diagram.palettes import DARK, LIGHT, ColorPalette
from vicode.diagram.primitives import PathCommand, PathShape, ShapeGroup, VectorImage, polyline_path, rounded_rect_path
from vicode.diagram.render import render_diagram
from vicode.diagram.svg import write_svg
from vicode.model.design import Design

# At a width of 280 pixels, a line of this fraction of the width is still visible.
_MIN_LINE_WIDTH = 1 / 220
_MAX_DETAILED_NODES = 8
_MAX_EDGES = 600


def render_thumbnail(design: Design, *, dark: bool = False) -> str:
    """The SVG of the states and transitions of a design, with its aspect ratio."""
    diagram = build_diagram(design, links=False)
    palette = DARK if dark else LIGHT
    if len(diagram.nodes) <= _MAX_DETAILED_NODES:
        return write_svg(render_diagram(diagram, title=design.component, palette=palette))
    return write_svg(_outline(diagram, design.component, palette))


def _outline(diagram: Diagram, title: str, palette: ColorPalette) -> VectorImage:
    """Boxes and straight lines, thick enough for the small scale."""
    lefts = [node.center[0] - node.size.width / 2 for node in diagram.nodes]
    rights = [node.center[0] + node.size.width / 2 for node in diagram.nodes]
    ys = [node.center[1] for node in diagram.nodes]
    left, width, top, height = min(lefts) - 30, max(rights) - min(lefts) + 60, min(ys) - 60, max(ys) - min(ys) + 120
    pen = max(1.5, max(width, height) * _MIN_LINE_WIDTH)
    positions = {node.key: node.center for node in diagram.nodes}
    # With more states, only boxes are recognizable.
    shown = diagram.edges if len(diagram.edges) <= _MAX_EDGES else ()
    segments = sorted({tuple(sorted((positions[edge.source], positions[edge.target]))) for edge in shown})
    lines = tuple(step for segment in segments for step in polyline_path(segment))
    shapes: list[PathShape] = [PathShape(commands=lines, stroke=palette.edge, width=pen)] if lines else []
    for node in diagram.nodes:
        fill, stroke = {"common": (palette.common_fill, palette.common)}.get(
            node.node_type, (palette.box, palette.box_line)
        )
        shape = rounded_rect_path(node.center, node.size.width, node.size.height, 12) if shown else _plain_box(node)
        shapes.append(PathShape(commands=shape, fill=palette.start if node.initial else fill, stroke=stroke, width=pen))
    group = ShapeGroup(title=title, css_class="outline", shapes=tuple(shapes))
    return VectorImage(
        title=title, doc="", left=left, top=top, width=width, height=height, background=palette.paper, groups=(group,)
    )


def _plain_box(node: DiagramNode) -> tuple[PathCommand, ...]:
    x, y = node.size.width / 2, node.size.height / 2
    corners = ((-x, -y), (x, -y), (x, y), (-x, y))
    return polyline_path([(node.center[0] + dx, node.center[1] + dy) for dx, dy in corners], closed=True)
