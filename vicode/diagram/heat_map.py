"""A diagram with the statistics of runs: states colored by their share of the time, with numbers."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from vicode.diagram.diagram_model import DiagramEdge, DiagramNode, build_diagram
from vicode.diagram.palettes import LIGHT
from vicode.diagram.primitives import VectorImage
from vicode.diagram.render import render_diagram
from vicode.diagram.transition_labels import GuardKind
from vicode.findings import DesignPath
from vicode.model.design import Design

_LEVELS = ((0.5, "red"), (0.2, "orange"), (0.05, "yellow"), (0.0, "blue"))
"""The share of the time from which a state has a color."""
_NEVER = "never"


@dataclass(frozen=True, slots=True, kw_only=True)
class StateHeat:
    """How often a state was entered, how long it was active in total and at most."""

    entries: int
    total_s: float
    longest_s: float


def render_heat_map(
    design: Design,
    states: Mapping[str, StateHeat],
    transitions: Mapping[DesignPath, int],
) -> VectorImage:
    """Render a design with the statistics of its states, and of its transitions by path."""
    diagram = build_diagram(replace(design, notes=()), links=False)
    whole_s = sum(each.total_s for each in states.values())
    counts = {"t:" + "/".join(map(str, path)): count for path, count in transitions.items()}
    nodes = tuple(_heated_node(node, states, whole_s) for node in diagram.nodes)
    edges = tuple(_counted_edge(edge, _sum_counts(edge, counts)) for edge in diagram.edges)
    return render_diagram(
        replace(diagram, nodes=nodes, edges=edges), title=f"{design.component}: states over time", palette=LIGHT
    )


def _sum_counts(edge: DiagramEdge, counts: Mapping[str, int]) -> int:
    return sum(counts.get(key, 0) for key in (edge.key, *edge.also))


def heat_color(share: float) -> str:
    """The color of a share from 0 to 1."""
    return next(name for least, name in _LEVELS if share >= least)


def _heated_node(node: DiagramNode, states: Mapping[str, StateHeat], whole_s: float) -> DiagramNode:
    if node.node_type != "state":
        return node
    heat = states.get(node.key.removeprefix("s:"))
    if heat is None or not heat.entries:
        return replace(node, color="", badges=(), subtitle=_NEVER, title=f"{node.title}\nnever entered")
    share = heat.total_s / whole_s if whole_s else 0.0
    color = heat_color(share)
    words = f"entered {heat.entries} times, {heat.total_s:.2f} s ({share:.0%}), longest {heat.longest_s:.2f} s"
    subtitle = f"{heat.entries}× {share:.0%}"
    return replace(node, color=color, badges=(), subtitle=subtitle, title=f"{node.title}\n{words}")


def _counted_edge(edge: DiagramEdge, count: int) -> DiagramEdge:
    words = f"taken {count} times" if count else "never taken"
    label = f"{count}×" if count else _NEVER
    kind = GuardKind.ALWAYS
    return replace(edge, label=label, order=0, guard_kind=kind, title=f"{edge.title}\n{words}")
