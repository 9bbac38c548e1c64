"""A diagram before routing: nodes and edges with final texts and sizes."""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass

from vicode.diagram.drawn_transitions import draw_transitions, has_work, shows_common
from vicode.diagram.frames import TITLE_HEIGHT, drawn_frames, frame_padding, frame_rect
from vicode.diagram.layered_layout import NodeLayout, complete_layout, note_position
from vicode.diagram.node_geometry import COMMON_SIZE, Size, note_size, state_size, use_size
from vicode.diagram.spatial_index import Rect
from vicode.diagram.text_metrics import NAME_FONT, SMALL_FONT, shorten, text_width
from vicode.diagram.transition_labels import GuardKind
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Call, Design, Point, State

FRAME_TITLE_INSET = 14.0
_MAX_NAME_WIDTH, _MAX_SUBTITLE_WIDTH = 230.0, 200.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagramNode:
    """A box: a state, a component, the common transitions or a note. `badges` are texts for the row below the name.

    `href` is the link target, "" for none.
    """

    key: str
    node_type: str
    center: Point
    size: Size
    label: str
    title: str
    subtitle: str = ""
    color: str = ""
    initial: bool = False
    final: bool = False
    disabled: bool = False
    badges: tuple[tuple[str, int], ...] = ()
    href: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagramEdge:
    """A transition or a link; `order` is the priority, 0 if there is only one.

    A transition is `derived` if an interrupt, a competence or layers mean it: then `also` has the keys of the others
    that it stands for, and it may have an arrowhead at both ends (`leads_back`).
    `href` is the link target, "" for none.
    """

    key: str
    edge_type: str
    source: str
    target: str
    title: str
    label: str = ""
    order: int = 0
    guard_kind: GuardKind = GuardKind.ALWAYS
    disabled: bool = False
    derived: bool = False
    leads_back: bool = False
    also: tuple[str, ...] = ()
    label_at: Point | None = None
    href: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameBox:
    """The rectangle of a frame, with its full title and the text that fits."""

    key: str
    rect: Rect
    title: str
    label: str
    color: str = ""

    @property
    def title_rect(self) -> Rect:
        """The rectangle of the title, which labels avoid."""
        left, top = self.rect.left + FRAME_TITLE_INSET, self.rect.top
        return Rect(left, top, left + text_width(self.label, NAME_FONT), top + TITLE_HEIGHT)


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagram:
    """Nodes and edges; both ends of an edge are among the nodes. Frames are behind them, back to front."""

    nodes: tuple[DiagramNode, ...]
    edges: tuple[DiagramEdge, ...]
    frames: tuple[FrameBox, ...] = ()


def build_diagram(design: Design, *, only: Collection[str] | None = None, links: bool = True) -> Diagram:
    """The diagram of a design, or of some states and the components they use."""
    edges = (*_transition_edges(design, only), *(_use_edges(design) if links else ()))
    nodes = tuple(_diagram_nodes(design, complete_layout(design)))
    if only is not None:
        wanted = {_state_key(name) for name in only}
        used = {edge.source for edge in edges if edge.edge_type == "requires" and edge.target in wanted}
        used |= {edge.target for edge in edges if edge.edge_type == "modulates" and edge.source in wanted}
        nodes = tuple(node for node in nodes if node.key in wanted | used)
    elif not links:
        nodes = tuple(node for node in nodes if node.node_type != "component")
    known = {node.key for node in nodes}
    return Diagram(
        nodes=nodes,
        edges=tuple(edge for edge in edges if edge.source in known and edge.target in known),
        frames=tuple(_frame_boxes(design, nodes, only)),
    )


def _frame_boxes(design: Design, nodes: Iterable[DiagramNode], only: Collection[str] | None) -> Iterator[FrameBox]:
    rects = {node.key: Rect.from_center(node.center, node.size) for node in nodes}
    for frame, states, level in drawn_frames(design, only):
        rect = frame_rect((rects[_state_key(name)] for name in states), frame_padding(level))
        label = shorten(frame.name, NAME_FONT, rect.right - rect.left - 2 * FRAME_TITLE_INSET)
        yield FrameBox(key=f"f:{frame.name}", rect=rect, title=frame.name, label=label, color=frame.color)


