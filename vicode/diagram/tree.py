"""Decisions as a drawing: tested downwards, what follows when one holds to the right; conditions and targets are links.

Rows and columns follow from the order of the tests, so that nothing has to be searched for, and no tree is too hard.
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from vicode.diagram.labels import guard_label
from vicode.diagram.lettering import LABEL, SMALL, shorten, text_width
from vicode.diagram.palettes import Palette
from vicode.diagram.shapes import Drawing, Group, Path, Text, box, line
from vicode.findings import Path as ThingPath
from vicode.model.design import Decision, Point, Transition
from vicode.model.design import Group as Branch

_ROW, _HEIGHT, _BETWEEN, _MARGIN = 62.0, 32.0, 56.0, 16.0
_ROOM, _PADDING, _SLANT = 230.0, 14.0, 10.0
# A way back runs below the word beside the way down.
_TURN, _GUTTER, _HEAD = 17.0, 22.0, 8.0
_SHORT_DOC = 34
MOST_NODES = 200
"""Of a larger tree the upper levels are drawn: more is no drawing that anybody reads."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Links:
    """Where clicks lead: on a condition by its path, on a target by its name; `last` is what stands at the end.

    `key` names a decision by its path, so that a page can find the boxes that belong to it. `unit` is that of times.
    """

    condition: Callable[[ThingPath], str]
    target: Callable[[str], str]
    last: str = "stay"
    key: Callable[[ThingPath], str] = lambda _path: ""
    unit: str = ""


@dataclass(slots=True, kw_only=True)
class _Node:
    kind: str
    column: int
    row: int
    label: str
    title: str
    href: str = ""
    key: str = ""
    off: bool = False

    @property
    def width(self) -> float:
        return max(56.0, text_width(self.label, LABEL) + 2 * (_PADDING + (_SLANT if self.kind == "condition" else 0)))


@dataclass(frozen=True, slots=True)
class _Exit:
    """A way out of a node: with `holds` to the right, else downwards."""

    node: _Node
    holds: bool


@dataclass(slots=True)
class _Grid:
    """What stands where, and who follows whom; what is beyond the column `deepest` or after `most` boxes is folded."""

    links: Links
    deepest: int = sys.maxsize
    most: int = sys.maxsize
    nodes: list[_Node] = field(default_factory=list)
    edges: list[tuple[_Exit, _Node]] = field(default_factory=list)

    def put(self, node: _Node, entries: Sequence[_Exit]) -> _Node:
        self.nodes.append(node)
        self.edges += [(entry, node) for entry in entries]
        return node

    def items(
        self, items: Sequence[Decision], path: ThingPath, at: tuple[int, int], entries: list[_Exit], off: bool = False
    ) -> tuple[list[_Exit], int]:
        """Put decisions into a column from a row on; the ways out when none holds, and the next free row."""
        column, row = at
        for index, item in enumerate(items):
            here = (*path, index)
            is_off = off or item.disabled
            if not entries:
                break
            if len(self.nodes) >= self.most:
                return self._folded(items[index:], (*path, index), (column, row), entries)
            follow = entries
            if not item.guard.is_empty:
                condition = self.put(self._condition(item, here, (column, row), off=is_off), entries)
                follow, entries = [_Exit(condition, True)], [_Exit(condition, False)]
            else:
                entries = []
            beside = (column + (not item.guard.is_empty), row)
            if isinstance(item, Branch):
                put = self._folded if beside[0] >= self.deepest and _is_nested(item.then) else self.items
                inner = (*here, "then", 0) if put == self._folded else (*here, "then")
                through, row = put(item.then, inner, beside, follow, is_off)
                if item.otherwise and entries:
                    entries, row = self.items(item.otherwise, (*here, "else"), (column, row), entries, is_off)
                entries = [*through, *entries]
            else:
                self.put(self._outcome(item, here, beside, off=is_off), follow)
                row += 1
        return entries, row

    def _folded(
        self, items: Sequence[Decision], path: ThingPath, at: tuple[int, int], entries: list[_Exit], off: bool = False
    ) -> tuple[list[_Exit], int]:
        """One box for decisions, the first of which has this path; it leads to where all of them are said."""
        start, column, row = _Exit(_Node(kind="", column=0, row=-1, label="", title=""), False), *at
        hidden = _Grid(self.links)
        through, _row = hidden.items(items, path[:-1], (0, 0), [start], off)
        count = sum(node.kind == "condition" for node in hidden.nodes) or len(hidden.nodes)
        label = f"{count} more test{'s' * (count != 1)}"
        title, href = f"{label}, which are not drawn", self.links.condition(path)
        box = _Node(kind="folded", column=column, row=row, label=label, title=title, href=href, off=off)
        self.put(box, entries)
        return [_Exit(box, False)] if through else [], row + 1

    def _condition(self, item: Decision, path: ThingPath, at: tuple[int, int], *, off: bool) -> _Node:
        guard, doc = guard_label(item.guard, self.links.unit, spelled=True), " ".join(item.doc.split())
        label = doc if 0 < len(doc) <= _SHORT_DOC else guard
        title = "\n".join(part for part in (guard, doc) if part)
        href, key = self.links.condition(path), self.links.key(path)
        shown = shorten(label, LABEL, _ROOM)
        return _Node(kind="condition", column=at[0], row=at[1], label=shown, title=title, href=href, key=key, off=off)

    def _outcome(self, item: Decision, path: ThingPath, at: tuple[int, int], *, off: bool) -> _Node:
        key = self.links.key(path)
        if isinstance(item, Transition):
            label, href = shorten(item.to, LABEL, _ROOM), self.links.target(item.to)
            title = f"go to {item.to}"
            return _Node(kind="target", column=at[0], row=at[1], label=label, title=title, href=href, key=key, off=off)
        href = self.links.condition(path)
        return _Node(kind="stay", column=at[0], row=at[1], label="stay", title="stay", href=href, key=key, off=off)


