"""Drawings for pages: laid out where a design gives no place, every box and arrow a link, colours left to the page."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache, partial

from vicode.diagram.around import USED, USERS, around_figure
from vicode.diagram.drawing import draw_figure
from vicode.diagram.figure import Arrow, Figure, Node, figure_of
from vicode.diagram.layout import LayoutService
from vicode.diagram.palettes import from_properties
from vicode.diagram.svg import write_svg
from vicode.diagram.tree import Links, draw_tree
from vicode.diagram.usage import usage_figure
from vicode.docsite.addresses import Addresses, anchor_of
from vicode.docsite.memory import Memory
from vicode.findings import Path
from vicode.model.design import Decision, Design
from vicode.model.edits import move
from vicode.model.project import Project
from vicode.model.walks import walk_transitions

_SECONDS = 5.0


def laid_out(project: Project, service: LayoutService, memory: Memory) -> Project:
    """The project with a place for everything in the designs that give none; a place that is given stays."""
    if all(_has_places(design) for design in project.designs):
        return project
    designs = (memory.recall("places", design, partial(_with_places, design, service)) for design in project.designs)
    return replace(project, designs=tuple(designs))


def draw_design(design: Design, addresses: Addresses) -> str:
    """The state machine; states and arrows lead to where they are described, used components to their pages."""
    figure = figure_of(design)
    components = {use.alias: use.component for use in design.uses}
    things = {
        f"t:{'/'.join(map(str, located.path))}": addresses.thing(design.component, located.path)
        for located in walk_transitions(design)
    }

    def linked_node(node: Node) -> Node:
        kind, _colon, name = node.key.partition(":")
        if kind == "c":
            return replace(node, href=addresses.component(components[name]))
        path = ("states", name) if kind == "s" else ("common",)
        return replace(node, href=addresses.thing(design.component, path))

    def linked_arrow(arrow: Arrow) -> Arrow:
        if arrow.of == "transition":
            return replace(arrow, href=things.get(arrow.key, ""))
        state = arrow.target if arrow.of == "requires" else arrow.source
        return replace(arrow, href=addresses.thing(design.component, ("states", state.partition(":")[2])))

    # A component that no arrow leads to would only say that it is there, as the table of uses does.
    ends = {end for arrow in figure.arrows for end in (arrow.source, arrow.target)}
    nodes = tuple(linked_node(node) for node in figure.nodes if node.of != "component" or node.key in ends)
    arrows = tuple(map(linked_arrow, figure.arrows))
    return _svg(Figure(nodes=nodes, arrows=arrows), f"State machine of {design.component}")


def draw_decisions(items: Sequence[Decision], path: Path, design: Design, addresses: Addresses) -> tuple[str, bool]:
    """The decision tree of a state, or the common one, and whether a part of it is folded; "" for no decisions."""
    is_common = path[0] == "common"
    links = Links(
        condition=lambda path: addresses.thing(design.component, path),
        target=lambda name: addresses.thing(design.component, ("states", name)) if design.state(name) else "",
        last="what the state itself decides" if is_common else "stay",
        key=anchor_of,
        unit=design.time_unit,
    )
    title = "Decision tree of every state" if is_common else f"Decision tree of {path[1]}"
    drawing = draw_tree(items, path, title=title, links=links, palette=from_properties())
    if drawing is None:
        return "", False
    return write_svg(drawing, is_part=True), any(group.kind == "folded" for group in drawing.groups)


def draw_uses(project: Project, addresses: Addresses, title: str) -> str:
    """Who uses whom in a project or a part of one; an arrow leads to its user."""
    figure = usage_figure(project, sparse=True)
    nodes = tuple(replace(node, href=addresses.component(node.key)) for node in figure.nodes)
    return _svg(Figure(nodes=nodes, arrows=_linked_uses(figure, addresses)), title) if nodes else ""


def draw_around(design: Design, project: Project, addresses: Addresses) -> str:
    """A design with who uses it and what it uses; "" for one that is alone. An arrow leads to its user."""
    name = design.component
    figure = around_figure(project, name, addresses.has_design)
    if len(figure.nodes) == 1:
        return ""
    rest = {USERS: "#used-by", USED: "#uses"}
    nodes = tuple(
        node if node.key == name else replace(node, href=rest.get(node.key) or addresses.component(node.key))
        for node in figure.nodes
    )
    return _svg(Figure(nodes=nodes, arrows=_linked_uses(figure, addresses)), f"Neighbors of {name}")


def _linked_uses(figure: Figure, addresses: Addresses) -> tuple[Arrow, ...]:
    users = (arrow.target if arrow.of == "requires" else arrow.source for arrow in figure.arrows)
    return tuple(
        replace(arrow, href=f"{page}#uses" if (page := addresses.component(user)) else "#used-by")
        for arrow, user in zip(figure.arrows, users, strict=True)
    )


@lru_cache(maxsize=256)
def _svg(figure: Figure, title: str) -> str:
    return write_svg(draw_figure(figure, title=title, palette=from_properties()), is_part=True)


def _has_places(design: Design) -> bool:
    return not design.states or any(state.at for state in design.states)


def _with_places(design: Design, service: LayoutService) -> Design:
    if _has_places(design):
        return design
    places = service.lay_out(design, timeout_s=_SECONDS).placement
    common = places.common if design.common.transitions or design.common.actions else None
    return move(design, places.states, places.uses, common)
