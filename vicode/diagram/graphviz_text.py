"""A design as DOT with labels and styles for Graphviz; `neato -n` keeps the positions."""

from collections.abc import Collection, Iterable, Mapping

import graphviz  # type: ignore[import-untyped]

from vicode.diagram.diagram_model import DiagramNode, build_diagram
from vicode.diagram.frames import FrameGroup, nest_frames
from vicode.diagram.palettes import LIGHT
from vicode.diagram.text_transitions import describe_dangling_transitions, list_transitions
from vicode.model.design import COMMON, Design

_POINTS_PER_PIXEL = 0.75
_SHAPES = {
    "state": {"shape": "box", "style": "rounded"},
    "component": {"shape": "hexagon", "style": "dashed"},
    "common": {"shape": "box", "style": "rounded,dashed"},
    "note": {"shape": "note"},
}
_USE_EDGES = {"requires": {"style": "dashed", "arrowhead": "empty"}, "modulates": {"style": "dotted"}}


def write_graphviz(design: Design, *, only: Collection[str] | None = None, links: bool = True) -> str:
    """The text of the whole design, or of some states and the components they use."""
    diagram = build_diagram(design, only=only, links=links)
    ids = {node.key: f"n{index}" for index, node in enumerate(diagram.nodes)}
    graph = graphviz.Digraph(
        name=_quoted(design.component), graph_attr={"rankdir": "LR"}, node_attr={"fontname": "Helvetica"}
    )
    texts = {f"n:{note.name}": note.text for note in design.notes}
    for node in diagram.nodes:
        label = _quoted(texts[node.key]) if node.key in texts else _quoted(_unshortened_label(node))
        graph.node(ids[node.key], label=label, **_attributes(node))
        if node.initial:
            corner = (node.center[0] - node.size.width / 2, node.center[1] - node.size.height / 2)
            graph.node("start", label="", shape="point", width="0.15", pos=_position(corner[0] - 12, corner[1] - 20))
            graph.edge("start", ids[node.key])
    _write_frames(graph, nest_frames(design, only), ids, design)
    for line in list_transitions(design, only):
        ends = ["common" if end == COMMON else f"s:{end}" for end in (line.source, line.target)]
        if all(end in ids for end in ends):
            graph.edge(*(ids[end] for end in ends), label=_quoted(line.label))
    for edge in diagram.edges:
        if edge.edge_type in _USE_EDGES:
            graph.edge(ids[edge.source], ids[edge.target], **_USE_EDGES[edge.edge_type])
    lost = "".join(f"// {words}\n" for words in describe_dangling_transitions(design, only))
    return lost + str(graph.source)


def _write_frames(
    graph: graphviz.Digraph, groups: Iterable[FrameGroup], ids: Mapping[str, str], design: Design, prefix: str = ""
) -> None:
    for index, group in enumerate(groups):
        frame = design.frame(group.name)
        fill = {"style": "filled", "fillcolor": getattr(LIGHT, f"color_{frame.color}")} if frame and frame.color else {}
        name = f"{prefix}{index}"
        with graph.subgraph(name=f"cluster_{name}", graph_attr={"label": _quoted(group.name), **fill}) as cluster:
            for state in design.states:
                if state.name in group.own_states:
                    cluster.node(ids[f"s:{state.name}"])
            _write_frames(cluster, group.groups, ids, design, f"{name}_")


def _attributes(node: DiagramNode) -> dict[str, str]:
    attributes = {**_SHAPES[node.node_type], "pos": _position(*node.center)}
    return attributes | ({"peripheries": "2"} if node.final else {})


def _position(x: float, y: float) -> str:
    """A fixed position in points, y upwards, from one in pixels."""
    return f"{x * _POINTS_PER_PIXEL:.1f},{-y * _POINTS_PER_PIXEL:.1f}!"


def _unshortened_label(node: DiagramNode) -> str:
    """The full name; the diagram may have shortened it."""
    return node.key.partition(":")[2] or node.label


def _quoted(text: str) -> str:
    line = "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(text.split()))
    # `escape` marks its result; a plain string in <> would be written as markup.
    escaped: str = graphviz.escape(line)
    return escaped
