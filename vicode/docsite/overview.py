"""The pages about the whole project: home and agents."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from vicode.diagram.dependency_graph import has_omitted_uses
from vicode.docsite.diagrams import draw_dependencies, draw_folders
from vicode.docsite.doc_text import render_doc, render_facts, summarize
from vicode.docsite.findings import finding_groups, finding_rows
from vicode.docsite.interfaces import symbol_count
from vicode.docsite.menu import DesignFolder
from vicode.docsite.name_linker import NameLinker, join_spans
from vicode.docsite.natural_sort import natural_sort_key, sorted_designs
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import AGENTS, INTERFACES, NAME_INDEX, SYMBOLS, TYPES, SiteUrls, unique_slugs
from vicode.docsite.views import (
    AgentRow,
    AgentView,
    ComponentRow,
    FolderView,
    HomeView,
    ReachableComponentRow,
    RichText,
    TextSpan,
)
from vicode.generators import collect_components
from vicode.model.design import Design
from vicode.model.project import Agent, Project
from vicode.model.traversal import iter_transitions
from vicode.model.words import describe_fields

_MAX_UNGROUPED = 40
_TOP_FOLDER = "(top folder)"


def home_view(subject: SiteInput, addresses: SiteUrls) -> HomeView:
    """The home page without the dependency diagram."""
    project = subject.project
    linker = NameLinker(project, addresses)
    return HomeView(
        doc_html=render_doc(project.doc),
        counts=tuple(_number(count, word, href) for count, word, href in _numbers(subject, addresses) if count),
        svg="",
        is_partial=has_omitted_uses(project) and symbol_count(project) > 0,
        agents=tuple(agent_rows(project, addresses)),
        components=tuple(_component_row(design, subject, linker) for design in sorted_designs(project)),
        findings=finding_groups(finding_rows(subject, addresses)),
    )


def group_home(view: HomeView, bones: Project, folders: Sequence[DesignFolder], addresses: SiteUrls) -> HomeView:
    """Draw the diagrams of the home page; those of a large project are by folder.

    Args:
        view: the home page without diagrams.
        bones: the project with what its diagrams show.
        folders: all designs by folder.
        addresses: the URLs.
    """
    if len(bones.designs) <= _MAX_UNGROUPED or len(folders) == 1:
        return replace(view, svg=draw_dependencies(bones, addresses, f"Dependencies in {bones.name}"))
    rows = {row.component.href: row for row in view.components}
    anchors = {
        name: f"folder-{part}" for name, part in unique_slugs(each.name or _TOP_FOLDER for each in folders).items()
    }
    shown, members = [], {}
    for folder in folders:
        name = folder.name or _TOP_FOLDER
        components = [design.component for design in folder.designs]
        part = tuple(design for design in bones.designs if design.component in set(components))
        members[name] = part
        shown.append(
            FolderView(
                anchor=anchors[name],
                name=name,
                rows=tuple(rows[addresses.component(component)] for component in components),
                svg=draw_dependencies(
                    replace(bones, designs=part, components=(), agents=()), addresses, f"Dependencies in {name}"
                )
                if len(part) > 1
                else "",
            )
        )
    return replace(
        view, folders=tuple(shown), svg=draw_folders(members, anchors, addresses, f"Folders of {bones.name}")
    )


def agent_rows(project: Project, addresses: SiteUrls) -> Iterator[AgentRow]:
    linker = NameLinker(project, addresses)
    for agent in project.agents:
        yield AgentRow(
            agent=TextSpan(text=agent.title or agent.name, href=addresses.agent(agent.name)),
            name=agent.name,
            root=linker.component(agent.root),
            state_machine_count=len(_reachable_designs(project, agent)),
            doc_html=render_facts(agent.doc, describe_fields(agent, ("root", "title", "doc", "xabsl_name"))),
        )


def agent_view(project: Project, agent: Agent, addresses: SiteUrls) -> AgentView:
    """The page of an agent with the components that it can activate."""
    linker = NameLinker(project, addresses)
    # A separate diagram: in the positions of the whole project, its components would be scattered.
    part = replace(project, agents=(agent,), designs=_reachable_designs(project, agent))
    names = {design.component for design in part.designs}
    used = {use.component for design in part.designs for use in design.uses} | {agent.root}
    return AgentView(
        name=agent.name,
        title=agent.title,
        doc_html=render_doc(agent.doc),
        root=linker.component(agent.root),
        state_machines=tuple(
            ReachableComponentRow(
                component=linker.component(design.component), summary=summarize(design.doc), states=len(design.states)
            )
            for design in sorted_designs(part)
        ),
        hand_written=join_spans(linker.component(name) for name in sorted(used - names, key=natural_sort_key)),
        svg=draw_dependencies(part, addresses, f"Components that {agent.name} can activate"),
        is_partial=has_omitted_uses(part) and symbol_count(project) > 0,
    )


def agent_links(project: Project, addresses: SiteUrls) -> Mapping[str, RichText]:
    """Links to the agents that can activate a component, by component."""
    found: dict[str, list[TextSpan]] = {}
    for agent in project.agents:
        link = TextSpan(text=agent.title or agent.name, href=addresses.agent(agent.name), title=agent.name)
        designs = _reachable_designs(project, agent)
        used = {use.component for design in designs for use in design.uses}
        for name in used | {design.component for design in designs}:
            found.setdefault(name, []).append(link)
    return {name: join_spans(links) for name, links in found.items()}


def _reachable_designs(project: Project, agent: Agent) -> tuple[Design, ...]:
    names = collect_components(project, (agent.root,)) if project.design(agent.root) else frozenset()
    return tuple(each for each in project.designs if each.component in names)


def _numbers(subject: SiteInput, addresses: SiteUrls) -> Iterator[tuple[int, str, str]]:
    project, designs = subject.project, subject.project.designs
    states = sum(len(design.states) for design in designs)
    transitions = sum(1 for design in designs for _each in iter_transitions(design))
    yield len(project.agents), "agent", AGENTS
    yield len(designs), addresses.names.design_kind, "#components"
    yield states, "state", NAME_INDEX
    yield transitions, "transition", NAME_INDEX
    yield len(project.components), "interface", INTERFACES
    yield symbol_count(project), "symbol", SYMBOLS
    yield len(project.enumerations), "type", TYPES
    yield len(project.constants), "constant", TYPES
    yield len(subject.findings), "finding", "#findings"


def _number(count: int, word: str, href: str) -> tuple[int, TextSpan]:
    return count, TextSpan(text=word + "s" * (count != 1), href=href)


def _component_row(design: Design, subject: SiteInput, linker: NameLinker) -> ComponentRow:
    return ComponentRow(
        component=linker.component(design.component),
        summary=summarize(design.doc),
        states=len(design.states),
        transitions=sum(1 for _each in iter_transitions(design)),
        findings=sum(1 for each in subject.findings if each.component == design.component),
    )
