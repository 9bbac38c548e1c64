"""A drawing small enough to stand on a card: as it is where that can be made out, else boxes and lines alone."""

from vicode.diagram.drawing import draw_figure
from vicode.diagram.figure import Figure, Node, figure_of
from vicode.diagram.palettes import DARK, LIGHT, Palette
from vicode.diagram.shapes import Drawing, Group, Path, Step, box, line
from vicode.diagram.svg import write_svg
from vicode.model.design import Design

# On a card of 280 pixels a line of this part of the whole's width is still seen.
_THINNEST = 1 / 220
_MOST_DETAILED = 8
_MOST_ARROWS = 600


def thumbnail(design: Design, *, dark: bool = False) -> str:
    """The SVG of a design's states and transitions, in the proportions of the whole."""
    figure = figure_of(design, links=False)
    palette = DARK if dark else LIGHT
    if len(figure.nodes) <= _MOST_DETAILED:
        return write_svg(draw_figure(figure, title=design.component, palette=palette))
    return write_svg(_outline(figure, design.component, palette))


def _outline(figure: Figure, title: str, palette: Palette) -> Drawing:
    """Boxes and straight lines, thick enough for their small scale."""
    lefts = [node.at[0] - node.size.width / 2 for node in figure.nodes]
    rights = [node.at[0] + node.size.width / 2 for node in figure.nodes]
    ys = [node.at[1] for node in figure.nodes]
    left, width, top, height = min(lefts) - 30, max(rights) - min(lefts) + 60, min(ys) - 60, max(ys) - min(ys) + 120
    pen = max(1.5, max(width, height) * _THINNEST)
    places = {node.key: node.at for node in figure.nodes}
    # Beyond so many nothing is made out but where boxes are.
    shown = figure.arrows if len(figure.arrows) <= _MOST_ARROWS else ()
    ways = sorted({tuple(sorted((places[arrow.source], places[arrow.target]))) for arrow in shown})
    lines = tuple(step for way in ways for step in line(way))
    shapes: list[Path] = [Path(steps=lines, stroke=palette.edge, width=pen)] if lines else []
    for node in figure.nodes:
        fill, stroke = {"common": (palette.common_fill, palette.common)}.get(node.of, (palette.box, palette.box_line))
        shape = box(node.at, node.size.width, node.size.height, 12) if shown else _plain_box(node)
        shapes.append(Path(steps=shape, fill=palette.start if node.initial else fill, stroke=stroke, width=pen))
    group = Group(title=title, kind="outline", shapes=tuple(shapes))
    return Drawing(
        title=title, doc="", left=left, top=top, width=width, height=height, paper=palette.paper, groups=(group,)
    )


def _plain_box(node: Node) -> tuple[Step, ...]:
    x, y = node.size.width / 2, node.size.height / 2
    corners = ((-x, -y), (x, -y), (x, y), (-x, y))
    return line([(node.at[0] + dx, node.at[1] + dy) for dx, dy in corners], closed=True)
