"""What a drawing of a design shows, with finished texts and sizes: nodes, and arrows between them."""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from vicode.diagram.boxes import COMMON_SIZE, Size, size_of_state, size_of_use
from vicode.diagram.labels import Kind, kind_of, label_of, short_label
from vicode.diagram.lettering import NAME, SMALL, shorten
from vicode.diagram.placing import Placement, place
from vicode.model.design import COMMON, Call, Design, Point, State, Transition
from vicode.model.enabling import disabled_states, is_working
from vicode.model.walks import walk_transitions

_NAME_ROOM, _SECOND_ROOM = 230.0, 200.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A box: `of` is state, component or common; `marks` are words and counts for the row below the name.

    `href` is where a click leads, nothing for nowhere.
    """

    key: str
    of: str
    at: Point
    size: Size
    label: str
    title: str
    second: str = ""
    initial: bool = False
    final: bool = False
    disabled: bool = False
    marks: tuple[tuple[str, int], ...] = ()
    href: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """A transition or a link: `of` is transition, requires or modulates; `order` is 0 for one that is alone.

    `href` is where a click leads, nothing for nowhere.
    """

    key: str
    of: str
    source: str
    target: str
    title: str
    label: str = ""
    order: int = 0
    kind: Kind = Kind.ALWAYS
    disabled: bool = False
    label_at: Point | None = None
    href: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """Everything that is drawn; arrows only between nodes that are there."""

    nodes: tuple[Node, ...]
    arrows: tuple[Arrow, ...]


def figure_of(design: Design, *, only: Collection[str] | None = None, links: bool = True) -> Figure:
    """The figure of a design, or of these states and what they use."""
    arrows = (*_transitions(design), *(_links(design) if links else ()))
    nodes = tuple(_nodes(design, place(design)))
    if only is not None:
        wanted = {_state_key(name) for name in only}
        used = {arrow.source for arrow in arrows if arrow.of == "requires" and arrow.target in wanted}
        used |= {arrow.target for arrow in arrows if arrow.of == "modulates" and arrow.source in wanted}
        nodes = tuple(node for node in nodes if node.key in wanted | used)
    elif not links:
        nodes = tuple(node for node in nodes if node.of != "component")
    known = {node.key for node in nodes}
    return Figure(
        nodes=nodes, arrows=tuple(arrow for arrow in arrows if arrow.source in known and arrow.target in known)
    )


def _state_key(name: str) -> str:
    return f"s:{name}"


def _use_key(alias: str) -> str:
    return f"c:{alias}"


def _source_key(source: str) -> str:
    return "common" if source == COMMON else _state_key(source)


def _nodes(design: Design, placement: Placement) -> Iterator[Node]:
    for use in design.uses:
        yield Node(
            key=_use_key(use.alias),
            of="component",
            at=placement.uses[use.alias],
            size=size_of_use(use.alias, use.component),
            label=shorten(use.alias, NAME, _NAME_ROOM),
            second=shorten(use.component, SMALL, _SECOND_ROOM) if use.component != use.alias else "",
            title=f"{use.alias}: component {use.component}",
        )
    if design.common.transitions or design.common.actions:
        yield Node(
            key="common",
            of="common",
            at=placement.common,
            size=COMMON_SIZE,
            label="every state",
            title="\n".join(part for part in ("Common transitions of every state", design.common.doc) if part),
        )
    for state in design.states:
        yield _state(design, state, placement.states[state.name])


def _state(design: Design, state: State, at: Point) -> Node:
    return Node(
        key=_state_key(state.name),
        of="state",
        at=at,
        size=size_of_state(state.name),
        label=shorten(state.name, NAME, _NAME_ROOM),
        title="\n".join(part for part in (f"State {state.name}", state.doc) if part),
        initial=state.name == design.initial,
        final=state.final,
        disabled=state.disabled,
        marks=tuple(_marks(state)),
    )


def _marks(state: State) -> Iterator[tuple[str, int]]:
    called = {action.alias for action in state.all_actions if isinstance(action, Call)}
    works = any(not isinstance(action, Call) for action in state.actions)
    for name, flag in (("enter", bool(state.enter)), ("actions", works), ("leave", bool(state.leave))):
        if flag:
            yield name, 0
    for name, count in (("requires", len(state.requires)), ("modulates", len(called))):
        if count:
            yield name, count


def _transitions(design: Design) -> Iterator[Arrow]:
    all_of_them = list(walk_transitions(design))
    counts = Counter(located.source for located in all_of_them)
    orders: Counter[str] = Counter()
    off = disabled_states(design)
    for located in all_of_them:
        transition = located.decision
        assert isinstance(transition, Transition)
        orders[located.source] += 1
        source = "every state" if located.source == COMMON else located.source
        way = f"{source} → {transition.to}"
        yield Arrow(
            key="t:" + "/".join(map(str, located.path)),
            of="transition",
            source=_source_key(located.source),
            target=_state_key(transition.to),
            title="\n".join(part for part in (way, label_of(located, design.time_unit), transition.doc) if part),
            label=short_label(located, design.time_unit),
            order=orders[located.source] if counts[located.source] > 1 else 0,
            kind=kind_of(located),
            disabled=not is_working(located, off),
            label_at=transition.label_at,
        )


def _links(design: Design) -> Iterator[Arrow]:
    for state in design.states:
        calls = (action.alias for action in state.all_actions if isinstance(action, Call))
        for alias in dict.fromkeys(state.requires):
            key, title = f"requires/{state.name}/{alias}", f"{state.name} requires {alias}"
            yield Arrow(key=key, of="requires", source=_use_key(alias), target=_state_key(state.name), title=title)
        for alias in dict.fromkeys(calls):
            key, title = f"modulates/{state.name}/{alias}", f"{state.name} modulates {alias}"
            yield Arrow(key=key, of="modulates", source=_state_key(state.name), target=_use_key(alias), title=title)
