"""The dependency graph of a project: components in columns by depth, as a diagram."""

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping

from vicode.diagram.diagram_model import Diagram, DiagramEdge, DiagramNode
from vicode.diagram.node_geometry import use_size
from vicode.diagram.text_metrics import NAME_FONT, shorten
from vicode.model.design import Call, Design, Point
from vicode.model.project import Project

_COLUMN_GAP, _ROW_HEIGHT = 110.0, 90.0
_MAX_NAME_WIDTH = 230.0
_SWEEPS = 4
_MAX_EDGES = 150

UsesByComponent = Mapping[str, Mapping[str, frozenset[str]]]
"""By user and used component: "requires", "modulates", neither or both."""


def dependency_diagram(
    project: Project, href_for: Callable[[str], str] = lambda _component: "", *, sparse: bool = False
) -> Diagram:
    """All components that use others or are used.

    Args:
        project: the project.
        href_for: the link of a component.
        sparse: omit components that are only read from, if the graph has too many edges (see `has_omitted_uses`).
    """
    uses = _project_uses(project)
    if sparse and has_omitted_uses(project):
        uses = _without_read_only(uses, {design.component for design in project.designs})
    shown = [name for name in project.interfaces() if name in uses or any(name in used for used in uses.values())]
    shown += [design.component for design in project.designs if design.component not in shown]
    positions = place_in_columns(shown, uses)
    roots = {agent.root for agent in project.agents}
    return Diagram(
        nodes=tuple(_diagram_node(project, name, positions[name], href_for, is_root=name in roots) for name in shown),
        edges=tuple(dependency_edges(uses, set(shown))),
    )


def has_omitted_uses(project: Project) -> bool:
    """Whether the sparse diagram of a project omits uses: there are many edges, some to components that are only read
    from.
    """
    uses = _project_uses(project)
    count = sum(max(1, len(kinds)) for used in uses.values() for kinds in used.values())
    designs = {design.component for design in project.designs}
    return count > _MAX_EDGES and _without_read_only(uses, designs) != uses


def _without_read_only(uses: UsesByComponent, designs: Collection[str]) -> UsesByComponent:
    """The uses without hand-written components that are neither required nor modulated."""
    return {
        user: {name: kinds for name, kinds in used.items() if kinds or name in designs} for user, used in uses.items()
    }


def _project_uses(project: Project) -> UsesByComponent:
    return {design.component: found for design in project.designs if (found := component_uses(design))}


def component_uses(design: Design) -> Mapping[str, frozenset[str]]:
    components = {use.alias: use.component for use in design.uses}
    kinds: dict[str, set[str]] = {component: set() for component in components.values()}
    actions = [*design.common.actions, *(action for state in design.states for action in state.all_actions)]
    for state in design.states:
        for alias in state.requires:
            kinds.get(components.get(alias, ""), set()).add("requires")
    for action in actions:
        if isinstance(action, Call):
            kinds.get(components.get(action.alias, ""), set()).add("modulates")
    return {component: frozenset(found) for component, found in kinds.items()}


def _diagram_node(
    project: Project, name: str, at: Point, address_of: Callable[[str], str], *, is_root: bool
) -> DiagramNode:
    design = project.design(name)
    interface = project.interface(name)
    count = len(design.states) if design else 0
    second = f"{count} state{'s' * (count != 1)}" if design else "hand-written"
    doc = " ".join(interface.doc.split()) if interface else ""
    return DiagramNode(
        key=name,
        node_type="state" if design else "component",
        center=at,
        size=use_size(name, second),
        label=shorten(name, NAME_FONT, _MAX_NAME_WIDTH),
        subtitle=second,
        title="\n".join(part for part in (name, doc) if part),
        initial=is_root,
        href=address_of(name) if design else "",
    )


def dependency_edges(uses: UsesByComponent, shown: Collection[str]) -> Iterator[DiagramEdge]:
    for user, found in uses.items():
        for used, kinds in found.items():
            if used not in shown:
                continue
            for kind in sorted(kinds) or ["uses"]:
                # As in a design: required components point to their user, modulated ones are controlled by it.
                source, target = (used, user) if kind == "requires" else (user, used)
                of = "transition" if kind == "uses" else kind
                yield DiagramEdge(
                    key=f"{kind}/{user}/{used}",
                    edge_type=of,
                    source=source,
                    target=target,
                    title=f"{user} {kind} {used}",
                )


def place_in_columns(names: list[str], uses: UsesByComponent) -> dict[str, Point]:
    """Columns by depth; rows such that users and used components are close to each other."""
    depths = _depths(names, uses)
    columns: dict[int, list[str]] = defaultdict(list)
    for name in names:
        columns[depths[name]].append(name)
    neighbors = _neighbors(uses)
    for _sweep in range(_SWEEPS):
        for depth in sorted(columns):
            rows = {name: row - len(column) / 2 for column in columns.values() for row, name in enumerate(column)}
            columns[depth].sort(key=lambda name: _barycenter(rows, name, neighbors[name]))
    positions: dict[str, Point] = {}
    left = 0.0
    for depth in sorted(columns):
        width = max(use_size(name, "hand-written").width for name in columns[depth])
        for row, name in enumerate(columns[depth]):
            positions[name] = (left + width / 2, (row - (len(columns[depth]) - 1) / 2) * _ROW_HEIGHT)
        left += width + _COLUMN_GAP
    return positions


def _depths(names: list[str], uses: UsesByComponent) -> dict[str, int]:
    """The longest path from a component without users; a cycle is cut at the edge that closes it."""
    used_by_others = {used for user, found in uses.items() for used in found if used != user}
    onwards: dict[str, list[str]] = defaultdict(list)
    seen, is_open, order = set[str](), set[str](), list[str]()
    for start in sorted(names, key=lambda name: name in used_by_others):
        waiting = [(start, iter(uses.get(start, ())))] if start not in seen else []
        seen.add(start)
        is_open.add(start)
        while waiting:
            name, rest = waiting[-1]
            used = next(rest, None)
            if used is None:
                order.append(name)
                is_open.discard(name)
                waiting.pop()
            elif used not in is_open:
                onwards[name].append(used)
                if used not in seen:
                    seen.add(used)
                    is_open.add(used)
                    waiting.append((used, iter(uses.get(used, ()))))
    depths = dict.fromkeys(order, 0)
    for name in reversed(order):
        for used in onwards[name]:
            depths[used] = max(depths[used], depths[name] + 1)
    return depths


def _neighbors(uses: UsesByComponent) -> Mapping[str, set[str]]:
    neighbors: dict[str, set[str]] = defaultdict(set)
    for user, found in uses.items():
        for used in found:
            neighbors[user].add(used)
            neighbors[used].add(user)
    return neighbors


def _barycenter(rows: Mapping[str, float], name: str, neighbors: set[str]) -> float:
    found = [rows[each] for each in neighbors if each in rows]
    return sum(found) / len(found) if found else rows[name]
