"""Draws a figure as the canvas does: the same shapes, signs and colours, made of paths and texts."""

import math
from collections.abc import Collection, Iterable

from vicode.diagram.chips import PADDING, Chip
from vicode.diagram.figure import Arrow, Figure, Node, figure_of
from vicode.diagram.ground import Curve
from vicode.diagram.labels import Kind
from vicode.diagram.lettering import LABEL, NAME, SMALL, Letters, text_width
from vicode.diagram.palettes import LIGHT, Palette
from vicode.diagram.routes import Route, routes_of
from vicode.diagram.shapes import Drawing, Group, Path, Text, box, curve, disc, line, lines
from vicode.diagram.ways import HEX_SLANT, point_at
from vicode.model.design import Design, Point

_MARGIN = 24.0
_HEAD = 10.0
# So many points of a curve tell how far it bows, within a pixel or two.
_SAMPLES = 8
_MARK_ROW, _NAME_RISE, _MARK_GAP = 16.0, -8.0, 9.0
_HEXAGON = (((2.5, -4.0), (7.5, -4.0), (10.0, 0.0), (7.5, 4.0), (2.5, 4.0), (0.0, 0.0), (2.5, -4.0)),)
_MARKS: dict[str, tuple[float, tuple[tuple[Point, ...], ...]]] = {
    "enter": (11, (((0, 0), (7, 0)), ((4.5, -2.8), (7.3, 0), (4.5, 2.8)), ((10.3, -4), (10.3, 4)))),
    "actions": (10, (((0, -3.5), (10, -3.5)), ((0, 0), (10, 0)), ((0, 3.5), (6, 3.5)))),
    "leave": (11, (((0.7, -4), (0.7, 4)), ((3.5, 0), (10.5, 0)), ((8, -2.8), (10.8, 0), (8, 2.8)))),
    "requires": (10, _HEXAGON),
    "modulates": (10, _HEXAGON),
}
_ICONS: dict[Kind, tuple[tuple[Point, ...], ...]] = {
    Kind.TIMER: (((5, -2.6), (5, 0.3), (7, 1.6)),),
    Kind.CODE: (((3, -3.5), (-0.2, 0), (3, 3.5)), ((7, -3.5), (10.2, 0), (7, 3.5))),
    Kind.TREE: (((1.5, -4.5), (1.5, 1), (3.2, 3), (8.5, 3)), ((1.5, -1), (3.2, -3), (8.5, -3))),
}


def draw(
    design: Design, *, only: Collection[str] | None = None, links: bool = True, palette: Palette = LIGHT
) -> Drawing:
    """The drawing of a design, or of some states and what they use.

    Args:
        design: What to draw; what has no place gets one.
        only: The names of the states to draw, None for all.
        links: Whether used components are shown, with who requires and modulates them.
        palette: The colours.
    """
    figure = figure_of(design, only=only, links=links)
    return draw_figure(figure, title=design.component, doc=design.doc, palette=palette)


def draw_figure(figure: Figure, *, title: str, doc: str = "", palette: Palette = LIGHT) -> Drawing:
    """The drawing of a figure: links below transitions, labels above all."""
    routes = routes_of(figure)
    artist = _Artist(palette)
    groups = (
        *(artist.arrow(route) for route in routes if route.arrow.of != "transition"),
        *(artist.arrow(route) for route in routes if route.arrow.of == "transition"),
        *(artist.node(node) for node in figure.nodes),
        *(artist.chip(route.chip, route) for route in routes if route.chip),
    )
    left, top, right, bottom = _extent(figure, routes)
    return Drawing(
        title=title,
        doc=doc,
        left=left - _MARGIN,
        top=top - _MARGIN,
        width=right - left + 2 * _MARGIN,
        height=bottom - top + 2 * _MARGIN,
        paper=palette.paper,
        groups=groups,
    )