def _state_key(name: str) -> str:
    return f"s:{name}"


def _use_key(alias: str) -> str:
    return f"c:{alias}"


def _source_key(source: str) -> str:
    return "common" if source == COMMON else _state_key(source)


def _diagram_nodes(design: Design, placement: NodeLayout) -> Iterator[DiagramNode]:
    for use in design.uses:
        yield DiagramNode(
            key=_use_key(use.alias),
            node_type="component",
            center=placement.uses[use.alias],
            size=use_size(use.alias, use.component),
            label=shorten(use.alias, NAME_FONT, _MAX_NAME_WIDTH),
            subtitle=shorten(use.component, SMALL_FONT, _MAX_SUBTITLE_WIDTH) if use.component != use.alias else "",
            title=f"{use.alias}: component {use.component}",
        )
    if shows_common(design):
        yield DiagramNode(
            key="common",
            node_type="common",
            center=placement.common,
            size=COMMON_SIZE,
            label="every state",
            title="\n".join(part for part in ("Common transitions of every state", design.common.doc) if part),
        )
    for index, note in enumerate(design.notes):
        yield DiagramNode(
            key=f"n:{note.name}",
            node_type="note",
            center=note_position(note, index),
            size=note_size(note.text),
            label=note.text,
            title="Note",
        )
    for state in design.states:
        yield _state_node(design, state, placement.states[state.name])


def _state_node(design: Design, state: State, at: Point) -> DiagramNode:
    return DiagramNode(
        key=_state_key(state.name),
        node_type="state",
        center=at,
        size=state_size(state.name),
        label=shorten(state.name, NAME_FONT, _MAX_NAME_WIDTH),
        title="\n".join(part for part in (f"State {state.name}", state.doc) if part),
        color=state.color,
        initial=state.name == design.initial,
        final=state.final,
        disabled=state.disabled,
        badges=tuple(_badges(state)),
    )


def _badges(state: State) -> Iterator[tuple[str, int]]:
    called = {action.alias for action in state.all_actions if isinstance(action, Call)}
    works = has_work(state.actions)
    for name, flag in (("enter", bool(state.enter)), ("actions", works), ("leave", bool(state.leave))):
        if flag:
            yield name, 0
    for name, count in (("requires", len(state.requires)), ("modulates", len(called))):
        if count:
            yield name, count


def _transition_edges(design: Design, only: Collection[str] | None) -> Iterator[DiagramEdge]:
    all_of_them = draw_transitions(design, only)
    counts = Counter(drawn.source for drawn in all_of_them)
    orders: Counter[str] = Counter()
    for drawn in all_of_them:
        orders[drawn.source] += 1
        source = "every state" if drawn.source == COMMON else drawn.source
        way = f"{source} {'↔' if drawn.leads_back else '→'} {drawn.target}"
        yield DiagramEdge(
            key=_edge_key(drawn.paths[0]),
            edge_type="transition",
            source=_source_key(drawn.source),
            target=_state_key(drawn.target),
            title="\n".join(part for part in (way, drawn.text) if part),
            label=drawn.label,
            order=orders[drawn.source] if counts[drawn.source] > 1 else 0,
            guard_kind=drawn.guard_kind,
            disabled=drawn.disabled,
            derived=drawn.derived,
            leads_back=drawn.leads_back,
            also=tuple(map(_edge_key, drawn.paths[1:])),
            label_at=getattr(drawn.located.decision, "label_at", None),
        )


def _edge_key(path: DesignPath) -> str:
    return "t:" + "/".join(map(str, path))


def _use_edges(design: Design) -> Iterator[DiagramEdge]:
    for state in design.states:
        calls = (action.alias for action in state.all_actions if isinstance(action, Call))
        for alias in dict.fromkeys(state.requires):
            key, title = f"requires/{state.name}/{alias}", f"{state.name} requires {alias}"
            yield DiagramEdge(
                key=key, edge_type="requires", source=_use_key(alias), target=_state_key(state.name), title=title
            )
        for alias in dict.fromkeys(calls):
            key, title = f"modulates/{state.name}/{alias}", f"{state.name} modulates {alias}"
            yield DiagramEdge(
                key=key, edge_type="modulates", source=_state_key(state.name), target=_use_key(alias), title=title
            )
