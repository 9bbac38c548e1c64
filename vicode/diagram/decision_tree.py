"""Renders decisions as a tree: alternatives downwards, the branch of a guard that holds to the right. Conditions and
targets are links.

Rows and columns follow from the order of the tests, so the layout needs no search and handles any tree.
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from vicode.diagram.palettes import ColorPalette
from vicode.diagram.primitives import PathShape, ShapeGroup, TextShape, VectorImage, polyline_path, rounded_rect_path
from vicode.diagram.text_metrics import LABEL_FONT, SMALL_FONT, shorten, text_width
from vicode.diagram.transition_labels import guard_label
from vicode.findings import DesignPath as ThingPath
from vicode.model.design import Decision, Point, Transition
from vicode.model.design import DecisionGroup as Branch

_ROW_HEIGHT, _BOX_HEIGHT, _COLUMN_GAP, _MARGIN = 62.0, 32.0, 56.0, 16.0
_MAX_LABEL_WIDTH, _PADDING, _SLANT = 230.0, 14.0, 10.0
# An edge back runs below the label next to the downward edge.
_TURN_OFFSET, _GUTTER_WIDTH, _ARROWHEAD_LENGTH = 17.0, 22.0, 8.0
_MAX_LABEL_DOC = 34
MAX_NODES = 200
"""Larger trees show only their upper levels; more boxes are not readable."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TreeLinks:
    """Link targets: of a condition by its path, of a target by its name. `fallthrough_label` is shown if no guard
    holds.

    `key` identifies a decision by its path, so that a page can find its boxes. `time_unit` is the unit of timers.
    """

    condition_href: Callable[[ThingPath], str]
    target_href: Callable[[str], str]
    fallthrough_label: str = "stay"
    decision_key: Callable[[ThingPath], str] = lambda _path: ""
    time_unit: str = ""


@dataclass(slots=True, kw_only=True)
class _TreeNode:
    kind: str
    column: int
    row: int
    label: str
    title: str
    href: str = ""
    key: str = ""
    is_disabled: bool = False

    @property
    def width(self) -> float:
        return max(
            56.0, text_width(self.label, LABEL_FONT) + 2 * (_PADDING + (_SLANT if self.kind == "condition" else 0))
        )


@dataclass(frozen=True, slots=True)
class _OpenEdge:
    """An edge without a target yet: to the right if `is_yes`, else downwards."""

    node: _TreeNode
    is_yes: bool


@dataclass(slots=True)
class _TreeGrid:
    """Boxes in rows and columns, and their edges. Boxes beyond `max_column` or after `max_nodes` are collapsed."""

    links: TreeLinks
    max_column: int = sys.maxsize
    max_nodes: int = sys.maxsize
    nodes: list[_TreeNode] = field(default_factory=list)
    edges: list[tuple[_OpenEdge, _TreeNode]] = field(default_factory=list)

    def add(self, node: _TreeNode, entries: Sequence[_OpenEdge]) -> _TreeNode:
        self.nodes.append(node)
        self.edges += [(entry, node) for entry in entries]
        return node

    def add_decisions(
        self,
        items: Sequence[Decision],
        path: ThingPath,
        at: tuple[int, int],
        entries: list[_OpenEdge],
        off: bool = False,
    ) -> tuple[list[_OpenEdge], int]:
        """Place decisions in a column from a row on. Returns the open edges for the case that no guard holds, and the
        next free row.
        """
        column, row = at
        for index, item in enumerate(items):
            here = (*path, index)
            is_off = off or item.disabled
            if not entries:
                break
            if len(self.nodes) >= self.max_nodes:
                return self._add_folded(items[index:], (*path, index), (column, row), entries)
            follow = entries
            if not item.guard.is_empty:
                condition = self.add(self._condition_node(item, here, (column, row), off=is_off), entries)
                follow, entries = [_OpenEdge(condition, True)], [_OpenEdge(condition, False)]
            else:
                entries = []
            beside = (column + (not item.guard.is_empty), row)
            if isinstance(item, Branch):
                put = self._add_folded if beside[0] >= self.max_column and _is_nested(item.then) else self.add_decisions
                inner = (*here, "then", 0) if put == self._add_folded else (*here, "then")
                through, row = put(item.then, inner, beside, follow, is_off)
                if item.otherwise and entries:
                    entries, row = self.add_decisions(item.otherwise, (*here, "else"), (column, row), entries, is_off)
                entries = [*through, *entries]
            else:
                self.add(self._outcome_node(item, here, beside, off=is_off), follow)
                row += 1
        return entries, row

    def _add_folded(
        self,
        items: Sequence[Decision],
        path: ThingPath,
        at: tuple[int, int],
        entries: list[_OpenEdge],
        off: bool = False,
    ) -> tuple[list[_OpenEdge], int]:
        """One box for decisions that are not drawn, linked to the description of the first one."""
        start, column, row = _OpenEdge(_TreeNode(kind="", column=0, row=-1, label="", title=""), False), *at
        hidden = _TreeGrid(self.links)
        through, _row = hidden.add_decisions(items, path[:-1], (0, 0), [start], off)
        count = sum(node.kind == "condition" for node in hidden.nodes) or len(hidden.nodes)
        label = f"{count} more test{'s' * (count != 1)}"
        title, href = f"{label}, which are not drawn", self.links.condition_href(path)
        box = _TreeNode(kind="folded", column=column, row=row, label=label, title=title, href=href, is_disabled=off)
        self.add(box, entries)
        return [_OpenEdge(box, False)] if through else [], row + 1

    def _condition_node(self, item: Decision, path: ThingPath, at: tuple[int, int], *, off: bool) -> _TreeNode:
        guard, doc = guard_label(item.guard, self.links.time_unit, spell_out=True), " ".join(item.doc.split())
        label = doc if 0 < len(doc) <= _MAX_LABEL_DOC else guard
        title = "\n".join(part for part in (guard, doc) if part)
        href, key = self.links.condition_href(path), self.links.decision_key(path)
        shown = shorten(label, LABEL_FONT, _MAX_LABEL_WIDTH)
        return _TreeNode(
            kind="condition", column=at[0], row=at[1], label=shown, title=title, href=href, key=key, is_disabled=off
        )

    def _outcome_node(self, item: Decision, path: ThingPath, at: tuple[int, int], *, off: bool) -> _TreeNode:
        key = self.links.decision_key(path)
        if isinstance(item, Transition):
            label, href = shorten(item.to, LABEL_FONT, _MAX_LABEL_WIDTH), self.links.target_href(item.to)
            title = f"go to {item.to}"
            return _TreeNode(
                kind="target", column=at[0], row=at[1], label=label, title=title, href=href, key=key, is_disabled=off
            )
        href = self.links.condition_href(path)
        return _TreeNode(
            kind="stay", column=at[0], row=at[1], label="stay", title="stay", href=href, key=key, is_disabled=off
        )