class _Artist:
    """Knows the colours."""

    def __init__(self, palette: Palette) -> None:
        self.palette = palette

    def node(self, node: Node) -> Group:
        """A state, a used component or the badge of common transitions."""
        drawers = {"state": self._state, "component": self._component, "common": self._common}
        shapes = tuple(drawers[node.of](node))
        return Group(title=node.title, kind=node.of, shapes=shapes, href=node.href, key=node.key)

    def arrow(self, route: Route) -> Group:
        """A curve with its head."""
        pal, arrow, ends = self.palette, route.arrow, (route.arrow.source, route.arrow.target)
        tip, base = _head(route.curve)
        shaft = curve((*route.curve[:6], *base))
        if arrow.of == "requires":
            drawn = Path(steps=shaft, stroke=pal.requires, width=1.3, dash=(9, 4))
            head = Path(steps=tip, fill=pal.paper, stroke=pal.requires, width=1.3)
        elif arrow.of == "modulates":
            drawn = Path(steps=shaft, stroke=pal.modulates, width=2, dash=(1.5, 4))
            head = Path(steps=tip, fill=pal.modulates)
        else:
            is_common = arrow.source == "common"
            colour = pal.common if is_common else pal.edge
            drawn = Path(steps=shaft, stroke=colour, width=1.6, dash=_dash(arrow))
            head = Path(steps=tip, fill=colour)
        is_echo = route.chip is not None
        return Group(
            title=arrow.title, kind=arrow.of, shapes=(drawn, head), href=arrow.href, ends=ends, is_echo=is_echo
        )

    def chip(self, chip: Chip | None, route: Route) -> Group:
        """The label of an arrow."""
        assert chip is not None
        pal, (x, y) = self.palette, route.at
        plate = Path(steps=box(route.at, chip.size.width, chip.size.height, 11), fill=pal.plate, stroke=pal.plate_line)
        shapes: list[Path | Text] = [plate]
        x += PADDING - chip.size.width / 2
        if chip.order:
            shapes.append(Text(x=x, y=y, text=chip.order, fill=pal.muted))
        x += chip.order_width
        if chip.icon:
            shapes += [Path(steps=steps, stroke=pal.muted, width=1.3) for steps in _icon(chip.icon, (x, y))]
        x += chip.icon_width
        if chip.text:
            is_off = route.arrow.disabled
            colour = pal.muted if is_off else pal.text
            shapes.append(Text(x=x, y=y, text=chip.text, fill=colour, letters=LABEL, is_struck=is_off))
        arrow = route.arrow
        ends = (arrow.source, arrow.target)
        return Group(title=arrow.title, kind="label", shapes=tuple(shapes), href=arrow.href, ends=ends)

    def _state(self, node: Node) -> Iterable[Path | Text]:
        pal, (x, y), size = self.palette, node.at, node.size
        fill, dash = (pal.faint, (4, 4)) if node.disabled else (pal.box, ())
        yield Path(steps=box(node.at, size.width, size.height, 12), fill=fill, stroke=pal.box_line, dash=dash)
        if node.final:
            yield Path(steps=box(node.at, size.width - 8, size.height - 8, 8), stroke=pal.box_line)
        if node.initial:
            yield from self._initial(node)
        yield _name(node, pal.muted if node.disabled else pal.text, rise=_NAME_RISE if node.marks or node.second else 0)
        if node.second:
            yield _second(node, pal.muted)
        if node.marks:
            yield from self._marks(node.marks, (x, y + _MARK_ROW))

    def _initial(self, node: Node) -> Iterable[Path]:
        pal = self.palette
        left, top = node.at[0] - node.size.width / 2, node.at[1] - node.size.height / 2
        dot, tip = (left - 12, top - 20), (left + 22, top - 1)
        end = (tip[0], tip[1] - 6)
        corner = (tip[0], dot[1])
        bow = [value for ends in (dot, end) for value in _two_thirds(ends, corner)]
        yield Path(steps=curve((*dot, *bow, *end)), stroke=pal.start, width=1.6)
        yield Path(
            steps=line((tip, (tip[0] - 4.5, tip[1] - 8), (tip[0] + 4.5, tip[1] - 8)), closed=True), fill=pal.start
        )
        yield Path(steps=disc(dot, 6), fill=pal.start)

    def _marks(self, marks: tuple[tuple[str, int], ...], at: Point) -> Iterable[Path | Text]:
        pal = self.palette
        colours = {"requires": pal.requires, "modulates": pal.modulates}
        widths = [_MARKS[name][0] + (3 + 7 * len(str(count)) if count else 0) for name, count in marks]
        x = at[0] - (sum(widths) + _MARK_GAP * (len(marks) - 1)) / 2
        for (name, count), width in zip(marks, widths, strict=True):
            colour = colours.get(name, pal.muted)
            fill = colour if name == "modulates" else ""
            yield Path(steps=lines(*_MARKS[name][1], at=(x, at[1])), fill=fill, stroke=colour, width=1.4)
            if count:
                yield Text(x=x + _MARKS[name][0] + 3, y=at[1], text=str(count), fill=colour, letters=SMALL)
            x += width + _MARK_GAP

    def _component(self, node: Node) -> Iterable[Path | Text]:
        pal, (x, y) = self.palette, node.at
        w, h, slant = node.size.width / 2, node.size.height / 2, HEX_SLANT
        corners = ((-w, 0.0), (-w + slant, -h), (w - slant, -h), (w, 0.0), (w - slant, h), (-w + slant, h))
        steps = line([(x + dx, y + dy) for dx, dy in corners], closed=True)
        yield Path(steps=steps, fill=pal.component, stroke=pal.component_line, dash=(6, 3))
        yield _name(node, pal.component_text, rise=_NAME_RISE if node.second else 0)
        if node.second:
            yield _second(node, pal.muted)

    def _common(self, node: Node) -> Iterable[Path | Text]:
        pal, (x, y), size = self.palette, node.at, node.size
        outline = box(node.at, size.width, size.height, size.height / 2)
        yield Path(steps=outline, fill=pal.common_fill, stroke=pal.common, dash=(5, 4))
        star = (((-52, -6), (-52, 6)), ((-57.2, -3), (-46.8, 3)), ((-57.2, 3), (-46.8, -3)))
        yield Path(steps=lines(*star, at=node.at), stroke=pal.common, width=1.4)
        yield Text(x=x + 4, y=y, text=node.label, fill=pal.text, letters=Letters(size=13, bold=True), is_centred=True)


