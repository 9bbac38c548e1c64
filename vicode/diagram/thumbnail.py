"""A diagram for a card: complete if it is readable at that size, else only boxes and lines."""

from vicode.diagram.diagram_model import Diagram, DiagramNode, FrameBox, build_diagram
from vicode.diagram.palettes import DARK, LIGHT, ColorPalette
from vicode.diagram.primitives import PathCommand, PathShape, ShapeGroup, VectorImage, polyline_path, rounded_rect_path
from vicode.diagram.render import render_diagram
from vicode.diagram.spatial_index import Rect
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
    rects = [Rect.from_center(node.center, node.size) for node in diagram.nodes]
    rects += [frame.rect for frame in diagram.frames]
    left, top = min(rect.left for rect in rects) - 30, min(rect.top for rect in rects) - 30
    width, height = max(rect.right for rect in rects) + 30 - left, max(rect.bottom for rect in rects) + 30 - top
    pen = max(1.5, max(width, height) * _MIN_LINE_WIDTH)
    positions = {node.key: node.center for node in diagram.nodes}
    # With more states, only boxes are recognizable.
    shown = diagram.edges if len(diagram.edges) <= _MAX_EDGES else ()
    segments = sorted({tuple(sorted((positions[edge.source], positions[edge.target]))) for edge in shown})
    lines = tuple(step for segment in segments for step in polyline_path(segment))
    shapes = [_outlined_frame(frame, palette, pen) for frame in diagram.frames]
    shapes += [PathShape(commands=lines, stroke=palette.edge, width=pen)] if lines else []
    for node in diagram.nodes:
        own = getattr(palette, f"color_{node.color}") if node.color else palette.box
        fill, stroke = {
            "common": (palette.common_fill, palette.common),
            "note": (palette.color_yellow, palette.plate_line),
        }.get(node.node_type, (own, palette.box_line))
        shape = rounded_rect_path(node.center, node.size.width, node.size.height, 12) if shown else _plain_box(node)
        shapes.append(PathShape(commands=shape, fill=palette.start if node.initial else fill, stroke=stroke, width=pen))
    group = ShapeGroup(title=title, css_class="outline", shapes=tuple(shapes))
    return VectorImage(
        title=title, doc="", left=left, top=top, width=width, height=height, background=palette.paper, groups=(group,)
    )


def _outlined_frame(frame: FrameBox, palette: ColorPalette, pen: float) -> PathShape:
    rect = frame.rect
    corners = ((rect.left, rect.top), (rect.right, rect.top), (rect.right, rect.bottom), (rect.left, rect.bottom))
    fill = palette.frame_fill(frame.color)
    return PathShape(commands=polyline_path(corners, closed=True), fill=fill, stroke=palette.plate_line, width=pen)


def _plain_box(node: DiagramNode) -> tuple[PathCommand, ...]:
    x, y = node.size.width / 2, node.size.height / 2
    corners = ((-x, -y), (x, -y), (x, y), (-x, y))
    return polyline_path([(node.center[0] + dx, node.center[1] + dy) for dx, dy in corners], closed=True)
