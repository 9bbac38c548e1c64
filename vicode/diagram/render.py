"""Renders a diagram with the shapes, icons and colors of the canvas."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from types import MappingProxyType

from vicode.diagram.diagram_model import FRAME_TITLE_INSET, Diagram, DiagramEdge, DiagramNode, FrameBox, build_diagram
from vicode.diagram.edge_curves import HEX_SLANT, point_on_curve, quadratic_to_cubic
from vicode.diagram.edge_labels import PADDING, EdgeLabel
from vicode.diagram.edge_routing import EdgeRoute, route_edges
from vicode.diagram.frames import TITLE_HEIGHT
from vicode.diagram.initial_marker import Corner, initial_corner, marker_rect
from vicode.diagram.marks import Mark
from vicode.diagram.node_geometry import NOTE_LINE_HEIGHT, NOTE_PADDING, Size, note_lines
from vicode.diagram.palettes import LIGHT, ColorPalette
from vicode.diagram.primitives import (
    PathShape,
    ShapeGroup,
    TextShape,
    VectorImage,
    circle_path,
    curve_path,
    polyline_path,
    polylines_path,
    rounded_rect_path,
)
from vicode.diagram.spatial_index import CubicBezier, Rect
from vicode.diagram.text_metrics import LABEL_FONT, NAME_FONT, SMALL_FONT, Font, text_width
from vicode.diagram.transition_labels import GuardKind
from vicode.model.design import Design, Point

NO_MARKS: Mapping[str, Mark] = MappingProxyType({})
_MARGIN = 24.0
_ARROWHEAD_LENGTH = 10.0
# Sample points of a curve, enough to find its bounds within two pixels.
_SAMPLES = 8
_FOLD = 10.0
_BADGE_ROW, _NAME_OFFSET, _BADGE_GAP = 16.0, -8.0, 9.0
_HEXAGON = (((2.5, -4.0), (7.5, -4.0), (10.0, 0.0), (7.5, 4.0), (2.5, 4.0), (0.0, 0.0), (2.5, -4.0)),)
_BADGES: dict[str, tuple[float, tuple[tuple[Point, ...], ...]]] = {
    "enter": (11, (((0, 0), (7, 0)), ((4.5, -2.8), (7.3, 0), (4.5, 2.8)), ((10.3, -4), (10.3, 4)))),
    "actions": (10, (((0, -3.5), (10, -3.5)), ((0, 0), (10, 0)), ((0, 3.5), (6, 3.5)))),
    "leave": (11, (((0.7, -4), (0.7, 4)), ((3.5, 0), (10.5, 0)), ((8, -2.8), (10.8, 0), (8, 2.8)))),
    "requires": (10, _HEXAGON),
    "modulates": (10, _HEXAGON),
}
_ICONS: dict[GuardKind, tuple[tuple[Point, ...], ...]] = {
    GuardKind.TIMER: (((5, -2.6), (5, 0.3), (7, 1.6)),),
    GuardKind.CODE: (((3, -3.5), (-0.2, 0), (3, 3.5)), ((7, -3.5), (10.2, 0), (7, 3.5))),
    GuardKind.TREE: (((1.5, -4.5), (1.5, 1), (3.2, 3), (8.5, 3)), ((1.5, -1), (3.2, -3), (8.5, -3))),
}


def render_design(
    design: Design, *, only: Collection[str] | None = None, links: bool = True, palette: ColorPalette = LIGHT
) -> VectorImage:
    """Render a design, or some of its states with the components they use.

    Args:
        design: the design; elements without a position get one.
        only: names of states, None for all.
        links: whether to show used components with their requires and modulates links.
        palette: the colors.
    """
    diagram = build_diagram(design, only=only, links=links)
    return render_diagram(diagram, title=design.component, doc=design.doc, palette=palette)


def render_diagram(
    diagram: Diagram,
    *,
    title: str,
    doc: str = "",
    palette: ColorPalette = LIGHT,
    marks: Mapping[str, Mark] = NO_MARKS,
) -> VectorImage:
    """Render a diagram: frames at the back, links below transitions, labels on top; `marks` by key of the element."""
    routes = route_edges(diagram)
    corners = {node.key: initial_corner(node, diagram, routes) for node in diagram.nodes if node.initial}
    artist = _DiagramRenderer(palette, marks)
    outlines = tuple(artist.outlines(diagram.nodes))
    groups = (
        *(artist.frame(frame) for frame in diagram.frames),
        *(outline for _rect, outline in outlines),
        *(artist.edge(route) for route in routes if route.edge.edge_type != "transition"),
        *(artist.edge(route) for route in routes if route.edge.edge_type == "transition"),
        *(artist.node(node, corners.get(node.key)) for node in diagram.nodes),
        *(artist.label(route.label, route) for route in routes if route.label),
        *artist.signs(diagram.nodes, routes),
    )
    left, top, right, bottom = _bounds(diagram, routes, corners, [rect for rect, _outline in outlines])
    return VectorImage(
        title=title,
        doc=doc,
        left=left - _MARGIN,
        top=top - _MARGIN,
        width=right - left + 2 * _MARGIN,
        height=bottom - top + 2 * _MARGIN,
        background=palette.paper,
        groups=groups,
    )


class _DiagramRenderer:
    def __init__(self, palette: ColorPalette, marks: Mapping[str, Mark] = NO_MARKS) -> None:
        self.palette, self.plain, self.marks = palette, palette, marks

    def outlines(self, nodes: Iterable[DiagramNode]) -> Iterable[tuple[Rect, ShapeGroup]]:
        """The former places of moved nodes."""
        for node in nodes:
            mark = self.marks.get(node.key)
            outline = mark.outline_group(Rect.from_center(node.center, node.size)) if mark else None
            if mark is not None and mark.moved_from is not None and outline is not None:
                yield Rect.from_center(mark.moved_from, node.size), outline

    def signs(self, nodes: Iterable[DiagramNode], routes: Iterable[EdgeRoute]) -> Iterable[ShapeGroup]:
        """The signs of marked elements: at the corner of a node, at the label or the middle of an edge."""
        places = [
            (node.key, (node.center[0] - node.size.width / 2, node.center[1] - node.size.height / 2)) for node in nodes
        ]
        for route in routes:
            x, y = route.label_position if route.label else point_on_curve(route.curve, 0.5)
            half = route.label.size.width / 2 if route.label else 0
            places.append((route.edge.key, (x - half - 1, y - 9 if half else y)))
        return [self.marks[key].sign_group(at, self.plain) for key, at in places if key in self.marks]

    def _marked(self, key: str, draw: Callable[[], ShapeGroup]) -> ShapeGroup:
        """An element, drawn with the colors of its mark."""
        mark = self.marks.get(key)
        self.palette = self.plain if mark is None else mark.tint(self.plain)
        group = draw() if mark is None else mark.emphasize(draw())
        self.palette = self.plain
        return group

    def frame(self, frame: FrameBox) -> ShapeGroup:
        pal, rect = self.palette, frame.rect
        size = Size(width=rect.right - rect.left, height=rect.bottom - rect.top)
        center = (rect.left + size.width / 2, rect.top + size.height / 2)
        outline = rounded_rect_path(center, size.width, size.height, 16)
        at = (rect.left + FRAME_TITLE_INSET, rect.top + TITLE_HEIGHT / 2)
        shapes = (
            PathShape(commands=outline, fill=pal.frame_fill(frame.color), stroke=pal.plate_line),
            TextShape(x=at[0], y=at[1], text=frame.label, fill=pal.muted, font=NAME_FONT),
        )
        return ShapeGroup(title=frame.title, css_class="frame", shapes=shapes)

    def node(self, node: DiagramNode, initial: Corner | None) -> ShapeGroup:
        return self._marked(node.key, lambda: self._node(node, initial))

    def edge(self, route: EdgeRoute) -> ShapeGroup:
        return self._marked(route.edge.key, lambda: self._edge(route))

    def label(self, label: EdgeLabel | None, route: EdgeRoute) -> ShapeGroup:
        return self._marked(route.edge.key, lambda: self._label(label, route))

    def _node(self, node: DiagramNode, initial: Corner | None) -> ShapeGroup:
        drawers = {"state": self._state, "component": self._component, "common": self._common, "note": self._note}
        shapes = tuple(drawers[node.node_type](node))
        if initial:
            shapes += tuple(self._initial_marker(node, initial))
        return ShapeGroup(title=node.title, css_class=node.node_type, shapes=shapes, href=node.href, key=node.key)

    def _edge(self, route: EdgeRoute) -> ShapeGroup:
        pal, edge, ends = self.palette, route.edge, (route.edge.source, route.edge.target)
        tip, base = _arrowhead(route.curve)
        start = route.curve[:2]
        if edge.leads_back:
            x0, y0, x1, y1, x2, y2, x3, y3 = route.curve
            tail, start = _arrowhead((x3, y3, x2, y2, x1, y1, x0, y0))
            tip = (*tip, *tail)
        shaft = curve_path((*start, *route.curve[2:6], *base))
        if edge.edge_type == "requires":
            drawn = PathShape(commands=shaft, stroke=pal.requires, width=1.3, dash=(9, 4))
            head = PathShape(commands=tip, fill=pal.paper, stroke=pal.requires, width=1.3)
        elif edge.edge_type == "modulates":
            drawn = PathShape(commands=shaft, stroke=pal.modulates, width=2, dash=(1.5, 4))
            head = PathShape(commands=tip, fill=pal.modulates)
        else:
            is_common = edge.source == "common"
            color = pal.common if is_common else pal.edge
            drawn = PathShape(commands=shaft, stroke=color, width=1.6, dash=_dash(edge))
            head = PathShape(commands=tip, fill=color)
        is_echo = route.label is not None
        return ShapeGroup(
            title=edge.title,
            css_class=edge.edge_type,
            shapes=(drawn, head),
            href=edge.href,
            end_keys=ends,
            is_decorative=is_echo,
        )

    def _label(self, label: EdgeLabel | None, route: EdgeRoute) -> ShapeGroup:
        assert label is not None
        pal, (x, y) = self.palette, route.label_position
        plate = PathShape(
            commands=rounded_rect_path(route.label_position, label.size.width, label.size.height, 11),
            fill=pal.plate,
            stroke=pal.plate_line,
        )
        shapes: list[PathShape | TextShape] = [plate]
        x += PADDING - label.size.width / 2
        if label.order:
            shapes.append(TextShape(x=x, y=y, text=label.order, fill=pal.muted))
        x += label.order_width
        if label.icon:
            shapes += [PathShape(commands=steps, stroke=pal.muted, width=1.3) for steps in _icon(label.icon, (x, y))]
        x += label.icon_width
        if label.text:
            is_off = route.edge.disabled
            color = pal.muted if is_off else pal.text
            shapes.append(TextShape(x=x, y=y, text=label.text, fill=color, font=LABEL_FONT, is_struck_through=is_off))
        edge = route.edge
        ends = (edge.source, edge.target)
        return ShapeGroup(title=edge.title, css_class="label", shapes=tuple(shapes), href=edge.href, end_keys=ends)

    def _state(self, node: DiagramNode) -> Iterable[PathShape | TextShape]:
        pal, (x, y), size = self.palette, node.center, node.size
        colored = getattr(pal, f"color_{node.color}") if node.color else pal.box
        fill, dash = (pal.faint, (4, 4)) if node.disabled else (colored, ())
        yield PathShape(
            commands=rounded_rect_path(node.center, size.width, size.height, 12),
            fill=fill,
            stroke=pal.box_line,
            dash=dash,
        )
        if node.final:
            yield PathShape(
                commands=rounded_rect_path(node.center, size.width - 8, size.height - 8, 8), stroke=pal.box_line
            )
        yield _name_text(
            node, pal.muted if node.disabled else pal.text, rise=_NAME_OFFSET if node.badges or node.subtitle else 0
        )
        if node.subtitle:
            yield _subtitle_text(node, pal.muted)
        if node.badges:
            yield from self._badges(node.badges, (x, y + _BADGE_ROW))

    def _initial_marker(self, node: DiagramNode, corner: Corner) -> Iterable[PathShape]:
        pal, (across, down), (x, y), size = self.palette, corner, node.center, node.size
        dot = (x + across * (size.width / 2 + 12), y + down * (size.height / 2 + 20))
        tip = (x + across * (size.width / 2 - 22), y + down * (size.height / 2 + 1))
        end = (tip[0], tip[1] + down * 6)
        control = (tip[0], dot[1])
        bow = [value for ends in (dot, end) for value in quadratic_to_cubic(ends, control)]
        yield PathShape(commands=curve_path((*dot, *bow, *end)), stroke=pal.start, width=1.6)
        yield PathShape(
            commands=polyline_path(
                (tip, (tip[0] - 4.5, tip[1] + down * 8), (tip[0] + 4.5, tip[1] + down * 8)), closed=True
            ),
            fill=pal.start,
        )
        yield PathShape(commands=circle_path(dot, 6), fill=pal.start)

    def _badges(self, marks: tuple[tuple[str, int], ...], at: Point) -> Iterable[PathShape | TextShape]:
        pal = self.palette
        colors = {"requires": pal.requires, "modulates": pal.modulates}
        widths = [_BADGES[name][0] + (3 + 7 * len(str(count)) if count else 0) for name, count in marks]
        x = at[0] - (sum(widths) + _BADGE_GAP * (len(marks) - 1)) / 2
        for (name, count), width in zip(marks, widths, strict=True):
            color = colors.get(name, pal.muted)
            fill = color if name == "modulates" else ""
            yield PathShape(
                commands=polylines_path(*_BADGES[name][1], at=(x, at[1])), fill=fill, stroke=color, width=1.4
            )
            if count:
                yield TextShape(x=x + _BADGES[name][0] + 3, y=at[1], text=str(count), fill=color, font=SMALL_FONT)
            x += width + _BADGE_GAP

    def _component(self, node: DiagramNode) -> Iterable[PathShape | TextShape]:
        pal, (x, y) = self.palette, node.center
        w, h, slant = node.size.width / 2, node.size.height / 2, HEX_SLANT
        corners = ((-w, 0.0), (-w + slant, -h), (w - slant, -h), (w, 0.0), (w - slant, h), (-w + slant, h))
        steps = polyline_path([(x + dx, y + dy) for dx, dy in corners], closed=True)
        yield PathShape(commands=steps, fill=pal.component, stroke=pal.component_line, dash=(6, 3))
        yield _name_text(node, pal.component_text, rise=_NAME_OFFSET if node.subtitle else 0)
        if node.subtitle:
            yield _subtitle_text(node, pal.muted)

    def _note(self, node: DiagramNode) -> Iterable[PathShape | TextShape]:
        pal, (x, y), w, h = self.palette, node.center, node.size.width / 2, node.size.height / 2
        corners = ((-w, -h), (w - _FOLD, -h), (w, -h + _FOLD), (w, h), (-w, h))
        outline = polyline_path([(x + dx, y + dy) for dx, dy in corners], closed=True)
        yield PathShape(commands=outline, fill=pal.color_yellow, stroke=pal.plate_line, width=1)
        for index, line in enumerate(note_lines(node.label)):
            top = y - h + NOTE_PADDING + (index + 0.5) * NOTE_LINE_HEIGHT
            yield TextShape(x=x - w + NOTE_PADDING, y=top, text=line, fill=pal.text, font=LABEL_FONT)

    def _common(self, node: DiagramNode) -> Iterable[PathShape | TextShape]:
        pal, (x, y), size = self.palette, node.center, node.size
        outline = rounded_rect_path(node.center, size.width, size.height, size.height / 2)
        yield PathShape(commands=outline, fill=pal.common_fill, stroke=pal.common, dash=(5, 4))
        star = (((-52, -6), (-52, 6)), ((-57.2, -3), (-46.8, 3)), ((-57.2, 3), (-46.8, -3)))
        yield PathShape(commands=polylines_path(*star, at=node.center), stroke=pal.common, width=1.4)
        yield TextShape(x=x + 4, y=y, text=node.label, fill=pal.text, font=Font(size=13, bold=True), is_centered=True)


def _name_text(node: DiagramNode, color: str, *, rise: float) -> TextShape:
    return TextShape(
        x=node.center[0],
        y=node.center[1] + rise,
        text=node.label,
        fill=color,
        font=NAME_FONT,
        is_centered=True,
        is_struck_through=node.disabled,
    )


def _subtitle_text(node: DiagramNode, color: str) -> TextShape:
    return TextShape(
        x=node.center[0], y=node.center[1] + 12, text=node.subtitle, fill=color, font=SMALL_FONT, is_centered=True
    )


def _dash(edge: DiagramEdge) -> tuple[float, ...]:
    if edge.disabled:
        return (2, 5)
    return (6, 4) if edge.source == "common" or edge.derived else ()


def _icon(kind: GuardKind, at: Point) -> Iterable[tuple[tuple[str, tuple[float, ...]], ...]]:
    yield polylines_path(*_ICONS[kind], at=at)
    if kind is GuardKind.TIMER:
        yield circle_path((at[0] + 5, at[1]), 5)


def _arrowhead(of: CubicBezier) -> tuple[tuple[tuple[str, tuple[float, ...]], ...], Point]:
    """The arrowhead, and the point where the line meets it."""
    dx, dy = of[6] - of[4], of[7] - of[5]
    length = math.hypot(dx, dy) or 1
    ux, uy = dx / length, dy / length
    base = (of[6] - ux * _ARROWHEAD_LENGTH, of[7] - uy * _ARROWHEAD_LENGTH)
    side = (-uy * _ARROWHEAD_LENGTH * 0.42, ux * _ARROWHEAD_LENGTH * 0.42)
    notch = (base[0] + ux * 2, base[1] + uy * 2)
    corners = ((of[6], of[7]), (base[0] + side[0], base[1] + side[1]), notch, (base[0] - side[0], base[1] - side[1]))
    return polyline_path(corners, closed=True), notch


def _bounds(
    diagram: Diagram, routes: Iterable[EdgeRoute], corners: Mapping[str, Corner], outlines: Iterable[Rect]
) -> tuple[float, float, float, float]:
    """The bounds of everything, including labels and curves."""
    xs: list[float] = []
    ys: list[float] = []
    for node in diagram.nodes:
        rects = [Rect.from_center(node.center, node.size)]
        if node.key in corners:
            rects.append(marker_rect(node, corners[node.key]))
        xs += [x for rect in rects for x in (rect.left, rect.right)]
        ys += [y for rect in rects for y in (rect.top, rect.bottom)]
    for rect in (*(frame.rect for frame in diagram.frames), *outlines):
        xs += [rect.left, rect.right]
        ys += [rect.top, rect.bottom]
    for route in routes:
        for step in range(_SAMPLES + 1):
            x, y = point_on_curve(route.curve, step / _SAMPLES)
            xs.append(x)
            ys.append(y)
        if route.label:
            half = route.label.size.width / 2
            xs += [route.label_position[0] - half, route.label_position[0] + half]
            ys += [route.label_position[1] - 11, route.label_position[1] + 11]
    if not xs:
        return (0, 0, text_width("No states yet", LABEL_FONT), 20)
    return (min(xs), min(ys), max(xs), max(ys))