def _name(node: Node, colour: str, *, rise: float) -> Text:
    return Text(
        x=node.at[0],
        y=node.at[1] + rise,
        text=node.label,
        fill=colour,
        letters=NAME,
        is_centred=True,
        is_struck=node.disabled,
    )


def _second(node: Node, colour: str) -> Text:
    return Text(x=node.at[0], y=node.at[1] + 12, text=node.second, fill=colour, letters=SMALL, is_centred=True)


def _dash(arrow: Arrow) -> tuple[float, ...]:
    if arrow.disabled:
        return (2, 5)
    return (6, 4) if arrow.source == "common" else ()


def _icon(kind: Kind, at: Point) -> Iterable[tuple[tuple[str, tuple[float, ...]], ...]]:
    yield lines(*_ICONS[kind], at=at)
    if kind is Kind.TIMER:
        yield disc((at[0] + 5, at[1]), 5)


def _two_thirds(end: Point, control: Point) -> Point:
    """The control of a cubic curve for that of a quadratic one."""
    return (end[0] + 2 / 3 * (control[0] - end[0]), end[1] + 2 / 3 * (control[1] - end[1]))


def _head(of: Curve) -> tuple[tuple[tuple[str, tuple[float, ...]], ...], Point]:
    """The arrow head, and the point where the line meets it."""
    dx, dy = of[6] - of[4], of[7] - of[5]
    length = math.hypot(dx, dy) or 1
    ux, uy = dx / length, dy / length
    base = (of[6] - ux * _HEAD, of[7] - uy * _HEAD)
    side = (-uy * _HEAD * 0.42, ux * _HEAD * 0.42)
    notch = (base[0] + ux * 2, base[1] + uy * 2)
    corners = ((of[6], of[7]), (base[0] + side[0], base[1] + side[1]), notch, (base[0] - side[0], base[1] - side[1]))
    return line(corners, closed=True), notch


def _extent(figure: Figure, routes: Iterable[Route]) -> tuple[float, float, float, float]:
    """The edges of the whole, labels and bows included."""
    xs: list[float] = []
    ys: list[float] = []
    for node in figure.nodes:
        room = 20 if node.initial else 0
        xs += [node.at[0] - node.size.width / 2 - room, node.at[0] + node.size.width / 2]
        ys += [node.at[1] - node.size.height / 2 - room - 6 * bool(room), node.at[1] + node.size.height / 2]
    for route in routes:
        for step in range(_SAMPLES + 1):
            x, y = point_at(route.curve, step / _SAMPLES)
            xs.append(x)
            ys.append(y)
        if route.chip:
            half = route.chip.size.width / 2
            xs += [route.at[0] - half, route.at[0] + half]
            ys += [route.at[1] - 11, route.at[1] + 11]
    if not xs:
        return (0, 0, text_width("No states yet", LABEL), 20)
    return (min(xs), min(ys), max(xs), max(ys))
