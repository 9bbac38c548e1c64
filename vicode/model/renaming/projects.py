"""Renames one declared thing in a whole project: where it is declared, and in every design that says it."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from vicode.model.design import Declaration, Design
from vicode.model.project import Enumeration, Interface, Project
from vicode.model.renaming.designs import renamed_in_declarations, renamed_in_design
from vicode.model.renaming.names import Declared, Said, Way

_Holder = TypeVar("_Holder", Design, Interface)


def rename_declared(project: Project, thing: Declared, new: str) -> Project:
    """The project with a new name for one thing, and for that thing only; an unknown one changes nothing."""
    if not has_declared(project, thing) or thing.name == new:
        return project
    designs = tuple(_in_design(design, project, thing, new) for design in project.designs)
    project = replace(project, designs=designs)
    if not thing.component:
        return _in_project(project, thing, new)
    components = tuple(
        _with_name(each, thing, new) if each.component == thing.component else each for each in project.components
    )
    return replace(project, components=components)


def has_declared(project: Project, thing: Declared) -> bool:
    """Whether the project declares such a thing."""
    return thing.name in names_beside(project, thing)


def names_beside(project: Project, thing: Declared) -> tuple[str, ...]:
    """The names that stand beside a thing, its own among them."""
    match thing:
        case Declared(component="", section="elements"):
            found = project.enumeration(thing.owner)
            return found.element_names if found else ()
        case Declared(component="", section="components"):
            return tuple(each.component for each in project.components)
        case Declared(component=""):
            return tuple(each.name for each in getattr(project, thing.section, ()))
        case Declared(section="uses"):
            design = project.design(thing.component)
            return tuple(use.alias for use in design.uses) if design else ()
        case Declared(section="arguments"):
            output = next((each for each in _list(project, thing, "outputs") if each.name == thing.owner), None)
            return tuple(each.name for each in (output.arguments or ())) if output else ()
        case _:
            return tuple(each.name for each in _list(project, thing, thing.section))


def rename_alias(design: Design, old: str, new: str) -> Design:
    """The design with `new` where links, calls, expressions and Python code said the alias `old`."""
    return renamed_in_design(design, Said(way=Way.ALIAS, old=old, new=new))


def _list(project: Project, thing: Declared, section: str) -> tuple[Declaration, ...]:
    whose = project.design(thing.component) or project.interface(thing.component)
    found: tuple[Declaration, ...] = getattr(whose, section, ()) if whose else ()
    return found


def _in_design(design: Design, project: Project, thing: Declared, new: str) -> Design:
    """A design that says the new name, and declares it if it is its own."""
    if design.component == thing.component:
        design = _with_name(design, thing, new)
    for said in _ways(design, project, thing, new):
        design = renamed_in_design(design, said)
    if thing.section == "components":
        uses = (replace(use, component=new) if use.component == thing.name else use for use in design.uses)
        design = replace(design, uses=tuple(uses))
    return design


def _ways(design: Design, project: Project, thing: Declared, new: str) -> Iterator[Said]:
    """How a design says a thing: its own as it is, what another declares behind each alias of that one."""
    names = {"old": thing.name, "new": new}
    match thing.section:
        case "uses" if design.component == thing.component:
            yield Said(way=Way.ALIAS, **names)
        case "constants":
            yield Said(way=Way.CONSTANT, **names)
        case "enumerations":
            yield Said(way=Way.ENUMERATION, **names)
        case "elements":
            yield Said(way=Way.ELEMENT, owner=thing.owner, **names)
        case "parameters" | "outputs" | "variables" if design.component == thing.component:
            yield Said(way=Way.OWN, **names)
        case "parameters" | "outputs" | "variables" | "arguments":
            is_shown = thing.section != "variables" or project.design(thing.component) is None
            for use in design.uses:
                if use.component == thing.component and is_shown:
                    yield from _ways_behind(use.alias, _list(project, thing, "outputs"), thing, new)


def _ways_behind(alias: str, outputs: tuple[Declaration, ...], thing: Declared, new: str) -> Iterator[Said]:
    """How what a used component shows is said: a parameter where it is called, and read only if no output is."""
    names = {"old": thing.name, "new": new}
    if thing.section == "arguments":
        yield Said(way=Way.ARGUMENT, owner=f"{alias}.{thing.owner}", **names)
        return
    if thing.section == "parameters":
        yield Said(way=Way.PARAMETER, owner=alias, **names)
    if thing.section != "parameters" or thing.name not in {each.name for each in outputs}:
        yield Said(way=Way.MEMBER, owner=alias, **names)


def _with_name(holder: _Holder, thing: Declared, new: str) -> _Holder:
    """A design, or what a hand-written component shows, with the new name where it declares the thing."""
    old = thing.name
    match thing.section:
        case "uses":
            if isinstance(holder, Interface):
                return holder
            return replace(
                holder, uses=tuple(replace(use, alias=new) if use.alias == old else use for use in holder.uses)
            )
        case "arguments":
            return replace(holder, outputs=tuple(_with_argument(each, thing, new) for each in holder.outputs))
        case "parameters":
            return replace(holder, parameters=_named(holder.parameters, old, new))
        case "outputs":
            return replace(holder, outputs=_named(holder.outputs, old, new))
        case _:
            return replace(holder, variables=_named(holder.variables, old, new))


def _with_argument(output: Declaration, thing: Declared, new: str) -> Declaration:
    if output.name != thing.owner or output.arguments is None:
        return output
    return replace(output, arguments=_named(output.arguments, thing.name, new))


def _named(declarations: tuple[Declaration, ...], old: str, new: str) -> tuple[Declaration, ...]:
    return tuple(replace(each, name=new) if each.name == old else each for each in declarations)


def _in_project(project: Project, thing: Declared, new: str) -> Project:
    """What the project itself declares, with the new name of a thing of its own."""
    match thing.section:
        case "constants":
            project = replace(project, constants=_named(project.constants, thing.name, new))
            return _said_in_project(project, Said(way=Way.CONSTANT, old=thing.name, new=new))
        case "enumerations":
            each = (replace(each, name=new) if each.name == thing.name else each for each in project.enumerations)
            project = replace(project, enumerations=tuple(each))
            return _said_in_project(project, Said(way=Way.ENUMERATION, old=thing.name, new=new))
        case "elements":
            changed = (
                _with_element(each, thing.name, new) if each.name == thing.owner else each
                for each in project.enumerations
            )
            project = replace(project, enumerations=tuple(changed))
            return _said_in_project(project, Said(way=Way.ELEMENT, old=thing.name, new=new, owner=thing.owner))
        case "components":
            parts = (
                replace(each, component=new) if each.component == thing.name else each for each in project.components
            )
            agents = (replace(each, root=new) if each.root == thing.name else each for each in project.agents)
            return replace(project, components=tuple(parts), agents=tuple(agents))
        case _:
            named = (replace(each, name=new) if each.name == thing.name else each for each in project.agents)
            return replace(project, agents=tuple(named))


def _with_element(enumeration: Enumeration, old: str, new: str) -> Enumeration:
    def named(pairs: tuple[tuple[str, str], ...]) -> tuple[tuple[str, str], ...]:
        return tuple((new if name == old else name, text) for name, text in pairs)

    return replace(enumeration, elements=named(enumeration.elements), xabsl_elements=named(enumeration.xabsl_elements))


def _said_in_project(project: Project, said: Said) -> Project:
    """Constants, and what hand-written components show, with the new name in values and types."""
    components = (
        replace(
            each,
            parameters=renamed_in_declarations(each.parameters, said),
            outputs=renamed_in_declarations(each.outputs, said),
            variables=renamed_in_declarations(each.variables, said),
        )
        for each in project.components
    )
    constants = renamed_in_declarations(project.constants, said)
    return replace(project, constants=constants, components=tuple(components))