def draw_tree(
    items: Sequence[Decision], path: ThingPath, *, title: str, links: Links, palette: Palette, most: int = MOST_NODES
) -> Drawing | None:
    """The drawing of decisions, the upper levels where there are more than so many boxes; None for no decisions."""
    if not items:
        return None
    grid = _filled(_Grid(links), items, path)
    while len(grid.nodes) > most and grid.deepest > 1:
        columns = max(node.column for node in grid.nodes)
        grid = _filled(_Grid(links, deepest=max(1, min(columns, grid.deepest) - 1)), items, path)
    if len(grid.nodes) > most:
        grid = _filled(_Grid(links, deepest=1, most=most * 9 // 10), items, path)
    return _Artist(grid, palette).drawing(title)


def _filled(grid: _Grid, items: Sequence[Decision], path: ThingPath) -> _Grid:
    entries, row = grid.items(items, path, (0, 0), [_Exit(_Node(kind="", column=0, row=-1, label="", title=""), False)])
    if entries:
        last = _Node(kind="stay", column=0, row=row, label=grid.links.last, title=grid.links.last)
        grid.put(last, entries)
    return grid


def _is_nested(items: Sequence[Decision]) -> bool:
    """Whether there is more to it than one outcome."""
    return len(items) > 1 or any(isinstance(item, Branch) or not item.guard.is_empty for item in items)


class _Artist:
    """Knows the places and the colours."""

    def __init__(self, grid: _Grid, palette: Palette) -> None:
        self.grid, self.palette = grid, palette
        columns = 1 + max(node.column for node in grid.nodes)
        widths = [max((n.width for n in grid.nodes if n.column == at), default=0.0) for at in range(columns)]
        self.lefts = [sum(widths[:at]) + at * _BETWEEN for at in range(columns)]
        self.width = self.lefts[-1] + widths[-1]

    def drawing(self, title: str) -> Drawing:
        """Lines first, boxes above them."""
        groups = [*(self._edge(way, node) for way, node in self.grid.edges), *map(self._node, self.grid.nodes)]
        bottom = max(node.row for node in self.grid.nodes) * _ROW + _HEIGHT / 2
        return Drawing(
            title=title,
            doc="",
            left=-_MARGIN,
            top=-_HEIGHT / 2 - 20 - _MARGIN,
            width=self.width + 2 * _MARGIN,
            height=bottom + _HEIGHT / 2 + 20 + 2 * _MARGIN,
            paper=self.palette.paper,
            groups=tuple(groups),
        )

    def _centre(self, node: _Node) -> Point:
        return (self.lefts[node.column] + node.width / 2, node.row * _ROW)

    def _node(self, node: _Node) -> Group:
        pal, (x, y), half = self.palette, self._centre(node), node.width / 2
        fill, text = (pal.faint, pal.muted) if node.off else (pal.box, pal.text)
        dash = (4.0, 4.0) if node.off or node.kind in ("stay", "folded") else ()
        h = _HEIGHT / 2
        if node.kind == "condition":
            corners = (
                (-half, 0.0),
                (-half + _SLANT, -h),
                (half - _SLANT, -h),
                (half, 0.0),
                (half - _SLANT, h),
                (-half + _SLANT, h),
            )
            outline = line([(x + dx, y + dy) for dx, dy in corners], closed=True)
            shape = Path(steps=outline, fill=fill, stroke=pal.edge, width=1.3, dash=dash)
        else:
            shape = Path(steps=box((x, y), node.width, _HEIGHT, 10), fill=fill, stroke=pal.box_line, dash=dash)
        label = Text(x=x, y=y, text=node.label, fill=text, letters=LABEL, is_centred=True, is_struck=node.off)
        return Group(title=node.title, kind=node.kind, shapes=(shape, label), href=node.href, key=node.key)

    def _edge(self, way: _Exit, node: _Node) -> Group:
        pal = self.palette
        points = list(self._points(way, node))
        tip, before = points[-1], points[-2]
        dash = (2.0, 5.0) if way.node.off or node.off else ()
        shaft = Path(steps=line(points), stroke=pal.edge, width=1.4, dash=dash)
        head = Path(steps=_head(before, tip), fill=pal.edge)
        shapes: list[Path | Text] = [shaft, head]
        if way.node.kind and way.node.kind != "folded":
            x, y = points[0]
            word = "yes" if way.holds else "else"
            place = (x + 8, y - 8) if way.holds else (x + 6, y + 8)
            shapes.append(Text(x=place[0], y=place[1], text=word, fill=pal.muted, letters=SMALL))
        # Its boxes say it all to who cannot see the line.
        said = f"{'when' if way.holds else 'when not'} {way.node.title}" if way.node.kind else ""
        if way.node.kind == "folded":
            said = f"after {way.node.label}"
        return Group(title=said, kind="way", shapes=tuple(shapes), href=node.href if said else "", is_echo=bool(said))

    def _points(self, way: _Exit, node: _Node) -> Iterator[Point]:
        x, y = self._centre(node)
        top = y - _HEIGHT / 2
        if not way.node.kind:
            yield from ((self._spine(node), top - 20), (self._spine(node), top))
            return
        from_x, from_y = self._centre(way.node)
        if way.holds:
            yield from ((from_x + way.node.width / 2, from_y), (x - node.width / 2, y))
            return
        down, spine = from_y + _HEIGHT / 2, self._spine(way.node)
        yield (spine, down)
        if node.column != way.node.column:
            # Back to an earlier column beside the boxes, and in just above the next test.
            above = top - (_ROW - _HEIGHT - _TURN)
            gutter = self.lefts[way.node.column] - _GUTTER
            yield from ((spine, down + _TURN), (gutter, down + _TURN), (gutter, above))
            yield (self._spine(node), above)
        yield (self._spine(node), top)

    def _spine(self, node: _Node) -> float:
        """Boxes of a column begin at one line; ways down leave near their beginning, so that they run straight."""
        return self.lefts[node.column] + 28.0


def _head(before: Point, tip: Point) -> tuple[tuple[str, tuple[float, ...]], ...]:
    dx, dy = tip[0] - before[0], tip[1] - before[1]
    length = (dx * dx + dy * dy) ** 0.5 or 1.0
    ux, uy = dx / length * _HEAD, dy / length * _HEAD
    side = (-uy * 0.42, ux * 0.42)
    base = (tip[0] - ux, tip[1] - uy)
    return line((tip, (base[0] + side[0], base[1] + side[1]), (base[0] - side[0], base[1] - side[1])), closed=True)
