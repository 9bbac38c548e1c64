"""Diagrams of pages: nodes and edges are links, colors are CSS variables."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

from vicode.diagram.decision_tree import TreeLinks, render_decision_tree
from vicode.diagram.dependency_graph import dependency_diagram
from vicode.diagram.diagram_model import Diagram, DiagramEdge, DiagramNode, build_diagram
from vicode.diagram.drawn_transitions import shows_common
from vicode.diagram.folder_graph import folder_diagram
from vicode.diagram.layered_layout import NodeLayout
from vicode.diagram.layout import LayoutMethod, LayoutResult, LayoutService
from vicode.diagram.neighborhood import MORE_USED, MORE_USERS, neighborhood_diagram
from vicode.diagram.palettes import css_variable_palette
from vicode.diagram.render import render_diagram
from vicode.diagram.svg import write_svg
from vicode.docsite.build_cache import BuildCache, StoredForm
from vicode.docsite.shown_design import with_shown_names, with_shown_targets
from vicode.docsite.urls import SiteUrls, path_anchor
from vicode.findings import DesignPath
from vicode.model.design import Decision, Design
from vicode.model.edits import move_nodes
from vicode.model.project import Project
from vicode.model.traversal import iter_transitions

# Long, because the layout that replaces a late one would change the page.
_LAYOUT_TIMEOUT_S = 60.0


def add_missing_layouts(project: Project, service: LayoutService, memory: BuildCache) -> Project:
    """The project with computed layouts for the designs that have no positions."""
    if all(_has_layout(design) for design in project.designs):
        return project
    return replace(project, designs=tuple(_with_layout(design, service, memory) for design in project.designs))


def draw_design(design: Design, addresses: SiteUrls) -> str:
    """The state machine; nodes and edges link to their descriptions, used components to their pages."""
    shown = with_shown_names(design, addresses.names)
    figure = build_diagram(shown.design)
    components = {use.alias: use.component for use in shown.design.uses}
    things = {
        f"t:{'/'.join(map(str, drawn.path))}": addresses.design_path(design.component, located.path)
        for drawn, located in zip(iter_transitions(shown.design), iter_transitions(design), strict=True)
    }

    def linked_node(node: DiagramNode) -> DiagramNode:
        kind, _colon, name = node.key.partition(":")
        if kind == "c":
            return replace(node, href=addresses.component(components[name]))
        if kind == "n":
            return node
        path = ("states", shown.states[name]) if kind == "s" else ("common",)
        return replace(node, href=addresses.design_path(design.component, path))

    def linked_arrow(arrow: DiagramEdge) -> DiagramEdge:
        if arrow.edge_type == "transition":
            return replace(arrow, href=things.get(arrow.key, ""))
        state = arrow.target if arrow.edge_type == "requires" else arrow.source
        name = shown.states.get(state.partition(":")[2], "")
        return replace(arrow, href=addresses.design_path(design.component, ("states", name)))

    # Components without edges are only in the table of uses.
    ends = {end for arrow in figure.edges for end in (arrow.source, arrow.target)}
    nodes = tuple(linked_node(node) for node in figure.nodes if node.node_type != "component" or node.key in ends)
    arrows = tuple(map(linked_arrow, figure.edges))
    return _render_svg(
        replace(figure, nodes=nodes, edges=arrows), f"State machine of {addresses.names.component(design.component)}"
    )


def draw_decision_tree(
    items: Sequence[Decision], path: DesignPath, design: Design, addresses: SiteUrls
) -> tuple[str, bool]:
    """The decision tree of a state or of the common transitions, "" without decisions, and whether parts are folded."""
    is_common, shown = path[0] == "common", with_shown_names(design, addresses.names)
    links = TreeLinks(
        condition_href=lambda path: addresses.design_path(design.component, path),
        target_href=lambda name: (
            addresses.design_path(design.component, ("states", shown.states[name])) if name in shown.states else ""
        ),
        fallthrough_label="transitions of the state" if is_common else "stay",
        decision_key=path_anchor,
        time_unit=design.time_unit,
    )
    names = {name: drawn for drawn, name in shown.states.items()}
    title = "Decision tree of the common transitions" if is_common else f"Decision tree of {names.get(str(path[1]))}"
    drawing = render_decision_tree(
        with_shown_targets(items, names), path, title=title, links=links, palette=css_variable_palette()
    )
    if drawing is None:
        return "", False
    return write_svg(drawing, is_embedded=True), any(group.css_class == "folded" for group in drawing.groups)


def draw_dependencies(project: Project, addresses: SiteUrls, title: str) -> str:
    """The dependency diagram of a project or a part of it; edges link to the user."""
    figure = dependency_diagram(project, sparse=True)
    nodes = tuple(_linked_component(node, addresses, addresses.component(node.key)) for node in figure.nodes)
    return _render_svg(Diagram(nodes=nodes, edges=_linked_dependencies(figure, addresses)), title) if nodes else ""


def draw_folders(
    folders: Mapping[str, tuple[Design, ...]], anchors: Mapping[str, str], addresses: SiteUrls, title: str
) -> str:
    """The folders of a project; nodes and edges link to their lists of designs."""
    figure = folder_diagram(folders, addresses.names.design_kind)
    nodes = tuple(replace(node, href=f"#{anchors[node.key]}") for node in figure.nodes)
    edges = tuple(
        replace(edge, href=f"#{anchors[edge.target if edge.edge_type == 'requires' else edge.source]}")
        for edge in figure.edges
    )
    return _render_svg(Diagram(nodes=nodes, edges=edges), title)


def draw_neighborhood(design: Design, project: Project, addresses: SiteUrls) -> str:
    """A component with its users and used components, "" if there are none; edges link to the user."""
    name = design.component
    figure = neighborhood_diagram(project, name, addresses.has_design)
    if len(figure.nodes) == 1:
        return ""
    rest = {MORE_USERS: "#used-by", MORE_USED: "#uses"}
    nodes = tuple(
        _linked_component(
            node, addresses, "" if node.key == name else rest.get(node.key) or addresses.component(node.key)
        )
        for node in figure.nodes
    )
    return _render_svg(
        Diagram(nodes=nodes, edges=_linked_dependencies(figure, addresses)),
        f"Neighbors of {addresses.names.component(name)}",
    )


def _linked_component(node: DiagramNode, addresses: SiteUrls, href: str) -> DiagramNode:
    shown = addresses.names.component(node.key)
    if shown == node.key:
        return replace(node, href=href)
    return replace(node, href=href, label=shown, title=node.title.replace(node.key, shown, 1))


def _linked_dependencies(figure: Diagram, addresses: SiteUrls) -> tuple[DiagramEdge, ...]:
    users = (arrow.target if arrow.edge_type == "requires" else arrow.source for arrow in figure.edges)
    return tuple(
        replace(arrow, href=f"{page}#uses" if (page := addresses.component(user)) else "#used-by")
        for arrow, user in zip(figure.edges, users, strict=True)
    )


@lru_cache(maxsize=256)
def _render_svg(figure: Diagram, title: str) -> str:
    return write_svg(render_diagram(figure, title=title, palette=css_variable_palette()), is_embedded=True)


def _has_layout(design: Design) -> bool:
    return not design.states or any(state.at for state in design.states)


def _with_layout(design: Design, service: LayoutService, memory: BuildCache) -> Design:
    if _has_layout(design):
        return design
    compute = partial(service.compute, design, timeout_s=_LAYOUT_TIMEOUT_S)
    places = memory.get_or_create("layout", design, compute, _STORED_LAYOUT).layout
    common = places.common if shows_common(design) else None
    return move_nodes(design, places.states, places.uses, common)


def _encode_layout(result: LayoutResult) -> list[Any] | None:
    """A layout that replaces a late one is computed again."""
    layout = result.layout
    is_kept = result.method == LayoutMethod.GRAPHVIZ
    return [layout.states, layout.uses, layout.common, layout.notes] if is_kept else None


def _decode_layout(value: Any) -> LayoutResult:
    (states, uses, notes), (x, y) = map(_decode_points, (value[0], value[1], value[3])), value[2]
    layout = NodeLayout(states=states, uses=uses, common=(float(x), float(y)), notes=notes)
    return LayoutResult(layout=layout, method=LayoutMethod.GRAPHVIZ)


def _decode_points(value: Any) -> dict[str, tuple[float, float]]:
    return {str(name): (float(x), float(y)) for name, (x, y) in value.items()}


_STORED_LAYOUT = StoredForm(_encode_layout, _decode_layout)
