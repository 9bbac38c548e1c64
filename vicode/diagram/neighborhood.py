"""One component with its users on the left and the components it uses on the right, as a diagram."""

from collections.abc import Callable, Iterator, Mapping, Sequence

from vicode.diagram.dependency_graph import UsesByComponent, component_uses, dependency_edges
from vicode.diagram.diagram_model import Diagram, DiagramEdge, DiagramNode
from vicode.diagram.node_geometry import Size, use_size
from vicode.diagram.text_metrics import NAME_FONT, shorten
from vicode.model.design import Point
from vicode.model.project import Project

MORE_USERS, MORE_USED = "more:users", "more:used"
"""Keys of the boxes that stand for omitted components on each side."""

_COLUMN_GAP, _ROW_HEIGHT, _HEIGHT = 150.0, 52.0, 40.0
_MAX_ROWS = 12
_MAX_NAME_WIDTH = 230.0


def neighborhood_diagram(project: Project, name: str, has_design: Callable[[str], bool]) -> Diagram:
    """The diagram of a design and its neighbors, without hand-written components that are only read from."""
    uses = _uses_with(project, name, has_design)
    users = _shown_labels(sorted(uses.keys() - {name}, key=str.casefold), MORE_USERS)
    used = _shown_labels(sorted(uses.get(name, {}).keys() - uses.keys(), key=str.casefold), MORE_USED)
    labels = {name: name} | users | used
    positions = {name: (0.0, 0.0), **dict(_column_positions(name, users, -1)), **dict(_column_positions(name, used, 1))}
    nodes = tuple(
        DiagramNode(
            key=key,
            node_type="state" if key == name or key in (MORE_USERS, MORE_USED) or has_design(key) else "component",
            center=positions[key],
            size=_size(label),
            label=shorten(label, NAME_FONT, _MAX_NAME_WIDTH),
            title=_title(project, label),
        )
        for key, label in labels.items()
    )
    return Diagram(
        nodes=nodes, edges=(*dependency_edges(_uses_among(uses, labels), labels), *_more_edges(name, labels))
    )


def _uses_with(project: Project, name: str, has_design: Callable[[str], bool]) -> UsesByComponent:
    uses: dict[str, dict[str, frozenset[str]]] = {}
    for design in project.designs:
        found = {
            used: kinds
            for used, kinds in component_uses(design).items()
            if (kinds or has_design(used)) and name in (used, design.component)
        }
        if found:
            uses[design.component] = found
    return uses


def _shown_labels(names: Sequence[str], rest: str) -> dict[str, str]:
    """Labels by key: all names, or the first ones and the number of the rest."""
    if len(names) <= _MAX_ROWS:
        return {name: name for name in names}
    kept = names[: _MAX_ROWS - 1]
    return {name: name for name in kept} | {rest: f"{len(names) - len(kept)} more"}


def _uses_among(uses: UsesByComponent, labels: Mapping[str, str]) -> UsesByComponent:
    return {user: used for user, used in uses.items() if user in labels}


def _more_edges(name: str, labels: Mapping[str, str]) -> Iterator[DiagramEdge]:
    for key, ends in ((MORE_USERS, (MORE_USERS, name)), (MORE_USED, (name, MORE_USED))):
        if key in labels:
            yield DiagramEdge(key=key, edge_type="transition", source=ends[0], target=ends[1], title=labels[key])


def _column_positions(name: str, others: Mapping[str, str], side: int) -> Iterator[tuple[str, Point]]:
    """Yield the center of each box of a column; the boxes are aligned on the side that faces the middle."""
    edge = _size(name).width / 2 + _COLUMN_GAP
    for row, (key, label) in enumerate(others.items()):
        yield key, (side * (edge + _size(label).width / 2), (row - (len(others) - 1) / 2) * _ROW_HEIGHT)


def _size(label: str) -> Size:
    return Size(width=use_size(label, "").width, height=_HEIGHT)


def _title(project: Project, name: str) -> str:
    interface = project.interface(name)
    doc = " ".join(interface.doc.split()) if interface else ""
    return "\n".join(part for part in (name, doc) if part)
