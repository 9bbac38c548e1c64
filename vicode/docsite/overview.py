"""The pages about the whole project: home, agents, interfaces, types."""

import re
from collections.abc import Iterator

from vicode.docsite.addresses import AGENTS, EVERYTHING, INTERFACES, TYPES, Addresses, slug
from vicode.docsite.declarations import rows_of, tables_of
from vicode.docsite.docs import html_of, line_html_of, summary_of
from vicode.docsite.drawings import draw_uses
from vicode.docsite.findings import finding_rows
from vicode.docsite.linking import Linker, listed, plain
from vicode.docsite.subject import Subject
from vicode.docsite.uses import user_rows
from vicode.docsite.views import (
    AgentView,
    ComponentRow,
    DeclarationTable,
    EnumerationView,
    HomeView,
    InterfaceView,
    Line,
    Part,
)
from vicode.generators import collect_components
from vicode.model.design import Design
from vicode.model.project import Interface, Project
from vicode.model.walks import walk_transitions


def home_view(subject: Subject, addresses: Addresses) -> HomeView:
    """The first page."""
    project = subject.project
    linker = Linker(project, addresses)
    return HomeView(
        doc_html=html_of(project.doc),
        numbers=tuple(each for each in _numbers(project) if each[0]),
        svg=draw_uses(project, addresses, f"Who uses whom in {project.name}"),
        agents=tuple(
            (
                Part(text=agent.title or agent.name, href=addresses.agent(agent.name)),
                linker.component(agent.root),
                line_html_of(agent.doc),
            )
            for agent in project.agents
        ),
        components=tuple(_component_row(design, subject, linker) for design in sorted_designs(project)),
        findings=finding_rows(subject, addresses),
    )


def sorted_designs(project: Project) -> list[Design]:
    """The designs by name, numbers in names by their size."""
    return sorted(project.designs, key=lambda design: _by_name(design.component))


def interface_views(subject: Subject, addresses: Addresses) -> Iterator[InterfaceView]:
    """The components that have no design, by name."""
    project = subject.project
    linker = Linker(project, addresses)
    for each in sorted(project.components, key=lambda each: _by_name(each.component)):
        anchor = f"interface-{slug(each.component)}"
        yield InterfaceView(
            anchor=anchor,
            name=each.component,
            doc_html=html_of(each.doc),
            facts=tuple(_facts(each)),
            tables=tuple(tables_of(each, linker, f"{anchor}-")),
            used_by=tuple(user_rows(project, each.component, addresses)),
        )


def enumeration_views(project: Project) -> Iterator[EnumerationView]:
    """The types."""
    for each in project.enumerations:
        anchor = f"enum-{slug(each.name)}"
        yield EnumerationView(
            anchor=anchor,
            name=each.name,
            doc_html=html_of(each.doc),
            elements=tuple((f"{anchor}-{slug(name)}", name, line_html_of(doc)) for name, doc in each.elements),
        )


def constant_table(project: Project, addresses: Addresses) -> DeclarationTable:
    """The constants."""
    rows = rows_of(project.constants, Linker(project, addresses), "constant-")
    return DeclarationTable(title="Constants", initial="Value", rows=tuple(rows))


def agent_views(project: Project, addresses: Addresses) -> Iterator[AgentView]:
    """The agents, each with what it may activate."""
    linker = Linker(project, addresses)
    for agent in project.agents:
        designs = collect_components(project, (agent.root,)) if project.design(agent.root) else frozenset()
        used = {use.component for design in project.designs if design.component in designs for use in design.uses}
        reached = sorted({agent.root, *designs, *used}, key=_by_name)
        yield AgentView(
            anchor=f"agent-{slug(agent.name)}",
            name=agent.name,
            title=agent.title,
            doc_html=html_of(agent.doc),
            root=linker.component(agent.root),
            reaches=listed(linker.component(name) for name in reached),
            svg=draw_uses(project, addresses, f"What {agent.name} may activate", reached),
        )


def _by_name(name: str) -> tuple[list[str | int], str]:
    parts = re.split(r"([0-9]+)", name.casefold())
    return ([int(part) if index % 2 else part for index, part in enumerate(parts)], name)


def _numbers(project: Project) -> Iterator[tuple[int, Part]]:
    designs = project.designs
    states = sum(len(design.states) for design in designs)
    transitions = sum(1 for design in designs for _each in walk_transitions(design))
    yield len(project.agents), Part(text="agents", href=AGENTS)
    yield len(designs), Part(text="state machines", href="#components")
    yield states, Part(text="states", href=EVERYTHING)
    yield transitions, Part(text="transitions", href=EVERYTHING)
    yield len(project.components), Part(text="interfaces", href=INTERFACES)
    yield len(project.enumerations) + len(project.constants), Part(text="types and constants", href=TYPES)


def _component_row(design: Design, subject: Subject, linker: Linker) -> ComponentRow:
    return ComponentRow(
        component=linker.component(design.component),
        summary=summary_of(design.doc),
        states=len(design.states),
        transitions=sum(1 for _each in walk_transitions(design)),
        findings=sum(1 for each in subject.findings if each.component == design.component),
    )


def _facts(interface: Interface) -> Iterator[Line]:
    if interface.is_handed_on:
        yield plain("handed on to the world" if interface.implementation == "world" else "kept by vicode")
    elif interface.implementation:
        yield (Part(text="implemented by "), Part(text=interface.implementation, kind="code"))
    if interface.frequency_hz is not None:
        yield plain(f"works {interface.frequency_hz:g} times a second")
    if interface.xabsl_name:
        yield (Part(text="in XABSL "), Part(text=interface.xabsl_name, kind="code"))
