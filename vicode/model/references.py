"""Finds the references to a symbol, as the places that a rename would change."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.edits import unique_name
from vicode.model.paths import describe_path
from vicode.model.project import Project
from vicode.model.rename import SymbolRef, rename_symbol, sibling_names
from vicode.model.traversal import iter_code, iter_expressions

_SECTIONS = ("parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceLocation:
    """A reference in a design, or in project.yaml if `component` is empty."""

    component: str = ""
    description: str


def find_references(project: Project, symbol: SymbolRef) -> tuple[ReferenceLocation, ...]:
    """All references to a symbol except its declaration, without duplicates."""
    other = unique_name(f"{symbol.name}_another", set(sibling_names(project, symbol)))
    renamed = rename_symbol(project, symbol, other)
    before, after = _own_texts(project), _own_texts(renamed)
    found = [
        ReferenceLocation(description=description)
        for (description, text), (_, now) in zip(before, after, strict=True)
        if text != now
    ]
    for design, now_design in zip(project.designs, renamed.designs, strict=True):
        if design != now_design:
            pairs = zip(_texts(design), _texts(now_design), strict=True)
            paths = (path for (path, text), (other_path, now) in pairs if text != now or path != other_path)
            found += [ReferenceLocation(component=design.component, description=describe_path(path)) for path in paths]
    return tuple(dict.fromkeys(found))


def _texts(design: Design) -> Iterator[tuple[DesignPath, str]]:
    """All texts of a design that may contain references, with their paths."""
    for use in design.uses:
        yield ("uses", use.alias), use.component
    for section, declaration in design.declarations():
        for key, text in _declaration_texts(declaration):
            yield (section, declaration.name, key), text
    for expression in iter_expressions(design):
        if expression.path[0] not in _SECTIONS:
            yield expression.path, expression.text
    for located in iter_code(design):
        yield located.path, repr(located.code.texts)


def _declaration_texts(declaration: Declaration) -> Iterator[tuple[str, str]]:
    yield "type", declaration.type
    yield "value", declaration.initial
    for argument in declaration.arguments or ():
        yield "arguments", f"{argument.type} {argument.initial}"


def _own_texts(project: Project) -> list[tuple[str, str]]:
    """All texts of project.yaml that may contain references, with descriptions of their places."""
    found = [
        (f"{key} of constant {constant.name}", text)
        for constant in project.constants
        for key, text in _declaration_texts(constant)
    ]
    for interface in project.components:
        for section in _SECTIONS:
            for declaration in getattr(interface, section):
                place = f"{section.removesuffix('s')} {declaration.name} of {interface.component}"
                found += [(f"{key} of {place}", text) for key, text in _declaration_texts(declaration)]
        found.append((f"assumption about {interface.component}", interface.assume))
    return found + [(f"root of agent {agent.name}", agent.root) for agent in project.agents]
