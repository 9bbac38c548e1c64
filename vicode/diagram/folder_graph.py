"""The folders of a large project as a diagram: a box per folder, an arrow where one uses components of another."""

from collections import defaultdict
from collections.abc import Mapping

from vicode.diagram.dependency_graph import component_uses, dependency_edges, place_in_columns
from vicode.diagram.diagram_model import Diagram, DiagramNode
from vicode.diagram.node_geometry import use_size
from vicode.diagram.text_metrics import NAME_FONT, shorten
from vicode.model.design import Design

_MAX_NAME_WIDTH = 230.0


def folder_diagram(folders: Mapping[str, tuple[Design, ...]], kind: str) -> Diagram:
    """The diagram of folders with their designs; `kind` is what a design is called."""
    owners = {design.component: name for name, designs in folders.items() for design in designs}
    kinds: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for name, designs in folders.items():
        for design in designs:
            for used, found in component_uses(design).items():
                other = owners.get(used, name)
                if other != name:
                    kinds[name][other] |= found
    uses = {name: {other: frozenset(found) for other, found in used.items()} for name, used in kinds.items()}
    positions = place_in_columns(list(folders), uses)
    nodes = []
    for name, designs in folders.items():
        count = f"{len(designs)} {kind}{'s' * (len(designs) != 1)}"
        nodes.append(
            DiagramNode(
                key=name,
                node_type="state",
                center=positions[name],
                size=use_size(name, count),
                label=shorten(name, NAME_FONT, _MAX_NAME_WIDTH),
                subtitle=count,
                title=name,
            )
        )
    return Diagram(nodes=tuple(nodes), edges=tuple(dependency_edges(uses, folders.keys())))
