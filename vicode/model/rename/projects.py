"""Renames one declared thing in a whole project: where it is declared, and in every design that says it."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from vicode.model.design import Declaration, Design
from vicode.model.project import Enumeration, Interface, Project
from vicode.model.rename.designs import rename_in_declarations, rename_in_design
from vicode.model.rename.references import ReferenceKind, ReferenceRename, SymbolRef

_Holder = TypeVar("_Holder", Design, Interface)


def rename_symbol(project: Project, symbol: SymbolRef, new: str) -> Project:
    """The project with a new name for one thing, and for that thing only; an unknown one changes nothing."""
    if not is_declared(project, symbol) or symbol.name == new:
        return project
    designs = tuple(_rename_in_one_design(design, project, symbol, new) for design in project.designs)
    project = replace(project, designs=designs)
    if not symbol.component:
        return _rename_in_project_file(project, symbol, new)
    components = tuple(
        _rename_declaration(each, symbol, new) if each.component == symbol.component else each
        for each in project.components
    )
    return replace(project, components=components)


def is_declared(project: Project, symbol: SymbolRef) -> bool:
    """Whether the project declares such a thing."""
    return symbol.name in sibling_names(project, symbol)


def sibling_names(project: Project, symbol: SymbolRef) -> tuple[str, ...]:
    """The names that stand beside a thing, its own among them."""
    match symbol:
        case SymbolRef(component="", section="elements"):
            found = project.enumeration(symbol.owner)
            return found.element_names if found else ()
        case SymbolRef(component="", section="components"):
            return tuple(each.component for each in project.components)
        case SymbolRef(component=""):
            return tuple(each.name for each in getattr(project, symbol.section, ()))
        case SymbolRef(section="uses"):
            design = project.design(symbol.component)
            return tuple(use.alias for use in design.uses) if design else ()
        case SymbolRef(section="arguments"):
            output = next(
                (each for each in _declarations_in(project, symbol, "outputs") if each.name == symbol.owner), None
            )
            return tuple(each.name for each in (output.arguments or ())) if output else ()
        case _:
            return tuple(each.name for each in _declarations_in(project, symbol, symbol.section))


def rename_alias(design: Design, old: str, new: str) -> Design:
    """The design with `new` where links, calls, expressions and Python code said the alias `old`."""
    return rename_in_design(design, ReferenceRename(kind=ReferenceKind.ALIAS, old=old, new=new))


def _declarations_in(project: Project, thing: SymbolRef, section: str) -> tuple[Declaration, ...]:
    whose = project.design(thing.component) or project.interface(thing.component)
    found: tuple[Declaration, ...] = getattr(whose, section, ()) if whose else ()
    return found


def _rename_in_one_design(design: Design, project: Project, thing: SymbolRef, new: str) -> Design:
    """A design that says the new name, and declares it if it is its own."""
    if design.component == thing.component:
        design = _rename_declaration(design, thing, new)
    for said in _references_to(design, project, thing, new):
        design = rename_in_design(design, said)
    if thing.section == "components":
        uses = (replace(use, component=new) if use.component == thing.name else use for use in design.uses)
        design = replace(design, uses=tuple(uses))
    return design


def _references_to(design: Design, project: Project, thing: SymbolRef, new: str) -> Iterator[ReferenceRename]:
    """How a design says a thing: its own as it is, what another declares behind each alias of that one."""
    names = {"old": thing.name, "new": new}
    match thing.section:
        case "uses" if design.component == thing.component:
            yield ReferenceRename(kind=ReferenceKind.ALIAS, **names)
        case "constants":
            yield ReferenceRename(kind=ReferenceKind.CONSTANT, **names)
        case "enumerations":
            yield ReferenceRename(kind=ReferenceKind.ENUMERATION, **names)
        case "elements":
            yield ReferenceRename(kind=ReferenceKind.ELEMENT, owner=thing.owner, **names)
        case "parameters" | "outputs" | "variables" if design.component == thing.component:
            yield ReferenceRename(kind=ReferenceKind.OWN, **names)
        case "parameters" | "outputs" | "variables" | "arguments":
            is_shown = thing.section != "variables" or project.design(thing.component) is None
            for use in design.uses:
                if use.component == thing.component and is_shown:
                    yield from _references_through_alias(
                        use.alias, _declarations_in(project, thing, "outputs"), thing, new
                    )


def _references_through_alias(
    alias: str, outputs: tuple[Declaration, ...], thing: SymbolRef, new: str
) -> Iterator[ReferenceRename]:
    """How what a used component shows is said: a parameter where it is called, and read only if no output is."""
    names = {"old": thing.name, "new": new}
    if thing.section == "arguments":
        yield ReferenceRename(kind=ReferenceKind.ARGUMENT, owner=f"{alias}.{thing.owner}", **names)
        return
    if thing.section == "parameters":
        yield ReferenceRename(kind=ReferenceKind.PARAMETER, owner=alias, **names)
    if thing.section != "parameters" or thing.name not in {each.name for each in outputs}:
        yield ReferenceRename(kind=ReferenceKind.MEMBER, owner=alias, **names)


def _rename_declaration(holder: _Holder, thing: SymbolRef, new: str) -> _Holder:
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
            return replace(holder, outputs=tuple(_rename_argument(each, thing, new) for each in holder.outputs))
        case "parameters":
            return replace(holder, parameters=_rename_in_list(holder.parameters, old, new))
        case "outputs":
            return replace(holder, outputs=_rename_in_list(holder.outputs, old, new))
        case _:
            return replace(holder, variables=_rename_in_list(holder.variables, old, new))


def _rename_argument(output: Declaration, thing: SymbolRef, new: str) -> Declaration:
    if output.name != thing.owner or output.arguments is None:
        return output
    return replace(output, arguments=_rename_in_list(output.arguments, thing.name, new))


def _rename_in_list(declarations: tuple[Declaration, ...], old: str, new: str) -> tuple[Declaration, ...]:
    return tuple(replace(each, name=new) if each.name == old else each for each in declarations)


def _rename_in_project_file(project: Project, thing: SymbolRef, new: str) -> Project:
    """What the project itself declares, with the new name of a thing of its own."""
    match thing.section:
        case "constants":
            project = replace(project, constants=_rename_in_list(project.constants, thing.name, new))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.CONSTANT, old=thing.name, new=new)
            )
        case "enumerations":
            each = (replace(each, name=new) if each.name == thing.name else each for each in project.enumerations)
            project = replace(project, enumerations=tuple(each))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.ENUMERATION, old=thing.name, new=new)
            )
        case "elements":
            changed = (
                _rename_element(each, thing.name, new) if each.name == thing.owner else each
                for each in project.enumerations
            )
            project = replace(project, enumerations=tuple(changed))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.ELEMENT, old=thing.name, new=new, owner=thing.owner)
            )
        case "components":
            parts = (
                replace(each, component=new) if each.component == thing.name else each for each in project.components
            )
            agents = (replace(each, root=new) if each.root == thing.name else each for each in project.agents)
            return replace(project, components=tuple(parts), agents=tuple(agents))
        case _:
            named = (replace(each, name=new) if each.name == thing.name else each for each in project.agents)
            return replace(project, agents=tuple(named))


def _rename_element(enumeration: Enumeration, old: str, new: str) -> Enumeration:
    def named(pairs: tuple[tuple[str, str], ...]) -> tuple[tuple[str, str], ...]:
        return tuple((new if name == old else name, text) for name, text in pairs)

    return replace(enumeration, elements=named(enumeration.elements), xabsl_elements=named(enumeration.xabsl_elements))


def _rename_in_project_declarations(project: Project, said: ReferenceRename) -> Project:
    """Constants, and what hand-written components show, with the new name in values and types."""
    components = (
        replace(
            each,
            parameters=rename_in_declarations(each.parameters, said),
            outputs=rename_in_declarations(each.outputs, said),
            variables=rename_in_declarations(each.variables, said),
        )
        for each in project.components
    )
    constants = rename_in_declarations(project.constants, said)
    return replace(project, constants=constants, components=tuple(components))
