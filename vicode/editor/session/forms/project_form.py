"""The forms of what project.yaml declares: enumerations, constants, hand-written components, agents."""

from collections.abc import Sequence
from typing import Any

from vicode.editor.session.forms.declaration_form import (
    adder_json,
    declaration_group,
    describe_declaration,
)
from vicode.editor.session.forms.fields import field_node, other_nodes
from vicode.editor.session.forms.item_place import ItemPlace
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import (
    AdderList,
    Card,
    Cards,
    Choice,
    FormPart,
    Group,
    Heading,
    ItemName,
    Node,
    Paragraph,
    Section,
    TextField,
)
from vicode.editor.session.project.interface_edits import shared_names
from vicode.model.design import Declaration
from vicode.model.edits import unique_name
from vicode.model.project import Agent, Enumeration, Interface, Project

SCOPE = Paragraph(text="Shared by all designs; saved immediately.", look="empty")
_COMPONENT_LISTS: tuple[tuple[AdderList, str, str], ...] = (
    ("outputs", "Outputs", "values other components can read"),
    ("variables", "Variables", "values other components can read and set"),
    ("parameters", "Parameters", "values set by the states that modulate this component"),
)


def project_place(ids: ListIds) -> ItemPlace:
    return ItemPlace(path=("project",), ids=ids)


def project_section(project: Project) -> Section:
    """The section of the design's form; its content is shared by all designs."""
    parts = (
        ("enumeration", project.enumerations),
        ("constant", project.constants),
        ("component", project.components),
        ("agent", project.agents),
    )
    counts = (f"{len(nodes)} {noun}{'s' * (len(nodes) != 1)}" for noun, nodes in parts if nodes)
    return Section(
        key="project",
        title=f"Project {project.name}",
        caption=", ".join(counts) or "nothing declared",
        nodes=(FormPart(form="project/"),),
    )


def project_parts(project: Project, ids: ListIds) -> dict[str, tuple[Node, ...]]:
    """The parts that several forms show: that of the project, and those of its components."""
    here = project_place(ids)
    components = {
        place.key: component_nodes(place, component)
        for place, component in here.items("components", project.components)
    }
    return {"project/": _project_nodes(here, project), **components}


def _project_nodes(here: ItemPlace, project: Project) -> tuple[Node, ...]:
    fields = (field_node(project, name, here.path, is_committed=True) for name in ("name", "doc", "languages", "world"))
    enumerations = [
        (place, _enumeration(place, each)) for place, each in here.items("enumerations", project.enumerations)
    ]
    constants = [
        (place, declaration_group(place, each, is_shared=True))
        for place, each in here.items("constants", project.constants)
    ]
    components = [
        (place, _component_line(place, each, FormPart(form=place.key)))
        for place, each in here.items("components", project.components)
    ]
    agents = [(place, _agent(place, each)) for place, each in here.items("agents", project.agents)]
    return (
        SCOPE,
        *fields,
        *other_nodes(project, here.path, is_committed=True),
        Heading(text="Enumerations", hint="types with named values"),
        _cards(here, "enumerations", enumerations, "the project"),
        Heading(text="Constants", hint="values available in all designs"),
        _cards(here, "constants", constants, "the project"),
        Heading(text="Hand-written components", hint="components without a design"),
        _cards(here, "components", components, "the project"),
        Heading(text="Agents", hint="entry points for running the project"),
        _cards(here, "agents", agents, "the project"),
    )


def _cards(
    place: ItemPlace, section: AdderList, nodes: Sequence[tuple[ItemPlace, Group | Section]], owner: str
) -> Cards:
    cards = (Card(id=each.id, title=node.title, nodes=(node,)) for each, node in nodes)
    noun = section.removesuffix("s")
    return Cards(path=place.within(section), cards=tuple(cards), adders=section, noun=noun, owner=owner)


def declaration_lines(place: ItemPlace, component: Interface, section: AdderList, prefix: str = "") -> Cards:
    """The declarations of a component, one line each until a user opens it.

    `prefix` precedes their names where they stand without their component, and nothing can be added.
    """
    declarations: tuple[Declaration, ...] = getattr(component, section)
    cards = (
        Card(id=each.id, title=declaration.name, nodes=(_line(each, declaration, prefix),))
        for each, declaration in place.items(section, declarations)
    )
    return Cards(
        path=place.within(section),
        cards=tuple(cards),
        adders="" if prefix else _ADDERS[section],
        noun=section.removesuffix("s"),
    )


def _line(place: ItemPlace, declaration: Declaration, prefix: str = "") -> Section:
    return Section(
        key=f"{prefix} {place.key}",
        title=prefix + declaration.name,
        caption=describe_declaration(declaration),
        nodes=(declaration_group(place, declaration, is_shared=True),),
        look="line",
    )


