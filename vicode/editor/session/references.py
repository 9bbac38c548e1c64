"""Where a declared thing is said: what another name for it would change."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.editor.session.descriptions import describe_path
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.edits import unique_name
from vicode.model.project import Project
from vicode.model.rename import SymbolRef, rename_symbol, sibling_names
from vicode.model.traversal import iter_code, iter_expressions

_SECTIONS = ("parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceLocation:
    """A place that says a thing: in a design, or with no component in project.yaml."""

    component: str = ""
    description: str


def find_references(project: Project, thing: SymbolRef) -> tuple[ReferenceLocation, ...]:
    """Everywhere a thing is said, but where it is declared; each place once."""
    other = unique_name(f"{thing.name}_another", set(sibling_names(project, thing)))
    renamed = rename_symbol(project, thing, other)
    before, after = _own_texts(project), _own_texts(renamed)
    found = [
        ReferenceLocation(description=words)
        for (words, text), (_, now) in zip(before, after, strict=True)
        if text != now
    ]
    for design, now_design in zip(project.designs, renamed.designs, strict=True):
        if design != now_design:
            pairs = zip(_texts(design), _texts(now_design), strict=True)
            places = (path for (path, text), (other_path, now) in pairs if text != now or path != other_path)
            found += [ReferenceLocation(component=design.component, description=describe_path(path)) for path in places]
    return tuple(dict.fromkeys(found))


def _texts(design: Design) -> Iterator[tuple[DesignPath, str]]:
    """All that a design may say of others, each with its place."""
    for use in design.uses:
        yield ("uses", use.alias), use.component
    for section, declaration in design.declarations():
        for key, text in _declaration_texts(declaration):
            yield (section, declaration.name, key), text
    for expression in iter_expressions(design):
        if expression.path[0] not in _SECTIONS:
            yield expression.path, expression.text
    for placed in iter_code(design):
        yield placed.path, repr(placed.code.texts)


def _declaration_texts(declaration: Declaration) -> Iterator[tuple[str, str]]:
    yield "type", declaration.type
    yield "value", declaration.initial
    for argument in declaration.arguments or ():
        yield "arguments", f"{argument.type} {argument.initial}"


def _own_texts(project: Project) -> list[tuple[str, str]]:
    """All that project.yaml says of its own things, each with words for its place."""
    found = [
        (f"{key} of constant {each.name}", text) for each in project.constants for key, text in _declaration_texts(each)
    ]
    for part in project.components:
        for section in _SECTIONS:
            for each in getattr(part, section):
                place = f"{section.removesuffix('s')} {each.name} of {part.component}"
                found += [(f"{key} of {place}", text) for key, text in _declaration_texts(each)]
    return found + [(f"root of agent {each.name}", each.root) for each in project.agents]
