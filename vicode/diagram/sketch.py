"""A design as Graphviz needs it: boxes with sizes and arrows with weights, under ids that are safe everywhere."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

from vicode.diagram.boxes import COMMON_SIZE, Size, size_of_state, size_of_use, width_of
from vicode.model.design import COMMON, Call, Design, Guard, Transition
from vicode.model.walks import walk_transitions

COMMON_ID = "common"
_TRANSITION_WEIGHT, _LINK_WEIGHT = 8, 1
_WIDEST_LABEL = 150.0
# Beyond so many boxes arrows within a layer are left out: they cost more time than they improve.
_MANY = 150
# Labels are in smaller and lighter letters than names.
_LIGHT = 0.75


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A box; `label` is what a person calls it, any text."""

    id: str
    label: str
    width: float
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """One arrow for all from a box to another; heavy ones are kept short. `label_width` is of the first of them.

    `may_stand_beside`: the two may be in one rank, which spares used components ranks of their own.
    """

    source: str
    target: str
    weight: int
    label_width: float = 0.0
    may_stand_beside: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Sketch:
    """What is laid out; the first node stands first."""

    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]


def sketch_of(design: Design, only: Collection[str] | None = None) -> Sketch:
    """All of a design, or only these states and what goes on among them."""
    nodes = tuple(_nodes(design, only))
    known = {node.id for node in nodes}
    arrows = (*_transitions(design), *_links(design))
    edges = [edge for edge in arrows if edge.source in known and edge.target in known and edge.source != edge.target]
    return Sketch(nodes=nodes, edges=_point_onwards(nodes, edges))


def state_ids(design: Design) -> dict[str, str]:
    """The id of every state by its name; the first counts, should two have the same."""
    return {name: f"s{index}" for index, name in enumerate(dict.fromkeys(state.name for state in design.states))}


def use_ids(design: Design) -> dict[str, str]:
    """The id of every used component by its alias."""
    return {alias: f"u{index}" for index, alias in enumerate(dict.fromkeys(use.alias for use in design.uses))}


def _nodes(design: Design, only: Collection[str] | None) -> Iterator[Node]:
    ids = state_ids(design)
    # Graphviz breaks circles where it meets them first: beginning with the initial state puts that one in front.
    for name in sorted(ids, key=lambda name: name != design.initial):
        if only is None or name in only:
            yield _node(ids[name], name, size_of_state(name))
    if only is not None:
        return
    if design.common.transitions or design.common.actions:
        yield _node(COMMON_ID, "every state", COMMON_SIZE)
    components = {use.alias: use.component for use in design.uses}
    for alias, id_ in use_ids(design).items():
        yield _node(id_, alias, size_of_use(alias, components[alias]))


def _point_onwards(nodes: tuple[Node, ...], edges: list[Edge]) -> tuple[Edge, ...]:
    """One edge a pair, turned to point away from the first node.

    Left to itself Graphviz makes ranks of the longest way through the circles: 72 for 100 states, which takes
    minutes and fits no screen. Distances from the start are few, and are what a reader expects.
    """
    transitions = [edge for edge in edges if edge.weight == _TRANSITION_WEIGHT]
    layers = _layers(nodes, transitions)
    # The badge of common transitions comes before all states, used components come after them.
    order = {COMMON_ID: -1} | {id_: index for index, id_ in enumerate(layers) if id_ != COMMON_ID}
    if len(nodes) > _MANY:
        edges = [edge for edge in edges if edge.weight != _TRANSITION_WEIGHT or _crosses(edge, layers)]
    merged: dict[tuple[str, str], Edge] = {}
    for edge in edges:
        source, target = sorted((edge.source, edge.target), key=order.__getitem__)
        merged.setdefault((source, target), replace(edge, source=source, target=target))
    return tuple(merged.values())


def _crosses(edge: Edge, layers: dict[str, int]) -> bool:
    return layers[edge.source] != layers[edge.target]


def _layers(nodes: tuple[Node, ...], edges: list[Edge]) -> dict[str, int]:
    """The number of arrows from the first node, in the order in which nodes are met; then from the next one left."""
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


def _node(id_: str, label: str, size: Size) -> Node:
    return Node(id=id_, label=label, width=size.width, height=size.height)


def _transitions(design: Design) -> Iterator[Edge]:
    ids = {COMMON: COMMON_ID, **state_ids(design)}
    for located in walk_transitions(design):
        transition = located.decision
        assert isinstance(transition, Transition)
        weight = _LINK_WEIGHT if located.source == COMMON else _TRANSITION_WEIGHT
        target = ids.get(transition.to, "") if transition.to != COMMON else ""
        yield Edge(source=ids[located.source], target=target, weight=weight, label_width=_label_width(transition.guard))


def _label_width(guard: Guard) -> float:
    label = guard.when or (f"{guard.after} s" if guard.after else "") or ("{ code }" if guard.code is not None else "")
    return min(_WIDEST_LABEL, width_of(label) * _LIGHT)


def _links(design: Design) -> Iterator[Edge]:
    ids, aliases = state_ids(design), use_ids(design)
    for state in design.states:
        calls = (action.alias for action in state.all_actions if isinstance(action, Call))
        for alias in dict.fromkeys((*state.requires, *calls)):
            target = aliases.get(alias, "")
            yield Edge(source=ids[state.name], target=target, weight=_LINK_WEIGHT, may_stand_beside=True)