def component_nodes(place: ItemPlace, component: Interface) -> tuple[Node, ...]:
    """The form of a component without a design."""
    lists: list[Node] = []
    for section, title, hint in _COMPONENT_LISTS:
        lists += [Heading(text=title, hint=hint), declaration_lines(place, component, section)]
    names = ("frequency_hz", "implementation", "title", "doc", "xabsl_name")
    fields: tuple[Node, ...] = (
        ItemName(path=place.within("name"), label="Name", value=component.component),
        *(field_node(component, name, place.path, is_committed=True, is_wide=name != names[0]) for name in names),
        *other_nodes(component, place.path, is_committed=True),
    )
    group = Group(path=place.path, noun="component", title=component.component, look="shared", nodes=fields)
    return (group, *lists)


def _component_line(place: ItemPlace, component: Interface, *nodes: Node) -> Section:
    return Section(
        key=f"/{place.key}", title=component.component, caption=component.implementation, nodes=nodes, look="line"
    )


def _agent(place: ItemPlace, agent: Agent) -> Group:
    nodes = (
        ItemName(path=place.within("name"), label="Agent", value=agent.name),
        Choice(path=place.within("root"), label="Root", value=agent.root, options="components"),
        field_node(agent, "title", place.path, is_committed=True),
        field_node(agent, "xabsl_name", place.path, is_committed=True),
        field_node(agent, "doc", place.path, is_committed=True, is_wide=True),
        *other_nodes(agent, place.path, is_committed=True),
    )
    return Group(path=place.path, noun="agent", title=agent.name, look="shared", nodes=nodes)


def _enumeration(place: ItemPlace, enumeration: Enumeration) -> Group:
    elements = list(place.items("elements", enumeration.elements))
    nodes = (
        ItemName(path=place.within("name"), label="Enumeration", value=enumeration.name),
        field_node(enumeration, "xabsl_name", place.path, is_committed=True),
        field_node(enumeration, "doc", place.path, is_committed=True, is_wide=True),
        field_node(enumeration, "internal", place.path, is_wide=True),
        *other_nodes(enumeration, place.path, is_committed=True),
        _cards(place, "elements", [(each, _element(each, element)) for each, element in elements], enumeration.name),
        _names_in_xabsl(place, enumeration, [each for each, _element in elements]),
    )
    return Group(path=place.path, noun="enumeration", title=enumeration.name, look="shared", nodes=nodes)


def _element(place: ItemPlace, element: tuple[str, str]) -> Group:
    number = f" {int(place.at[-1]) + 1}" if place.at else ""
    nodes = (
        ItemName(path=place.within("name"), label=f"Element{number}", value=element[0]),
        field_node(element, "doc", place.path, is_committed=True),
    )
    return Group(
        path=place.path, noun="element", title=element[0], look="element", nodes=nodes, can_move_up=not place.is_first
    )


def _names_in_xabsl(place: ItemPlace, enumeration: Enumeration, elements: list[ItemPlace]) -> Section:
    names = dict(enumeration.xabsl_elements)
    fields = (
        TextField(
            path=element.within("xabsl"),
            label=f"Element {number} in XABSL",
            value=names.get(name, ""),
            is_code=True,
            is_committed=True,
        )
        for number, (element, name) in enumerate(zip(elements, enumeration.element_names, strict=True), start=1)
    )
    caption = "; ".join(f"{name}: {other}" for name, other in names.items()) or "names in XABSL"
    return Section(key=place.key, title="Elements in XABSL", caption=caption, nodes=tuple(fields), look="more")


def project_adders(project: Project) -> dict[AdderList, Any]:
    """What can be added to project.yaml, as JSON values."""
    taken = shared_names(project)
    kind, component = unique_name("Kind", taken), Interface(component=unique_name("Component", taken))
    constant = Declaration(name=unique_name("constant", taken), initial="0")
    agent = Agent(name=unique_name("agent", {each.name for each in project.agents}), root="")
    place = ItemPlace()
    lines = {
        adders: adder_json("Add", _line(ItemPlace(section=section), Declaration(name="", type="float")))
        for section, adders in _ADDERS.items()
    }
    enumeration = _enumeration(place, Enumeration(name=kind, elements=(("first", ""),)))
    line = _component_line(place, component, *component_nodes(place, component))
    return {
        "enumerations": adder_json("Enumeration", enumeration, kind),
        "elements": adder_json("Element", _element(ItemPlace(section="elements"), ("", ""))),
        "constants": adder_json(
            "Constant",
            declaration_group(ItemPlace(section="constants"), constant, is_shared=True),
            constant.name,
        ),
        "components": adder_json("Component", line, component.component),
        "agents": adder_json("Agent", _agent(place, agent), agent.name),
        **lines,
    }


_ADDERS: dict[AdderList, AdderList] = {
    "outputs": "component-outputs",
    "variables": "component-variables",
    "parameters": "component-parameters",
}
