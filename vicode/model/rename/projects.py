"""Renaming of a symbol in a project: its declaration and all references."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from vicode.model.design import Declaration, Design
from vicode.model.project import Elsewhere, Enumeration, Interface, Profile, ProfileClass, Project, TopicReference
from vicode.model.rename.designs import rename_in_declarations, rename_in_design
from vicode.model.rename.expressions import rename_in_expression
from vicode.model.rename.references import ReferenceKind, ReferenceRename, SymbolRef

_Holder = TypeVar("_Holder", Design, Interface)


def rename_symbol(project: Project, symbol: SymbolRef, new: str) -> Project:
    """Return the project with one symbol renamed; an unknown symbol changes nothing."""
    if not is_declared(project, symbol) or symbol.name == new:
        return project
    designs = tuple(_rename_in_one_design(design, project, symbol, new) for design in project.designs)
    profiles = tuple(_rename_in_profile(each, symbol, new) for each in project.profiles)
    project = replace(project, designs=designs, profiles=profiles)
    if not symbol.component:
        return _rename_in_project_file(project, symbol, new)
    components = tuple(
        _rename_declaration(each, symbol, new) if each.component == symbol.component else each
        for each in project.components
    )
    return replace(project, components=components)


def is_declared(project: Project, symbol: SymbolRef) -> bool:
    return symbol.name in sibling_names(project, symbol)


def sibling_names(project: Project, symbol: SymbolRef) -> tuple[str, ...]:
    """Return the names in the section of a symbol, including its own."""
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
    """Rename an alias in links, calls, expressions and Python code."""
    return rename_in_design(design, ReferenceRename(kind=ReferenceKind.ALIAS, old=old, new=new))


def _declarations_in(project: Project, symbol: SymbolRef, section: str) -> tuple[Declaration, ...]:
    whose = project.design(symbol.component) or project.interface(symbol.component)
    found: tuple[Declaration, ...] = getattr(whose, section, ()) if whose else ()
    return found


def _rename_in_one_design(design: Design, project: Project, symbol: SymbolRef, new: str) -> Design:
    """Rename a symbol in one design, including its declaration."""
    if design.component == symbol.component:
        design = _rename_declaration(design, symbol, new)
    for rename in _references_to(design, project, symbol, new):
        design = rename_in_design(design, rename)
    if symbol.section == "components":
        uses = (replace(use, component=new) if use.component == symbol.name else use for use in design.uses)
        design = replace(design, uses=tuple(uses))
    return design


def _references_to(design: Design, project: Project, symbol: SymbolRef, new: str) -> Iterator[ReferenceRename]:
    """Yield the renames that cover all references to a symbol in a design."""
    names = {"old": symbol.name, "new": new}
    match symbol.section:
        case "uses" if design.component == symbol.component:
            yield ReferenceRename(kind=ReferenceKind.ALIAS, **names)
        case "constants":
            yield ReferenceRename(kind=ReferenceKind.CONSTANT, **names)
        case "enumerations":
            yield ReferenceRename(kind=ReferenceKind.ENUMERATION, **names)
        case "elements":
            yield ReferenceRename(kind=ReferenceKind.ELEMENT, owner=symbol.owner, **names)
        case "parameters" | "outputs" | "variables" if design.component == symbol.component:
            yield ReferenceRename(kind=ReferenceKind.OWN, **names)
        case "parameters" | "outputs" | "variables" | "arguments":
            is_shown = symbol.section != "variables" or project.design(symbol.component) is None
            for use in design.uses:
                if use.component == symbol.component and is_shown:
                    yield from _references_through_alias(
                        use.alias, _declarations_in(project, symbol, "outputs"), symbol, new
                    )


def _references_through_alias(
    alias: str, outputs: tuple[Declaration, ...], symbol: SymbolRef, new: str
) -> Iterator[ReferenceRename]:
    """Yield the renames of references through an alias. An output hides a parameter with the same name."""
    names = {"old": symbol.name, "new": new}
    if symbol.section == "arguments":
        yield ReferenceRename(kind=ReferenceKind.ARGUMENT, owner=f"{alias}.{symbol.owner}", **names)
        return
    if symbol.section == "parameters":
        yield ReferenceRename(kind=ReferenceKind.PARAMETER, owner=alias, **names)
    if symbol.section != "parameters" or symbol.name not in {each.name for each in outputs}:
        yield ReferenceRename(kind=ReferenceKind.MEMBER, owner=alias, **names)


def _rename_declaration(holder: _Holder, symbol: SymbolRef, new: str) -> _Holder:
    """Rename a symbol where a design or interface declares it."""
    old = symbol.name
    if symbol.section != "arguments" and isinstance(holder, Interface):
        own = ReferenceRename(kind=ReferenceKind.OWN, old=old, new=new)
        holder = replace(holder, assume=rename_in_expression(holder.assume, own))
    match symbol.section:
        case "uses":
            if isinstance(holder, Interface):
                return holder
            return replace(
                holder, uses=tuple(replace(use, alias=new) if use.alias == old else use for use in holder.uses)
            )
        case "arguments":
            return replace(holder, outputs=tuple(_rename_argument(each, symbol, new) for each in holder.outputs))
        case "parameters":
            return replace(holder, parameters=_rename_in_list(holder.parameters, old, new))
        case "outputs":
            return replace(holder, outputs=_rename_in_list(holder.outputs, old, new))
        case _:
            if isinstance(holder, Design):
                latches = (replace(each, name=new) if each.name == old else each for each in holder.latches)
                holder = replace(holder, latches=tuple(latches))
            return replace(holder, variables=_rename_in_list(holder.variables, old, new))


def _rename_argument(output: Declaration, symbol: SymbolRef, new: str) -> Declaration:
    if output.name != symbol.owner or output.arguments is None:
        return output
    return replace(output, arguments=_rename_in_list(output.arguments, symbol.name, new))


def _rename_in_list(declarations: tuple[Declaration, ...], old: str, new: str) -> tuple[Declaration, ...]:
    return tuple(replace(each, name=new) if each.name == old else each for each in declarations)


def _rename_in_project_file(project: Project, symbol: SymbolRef, new: str) -> Project:
    match symbol.section:
        case "constants":
            project = replace(project, constants=_rename_in_list(project.constants, symbol.name, new))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.CONSTANT, old=symbol.name, new=new)
            )
        case "enumerations":
            each = (replace(each, name=new) if each.name == symbol.name else each for each in project.enumerations)
            project = replace(project, enumerations=tuple(each))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.ENUMERATION, old=symbol.name, new=new)
            )
        case "elements":
            changed = (
                _rename_element(each, symbol.name, new) if each.name == symbol.owner else each
                for each in project.enumerations
            )
            project = replace(project, enumerations=tuple(changed))
            return _rename_in_project_declarations(
                project, ReferenceRename(kind=ReferenceKind.ELEMENT, old=symbol.name, new=new, owner=symbol.owner)
            )
        case "components":
            parts = (
                replace(each, component=new) if each.component == symbol.name else each for each in project.components
            )
            agents = (replace(each, root=new) if each.root == symbol.name else each for each in project.agents)
            return replace(project, components=tuple(parts), agents=tuple(agents))
        case _:
            named = (replace(each, name=new) if each.name == symbol.name else each for each in project.agents)
            return replace(project, agents=tuple(named))


def _rename_in_profile(profile: Profile, symbol: SymbolRef, new: str) -> Profile:
    """Rename a component, or an output or parameter that a topic has."""

    def renamed(each: ProfileClass | Elsewhere) -> ProfileClass | Elsewhere:
        if symbol.section == "components" and each.component == symbol.name:
            return replace(each, component=new)
        if not isinstance(each, TopicReference) or each.component != symbol.component:
            return each
        if symbol.section == "outputs":
            return replace(each, outputs=_rename_in_pairs(each.outputs, symbol.name, new))
        if symbol.section == "parameters":
            return replace(each, parameters=_rename_in_pairs(each.parameters, symbol.name, new))
        return each

    return replace(profile, components=tuple(map(renamed, profile.components)))


def _rename_element(enumeration: Enumeration, old: str, new: str) -> Enumeration:
    return replace(
        enumeration,
        elements=_rename_in_pairs(enumeration.elements, old, new),
        xabsl_elements=_rename_in_pairs(enumeration.xabsl_elements, old, new),
    )


def _rename_in_pairs(pairs: tuple[tuple[str, str], ...], old: str, new: str) -> tuple[tuple[str, str], ...]:
    return tuple((new if name == old else name, text) for name, text in pairs)


def _rename_in_project_declarations(project: Project, rename: ReferenceRename) -> Project:
    """Rename references in constants and interfaces of the project file."""
    components = (
        replace(
            each,
            parameters=rename_in_declarations(each.parameters, rename),
            outputs=rename_in_declarations(each.outputs, rename),
            variables=rename_in_declarations(each.variables, rename),
            assume=rename_in_expression(each.assume, rename),
        )
        for each in project.components
    )
    constants = rename_in_declarations(project.constants, rename)
    return replace(project, constants=constants, components=tuple(components))
