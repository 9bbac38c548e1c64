"""A design as a layout graph: boxes with sizes, edges with weights, safe ids."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from vicode.diagram.drawn_transitions import draw_transitions, shows_common
from vicode.diagram.frames import FrameGroup, nest_frames
from vicode.diagram.node_geometry import COMMON_SIZE, Size, estimate_text_width, state_size, use_size
from vicode.model.design import COMMON, Call, Design, Guard

COMMON_ID = "common"
_TRANSITION_WEIGHT, _LINK_WEIGHT = 8, 1
_MAX_LABEL_WIDTH = 150.0
# Above this many boxes, edges within a layer are omitted: they cost more time than they improve the layout.
_MAX_NODES_WITH_LAYER_EDGES = 150
# Labels use a smaller and lighter font than names.
_LABEL_SCALE = 0.75


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutNode:
    """A box; `label` is its display name."""

    id: str
    label: str
    width: float
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutEdge:
    """One edge for all transitions between two boxes; higher weights are kept shorter. `label_width` belongs to the
    first one.

    `may_share_rank`: both ends may be in one rank, which avoids separate ranks for used components.
    """

    source: str
    target: str
    weight: int
    label_width: float = 0.0
    may_share_rank: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutCluster:
    """Boxes of a frame, which no other box comes between; `nodes` are those in none of the inner clusters."""

    nodes: tuple[str, ...]
    clusters: "tuple[LayoutCluster, ...]" = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutGraph:
    """The graph to lay out; the first node is the initial state."""

    nodes: tuple[LayoutNode, ...]
    edges: tuple[LayoutEdge, ...]
    clusters: tuple[LayoutCluster, ...] = ()


def build_layout_graph(design: Design, only: Collection[str] | None = None) -> LayoutGraph:
    """The graph of a design, or of some states and the edges between them."""
    nodes = tuple(_layout_nodes(design, only))
    known = {node.id for node in nodes}
    candidates = (*_transition_edges(design), *_use_edges(design))
    edges = [
        edge for edge in candidates if edge.source in known and edge.target in known and edge.source != edge.target
    ]
    clusters = _clusters(nest_frames(design, only), state_ids(design))
    return LayoutGraph(nodes=nodes, edges=_orient_edges(nodes, edges), clusters=clusters)


def _clusters(groups: Iterable[FrameGroup], ids: Mapping[str, str]) -> tuple[LayoutCluster, ...]:
    return tuple(
        LayoutCluster(
            nodes=tuple(id_ for name, id_ in ids.items() if name in group.own_states),
            clusters=_clusters(group.groups, ids),
        )
        for group in groups
    )


def state_ids(design: Design) -> dict[str, str]:
    """The id of every state by name; of duplicate names the first counts."""
    return {name: f"s{index}" for index, name in enumerate(dict.fromkeys(state.name for state in design.states))}


def use_ids(design: Design) -> dict[str, str]:
    return {alias: f"u{index}" for index, alias in enumerate(dict.fromkeys(use.alias for use in design.uses))}


def _layout_nodes(design: Design, only: Collection[str] | None) -> Iterator[LayoutNode]:
    ids = state_ids(design)
    # Graphviz breaks cycles where it finds them first: starting with the initial state puts it in front.
    for name in sorted(ids, key=lambda name: name != design.initial):
        if only is None or name in only:
            yield _layout_node(ids[name], name, state_size(name))
    if only is not None:
        return
    if shows_common(design):
        yield _layout_node(COMMON_ID, "every state", COMMON_SIZE)
    components = {use.alias: use.component for use in design.uses}
    for alias, id_ in use_ids(design).items():
        yield _layout_node(id_, alias, use_size(alias, components[alias]))


def _orient_edges(nodes: tuple[LayoutNode, ...], edges: list[LayoutEdge]) -> tuple[LayoutEdge, ...]:
    """One edge per pair, oriented away from the first node.

    Otherwise Graphviz ranks nodes by the longest path through cycles: 72 ranks for 100 states, which takes minutes and
    fits no screen. Distances from the initial state are small, and are what a reader expects.
    """
    transitions = [edge for edge in edges if edge.weight == _TRANSITION_WEIGHT]
    layers = _layers(nodes, transitions)
    # The badge of common transitions comes before all states, used components after them.
    order = {COMMON_ID: -1} | {id_: index for index, id_ in enumerate(layers) if id_ != COMMON_ID}
    if len(nodes) > _MAX_NODES_WITH_LAYER_EDGES:
        edges = [edge for edge in edges if edge.weight != _TRANSITION_WEIGHT or _crosses_layers(edge, layers)]
    merged: dict[tuple[str, str], LayoutEdge] = {}
    for edge in edges:
        source, target = sorted((edge.source, edge.target), key=order.__getitem__)
        merged.setdefault((source, target), replace(edge, source=source, target=target))
    return tuple(merged.values())


def _crosses_layers(edge: LayoutEdge, layers: dict[str, int]) -> bool:
    return layers[edge.source] != layers[edge.target]


def _layers(nodes: tuple[LayoutNode, ...], edges: list[LayoutEdge]) -> dict[str, int]:
    """Distances from the first node in breadth-first order; then from the next unvisited node."""
    leads: dict[str, list[str]] = {}
    for edge in edges:
        leads.setdefault(edge.source, []).append(edge.target)
    layers: dict[str, int] = {}
    for node in nodes:
        layers.setdefault(node.id, 0)
        waiting = [node.id] if layers[node.id] == 0 else []
        for id_ in waiting:
            news = [target for target in dict.fromkeys(leads.get(id_, ())) if target not in layers]
            layers |= dict.fromkeys(news, layers[id_] + 1)
            waiting += news
    return layers


def _layout_node(id_: str, label: str, size: Size) -> LayoutNode:
    return LayoutNode(id=id_, label=label, width=size.width, height=size.height)


def _transition_edges(design: Design) -> Iterator[LayoutEdge]:
    ids = {COMMON: COMMON_ID, **state_ids(design)}
    for drawn in draw_transitions(design):
        weight = _LINK_WEIGHT if drawn.source == COMMON else _TRANSITION_WEIGHT
        target = ids.get(drawn.target, "") if drawn.target != COMMON else ""
        width = _label_width(drawn.located.decision.guard)
        yield LayoutEdge(source=ids[drawn.source], target=target, weight=weight, label_width=width)


def _label_width(guard: Guard) -> float:
    label = guard.when or (f"{guard.after} s" if guard.after else "") or ("{ code }" if guard.code is not None else "")
    return min(_MAX_LABEL_WIDTH, estimate_text_width(label) * _LABEL_SCALE)


def _use_edges(design: Design) -> Iterator[LayoutEdge]:
    ids, aliases = state_ids(design), use_ids(design)
    for state in design.states:
        calls = (action.alias for action in state.all_actions if isinstance(action, Call))
        for alias in dict.fromkeys((*state.requires, *calls)):
            target = aliases.get(alias, "")
            yield LayoutEdge(source=ids[state.name], target=target, weight=_LINK_WEIGHT, may_share_rank=True)
