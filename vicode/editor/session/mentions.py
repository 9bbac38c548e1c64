"""Where a declared thing is said: what another name for it would change."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.editor.session.wording import words_of_path
from vicode.findings import Path
from vicode.model.design import Declaration, Design
from vicode.model.edits import free_name
from vicode.model.project import Project
from vicode.model.renaming import Declared, names_beside, rename_declared
from vicode.model.walks import walk_code, walk_expressions

_SECTIONS = ("parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class Mention:
    """A place that says a thing: in a design, or with no component in project.yaml."""

    component: str = ""
    words: str


def mentions_of(project: Project, thing: Declared) -> tuple[Mention, ...]:
    """Everywhere a thing is said, but where it is declared; each place once."""
    other = free_name(f"{thing.name}_another", set(names_beside(project, thing)))
    renamed = rename_declared(project, thing, other)
    before, after = _own_texts(project), _own_texts(renamed)
    found = [Mention(words=words) for (words, text), (_, now) in zip(before, after, strict=True) if text != now]
    for design, now_design in zip(project.designs, renamed.designs, strict=True):
        if design != now_design:
            pairs = zip(_texts(design), _texts(now_design), strict=True)
            places = (path for (path, text), (other_path, now) in pairs if text != now or path != other_path)
            found += [Mention(component=design.component, words=words_of_path(path)) for path in places]
    return tuple(dict.fromkeys(found))


def _texts(design: Design) -> Iterator[tuple[Path, str]]:
    """All that a design may say of others, each with its place."""
    for use in design.uses:
        yield ("uses", use.alias), use.component
    for section, declaration in design.declarations():
        for key, text in _said(declaration):
            yield (section, declaration.name, key), text
    for expression in walk_expressions(design):
        if expression.path[0] not in _SECTIONS:
            yield expression.path, expression.text
    for placed in walk_code(design):
        yield placed.path, repr(placed.code.texts)


def _said(declaration: Declaration) -> Iterator[tuple[str, str]]:
    yield "type", declaration.type
    yield "value", declaration.initial
    for argument in declaration.arguments or ():
        yield "arguments", f"{argument.type} {argument.initial}"


def _own_texts(project: Project) -> list[tuple[str, str]]:
    """All that project.yaml says of its own things, each with words for its place."""
    found = [(f"{key} of constant {each.name}", text) for each in project.constants for key, text in _said(each)]
    for part in project.components:
        for section in _SECTIONS:
            for each in getattr(part, section):
                place = f"{section.removesuffix('s')} {each.name} of {part.component}"
                found += [(f"{key} of {place}", text) for key, text in _said(each)]
    return found + [(f"root of agent {each.name}", each.root) for each in project.agents]
