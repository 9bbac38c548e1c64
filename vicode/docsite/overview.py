"""The pages about the whole project: home and agents."""

from collections.abc import Iterator
from dataclasses import replace

from vicode.diagram.usage import leaves_out
from vicode.docsite.addresses import AGENTS, EVERYTHING, INTERFACES, SYMBOLS, TYPES, Addresses
from vicode.docsite.docs import html_of, line_html_of, summary_of
from vicode.docsite.drawings import draw_uses
from vicode.docsite.findings import finding_groups, finding_rows
from vicode.docsite.interfaces import symbol_count
from vicode.docsite.linking import Linker, listed
from vicode.docsite.ordering import by_name, sorted_designs
from vicode.docsite.subject import Subject
from vicode.docsite.views import AgentRow, AgentView, ComponentRow, HomeView, Part, ReachedRow
from vicode.generators import collect_components
from vicode.model.design import Design
from vicode.model.project import Agent, Project
from vicode.model.walks import walk_transitions


def home_view(subject: Subject, addresses: Addresses, svg: str = "") -> HomeView:
    """The first page, with the map of who uses whom."""
    project = subject.project
    linker = Linker(project, addresses)
    return HomeView(
        doc_html=html_of(project.doc),
        numbers=tuple(_number(count, word, href) for count, word, href in _numbers(subject) if count),
        svg=svg,
        is_sparse=leaves_out(project) and symbol_count(project) > 0,
        agents=tuple(agent_rows(project, addresses)),
        components=tuple(_component_row(design, subject, linker) for design in sorted_designs(project)),
        findings=finding_groups(finding_rows(subject, addresses)),
    )


def agent_rows(project: Project, addresses: Addresses) -> Iterator[AgentRow]:
    """The agents as a list."""
    linker = Linker(project, addresses)
    for agent in project.agents:
        yield AgentRow(
            agent=Part(text=agent.title or agent.name, href=addresses.agent(agent.name)),
            name=agent.name,
            root=linker.component(agent.root),
            machines=len(_reached(project, agent)),
            doc_html=line_html_of(agent.doc),
        )


def agent_view(project: Project, agent: Agent, addresses: Addresses) -> AgentView:
    """An agent with what it may activate."""
    linker = Linker(project, addresses)
    # A drawing of its own: among the places of the whole it would be lost.
    part = replace(project, agents=(agent,), designs=_reached(project, agent))
    names = {design.component for design in part.designs}
    used = {use.component for design in part.designs for use in design.uses} | {agent.root}
    return AgentView(
        name=agent.name,
        title=agent.title,
        doc_html=html_of(agent.doc),
        root=linker.component(agent.root),
        machines=tuple(
            ReachedRow(
                component=linker.component(design.component), summary=summary_of(design.doc), states=len(design.states)
            )
            for design in sorted_designs(part)
        ),
        others=listed(linker.component(name) for name in sorted(used - names, key=by_name)),
        svg=draw_uses(part, addresses, f"What {agent.name} may activate"),
        is_sparse=leaves_out(part) and symbol_count(project) > 0,
    )


def _reached(project: Project, agent: Agent) -> tuple[Design, ...]:
    names = collect_components(project, (agent.root,)) if project.design(agent.root) else frozenset()
    return tuple(each for each in project.designs if each.component in names)


def _numbers(subject: Subject) -> Iterator[tuple[int, str, str]]:
    project, designs = subject.project, subject.project.designs
    states = sum(len(design.states) for design in designs)
    transitions = sum(1 for design in designs for _each in walk_transitions(design))
    yield len(project.agents), "agent", AGENTS
    yield len(designs), "state machine", "#components"
    yield states, "state", EVERYTHING
    yield transitions, "transition", EVERYTHING
    yield len(project.components), "interface", INTERFACES
    yield symbol_count(project), "symbol", SYMBOLS
    yield len(project.enumerations), "type", TYPES
    yield len(project.constants), "constant", TYPES
    yield len(subject.findings), "finding", "#findings"


def _number(count: int, word: str, href: str) -> tuple[int, Part]:
    return count, Part(text=word + "s" * (count != 1), href=href)


def _component_row(design: Design, subject: Subject, linker: Linker) -> ComponentRow:
    return ComponentRow(
        component=linker.component(design.component),
        summary=summary_of(design.doc),
        states=len(design.states),
        transitions=sum(1 for _each in walk_transitions(design)),
        findings=sum(1 for each in subject.findings if each.component == design.component),
    )