def render_decision_tree(
    items: Sequence[Decision],
    path: ThingPath,
    *,
    title: str,
    links: TreeLinks,
    palette: ColorPalette,
    max_nodes: int = MAX_NODES,
) -> VectorImage | None:
    """Render decisions, limited to the upper levels above `max_nodes` boxes; None without decisions."""
    if not items:
        return None
    grid = _fill_grid(_TreeGrid(links), items, path)
    while len(grid.nodes) > max_nodes and grid.max_column > 1:
        columns = max(node.column for node in grid.nodes)
        grid = _fill_grid(_TreeGrid(links, max_column=max(1, min(columns, grid.max_column) - 1)), items, path)
    if len(grid.nodes) > max_nodes:
        grid = _fill_grid(_TreeGrid(links, max_column=1, max_nodes=max_nodes * 9 // 10), items, path)
    return _TreeRenderer(grid, palette).render(title)


def _fill_grid(grid: _TreeGrid, items: Sequence[Decision], path: ThingPath) -> _TreeGrid:
    entries, row = grid.add_decisions(
        items, path, (0, 0), [_OpenEdge(_TreeNode(kind="", column=0, row=-1, label="", title=""), False)]
    )
    if entries:
        last = _TreeNode(
            kind="stay", column=0, row=row, label=grid.links.fallthrough_label, title=grid.links.fallthrough_label
        )
        grid.add(last, entries)
    return grid


def _is_nested(items: Sequence[Decision]) -> bool:
    """Whether the decisions have more than one outcome."""
    return len(items) > 1 or any(isinstance(item, Branch) or not item.guard.is_empty for item in items)


class _TreeRenderer:
    """Draws a tree with its positions and colors."""

    def __init__(self, grid: _TreeGrid, palette: ColorPalette) -> None:
        self.grid, self.palette = grid, palette
        columns = 1 + max(node.column for node in grid.nodes)
        widths = [max((n.width for n in grid.nodes if n.column == at), default=0.0) for at in range(columns)]
        self.column_lefts = [sum(widths[:at]) + at * _COLUMN_GAP for at in range(columns)]
        self.width = self.column_lefts[-1] + widths[-1]

    def render(self, title: str) -> VectorImage:
        """Draw the edges, then the boxes on top."""
        groups = [*(self._edge(way, node) for way, node in self.grid.edges), *map(self._node, self.grid.nodes)]
        bottom = max(node.row for node in self.grid.nodes) * _ROW_HEIGHT + _BOX_HEIGHT / 2
        return VectorImage(
            title=title,
            doc="",
            left=-_MARGIN,
            top=-_BOX_HEIGHT / 2 - 20 - _MARGIN,
            width=self.width + 2 * _MARGIN,
            height=bottom + _BOX_HEIGHT / 2 + 20 + 2 * _MARGIN,
            background=self.palette.paper,
            groups=tuple(groups),
        )

    def _center(self, node: _TreeNode) -> Point:
        return (self.column_lefts[node.column] + node.width / 2, node.row * _ROW_HEIGHT)

    def _node(self, node: _TreeNode) -> ShapeGroup:
        pal, (x, y), half = self.palette, self._center(node), node.width / 2
        fill, text = (pal.faint, pal.muted) if node.is_disabled else (pal.box, pal.text)
        dash = (4.0, 4.0) if node.is_disabled or node.kind in ("stay", "folded") else ()
        h = _BOX_HEIGHT / 2
        if node.kind == "condition":
            corners = (
                (-half, 0.0),
                (-half + _SLANT, -h),
                (half - _SLANT, -h),
                (half, 0.0),
                (half - _SLANT, h),
                (-half + _SLANT, h),
            )
            outline = polyline_path([(x + dx, y + dy) for dx, dy in corners], closed=True)
            shape = PathShape(commands=outline, fill=fill, stroke=pal.edge, width=1.3, dash=dash)
        else:
            shape = PathShape(
                commands=rounded_rect_path((x, y), node.width, _BOX_HEIGHT, 10),
                fill=fill,
                stroke=pal.box_line,
                dash=dash,
            )
        label = TextShape(
            x=x, y=y, text=node.label, fill=text, font=LABEL_FONT, is_centered=True, is_struck_through=node.is_disabled
        )
        return ShapeGroup(title=node.title, css_class=node.kind, shapes=(shape, label), href=node.href, key=node.key)

    def _edge(self, open_edge: _OpenEdge, node: _TreeNode) -> ShapeGroup:
        pal = self.palette
        points = list(self._points(open_edge, node))
        tip, before = points[-1], points[-2]
        dash = (2.0, 5.0) if open_edge.node.is_disabled or node.is_disabled else ()
        shaft = PathShape(commands=polyline_path(points), stroke=pal.edge, width=1.4, dash=dash)
        head = PathShape(commands=_arrowhead(before, tip), fill=pal.edge)
        shapes: list[PathShape | TextShape] = [shaft, head]
        if open_edge.node.kind and open_edge.node.kind != "folded":
            x, y = points[0]
            word = "yes" if open_edge.is_yes else "else"
            position = (x + 8, y - 8) if open_edge.is_yes else (x + 6, y + 8)
            shapes.append(TextShape(x=position[0], y=position[1], text=word, fill=pal.muted, font=SMALL_FONT))
        # Screen readers get the same information from the boxes.
        title = f"{'when' if open_edge.is_yes else 'when not'} {open_edge.node.title}" if open_edge.node.kind else ""
        if open_edge.node.kind == "folded":
            title = f"after {open_edge.node.label}"
        return ShapeGroup(
            title=title,
            css_class="way",
            shapes=tuple(shapes),
            href=node.href if title else "",
            is_decorative=bool(title),
        )

    def _points(self, open_edge: _OpenEdge, node: _TreeNode) -> Iterator[Point]:
        x, y = self._center(node)
        top = y - _BOX_HEIGHT / 2
        if not open_edge.node.kind:
            yield from ((self._spine_x(node), top - 20), (self._spine_x(node), top))
            return
        from_x, from_y = self._center(open_edge.node)
        if open_edge.is_yes:
            yield from ((from_x + open_edge.node.width / 2, from_y), (x - node.width / 2, y))
            return
        down, spine = from_y + _BOX_HEIGHT / 2, self._spine_x(open_edge.node)
        yield (spine, down)
        if node.column != open_edge.node.column:
            # Back to an earlier column next to the boxes, entering just above the next test.
            above = top - (_ROW_HEIGHT - _BOX_HEIGHT - _TURN_OFFSET)
            gutter = self.column_lefts[open_edge.node.column] - _GUTTER_WIDTH
            yield from ((spine, down + _TURN_OFFSET), (gutter, down + _TURN_OFFSET), (gutter, above))
            yield (self._spine_x(node), above)
        yield (self._spine_x(node), top)

    def _spine_x(self, node: _TreeNode) -> float:
        """Boxes of a column are left-aligned; downward edges leave near their left side, so that they are straight."""
        return self.column_lefts[node.column] + 28.0


def _arrowhead(before: Point, tip: Point) -> tuple[tuple[str, tuple[float, ...]], ...]:
    dx, dy = tip[0] - before[0], tip[1] - before[1]
    length = (dx * dx + dy * dy) ** 0.5 or 1.0
    ux, uy = dx / length * _ARROWHEAD_LENGTH, dy / length * _ARROWHEAD_LENGTH
    side = (-uy * 0.42, ux * 0.42)
    base = (tip[0] - ux, tip[1] - uy)
    return polyline_path(
        (tip, (base[0] + side[0], base[1] + side[1]), (base[0] - side[0], base[1] - side[1])), closed=True
    )
