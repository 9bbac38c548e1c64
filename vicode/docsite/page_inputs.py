"""The parts of a project that a page depends on; a page sees nothing else, so other edits cannot change it."""

from collections.abc import Iterable
from dataclasses import replace

from vicode.docsite.site_input import SiteInput
from vicode.generators import collect_components
from vicode.model.design import Action, Call, Code, CommonSection, Design, State
from vicode.model.project import Project


def restrict_to_component(subject: SiteInput, design: Design) -> SiteInput:
    """The inputs of the page of a design: the design, its users, and the interfaces of the components it uses."""
    project, name = subject.project, design.component
    designs = tuple(
        each for each in project.designs if each is design or any(use.component == name for use in each.uses)
    )
    kept = {each.component for each in designs}
    used = dict.fromkeys(use.component for use in design.uses if use.component not in kept)
    interfaces = (project.interface(each) for each in used)
    part = replace(project, designs=designs, components=tuple(each for each in interfaces if each is not None))
    sources = {each: replace(source, text="") for each, source in subject.sources.items() if each in ("", name)}
    findings = tuple(each for each in subject.findings if each.component in ("", name))
    return SiteInput(
        project=part, findings=findings, sources=sources, title=subject.title, source_url=subject.source_url
    )


def restrict_to_used(project: Project, component: str) -> Project:
    """What the code of a design depends on: the design, and all components that it uses, directly or not."""
    kept = collect_components(project, (component,))
    designs = tuple(each for each in project.designs if each.component in kept)
    used = {use.component for each in designs for use in each.uses} - kept
    components = tuple(each for each in project.components if each.component in used)
    types, constants = project.enumerations, project.constants
    return Project(name=project.name, enumerations=types, constants=constants, components=components, designs=designs)


def strip_to_usage(project: Project) -> Project:
    """The inputs of dependency diagrams: states with the components they require and call."""
    return replace(project, designs=tuple(map(_usage_only, project.designs)))


def strip_to_interfaces(project: Project) -> Project:
    """The names and declarations of each design, on which the generated code of other components depends."""
    return replace(project, designs=tuple(_interface_only(design) for design in project.designs))


def _usage_only(design: Design) -> Design:
    states = tuple(
        State(name=state.name, requires=state.requires, actions=_calls(state.all_actions)) for state in design.states
    )
    common = CommonSection(actions=_calls(design.common.actions))
    return Design(component=design.component, doc=design.doc, uses=design.uses, common=common, states=states)


def _calls(actions: Iterable[Action]) -> tuple[Call, ...]:
    return tuple(Call(alias=action.alias) for action in actions if isinstance(action, Call))


def _interface_only(design: Design) -> Design:
    return replace(design, doc="", states=(), common=CommonSection(), module=Code(), members=Code())
