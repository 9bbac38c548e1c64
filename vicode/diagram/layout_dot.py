"""A layout graph as DOT text, written with the `graphviz` package; deterministic."""

from enum import StrEnum

import graphviz  # type: ignore[import-untyped]

from vicode.diagram.layout_graph import LayoutCluster, LayoutGraph, LayoutNode

POINTS_PER_INCH = 72.0
_MAX_LABEL_LENGTH = 24


class RankDirection(StrEnum):
    """The direction of the edges, as Graphviz names it."""

    RIGHT = "LR"
    DOWN = "TB"


class LayoutEffort(StrEnum):
    """How much work Graphviz spends on a layout."""

    FULL = "full"
    BOUNDED = "bounded"
    QUICK = "quick"


_LIMITS = {
    LayoutEffort.FULL: {},
    LayoutEffort.BOUNDED: {"nslimit": "1", "nslimit1": "1"},
    LayoutEffort.QUICK: {"nslimit": "0.1", "nslimit1": "0.1", "mclimit": "0.1"},
}
# Pixels between neighbors of a rank and between ranks; the canvas routes edges there. An edge that passes a
# rank takes as much space, so wide gaps between neighbors cost more than they show.
_NODE_GAP = 30.0
_RANK_GAP = 70.0
# Next to a label, 30 pixels of its edge remain; the canvas shortens labels to the available space.
# Room for the border and the title of a frame.
_CLUSTER_MARGIN = 52
_LABEL_MARGIN, _MAX_RANK_GAP = 30.0, 110.0


def write_layout_dot(layout_graph: LayoutGraph, direction: RankDirection, effort: LayoutEffort) -> str:
    """The DOT text: boxes of fixed size, one edge per pair, no routes (the canvas routes)."""
    graph = graphviz.Digraph(
        graph_attr={
            "rankdir": str(direction),
            "splines": "none",
            "nodesep": _inches(_NODE_GAP),
            "ranksep": _inches(_rank_gap(layout_graph, direction)),
            **_LIMITS[effort],
        },
        node_attr={"shape": "box", "fixedsize": "true", "fontsize": "10"},
    )
    for node in layout_graph.nodes:
        _write_node(graph, node)
    _write_clusters(graph, layout_graph.clusters)
    for edge in layout_graph.edges:
        beside = {"minlen": "0"} if edge.may_share_rank else {}
        graph.edge(edge.source, edge.target, weight=str(edge.weight), **beside)
    return str(graph.source)


def _write_clusters(graph: graphviz.Digraph, clusters: tuple[LayoutCluster, ...], prefix: str = "") -> None:
    for index, cluster in enumerate(clusters):
        name = f"{prefix}{index}"
        with graph.subgraph(name=f"cluster_{name}", graph_attr={"margin": str(_CLUSTER_MARGIN)}) as inner:
            for node in cluster.nodes:
                inner.node(node)
            _write_clusters(inner, cluster.clusters, f"{name}_")


def _rank_gap(graph: LayoutGraph, direction: RankDirection) -> float:
    # Graphviz labels cost minutes at 150 states and stretch ranks; a wider rank separation holds them as well.
    if direction is RankDirection.DOWN:
        return _RANK_GAP
    return min(_MAX_RANK_GAP, max((_RANK_GAP, *(edge.label_width + _LABEL_MARGIN for edge in graph.edges))))


def _write_node(graph: graphviz.Digraph, node: LayoutNode) -> None:
    graph.node(node.id, label=_escape(node.label), width=_inches(node.width), height=_inches(node.height))


def _inches(pixels: float) -> str:
    return f"{pixels / POINTS_PER_INCH:.4f}"


def _escape(text: str) -> str:
    """One line of printable characters without Graphviz markup."""
    line = "".join(letter if letter.isprintable() else "\ufffd" for letter in " ".join(text.split()))
    # `escape` marks its result; a plain string in <> would be written as markup.
    escaped: str = graphviz.escape(line if len(line) <= _MAX_LABEL_LENGTH else line[: _MAX_LABEL_LENGTH - 1] + "…")
    return escaped
