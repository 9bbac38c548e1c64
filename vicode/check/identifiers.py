"""The names in a design or project file and their validation."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.bica import RESERVED_NAMES
from vicode.findings import DesignPath
from vicode.languages import LANGUAGES
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS
from vicode.model.names import is_valid_name, is_valid_state_name
from vicode.model.project import Project

_MEMBERS = {"alias", "parameter", "output", "variable"}
_WITH_SELF = {*_MEMBERS, "argument"}
_TIMES = frozenset({"state_time", "component_time", "action_done", "conflict", "team_size"})
_EXPRESSION_WORDS = {
    **dict.fromkeys(FUNCTIONS, "a built-in function"),
    **dict.fromkeys(("done", "True", "False", "true", "false", *_TIMES), "a reserved word in expressions"),
    **dict.fromkeys(("bool", "int", "float"), "a type"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Identifier:
    """A name with the kind of item that it names; expressions can use it if `is_expression_name`."""

    name: str
    kind: str
    path: DesignPath
    is_expression_name: bool = False
    is_key: bool = True


IdentifierProblem = tuple[str, str, str]
"""Code, message and fix."""


def with_article(what: str) -> str:
    return f"an {what}" if what[0] in "aeiou" else f"a {what}"


def iter_design_identifiers(design: Design) -> Iterator[Identifier]:
    """Yield the names in a design, in file order."""
    yield Identifier(name=design.component, kind="component", path=("component",), is_key=False)
    for use in design.uses:
        yield Identifier(name=use.alias, kind="alias", path=("uses", use.alias), is_expression_name=True)
    for section, declaration in design.declarations():
        yield from _iter_declaration_identifiers(
            declaration, section.removesuffix("s"), (section, declaration.name), is_shared=True
        )
    for state in design.states:
        yield Identifier(name=state.name, kind="state", path=("states", state.name))


def iter_project_identifiers(project: Project) -> Iterator[Identifier]:
    """Yield the names in a project file, in file order."""
    yield from iter_expression_identifiers(project)
    for interface in project.components:
        path: DesignPath = ("components", interface.component)
        yield Identifier(name=interface.component, kind="hand-written component", path=path)
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(interface, section):
                here = (*path, section, declaration.name)
                yield from _iter_declaration_identifiers(declaration, section.removesuffix("s"), here, is_shared=False)
    for agent in project.agents:
        yield Identifier(name=agent.name, kind="agent", path=("agents", agent.name))


def iter_expression_identifiers(project: Project) -> Iterator[Identifier]:
    """Yield the constants, enumerations and elements of a project file."""
    for enumeration in project.enumerations:
        path: DesignPath = ("enumerations", enumeration.name)
        yield Identifier(name=enumeration.name, kind="enumeration", path=path, is_expression_name=True)
        for element in enumeration.element_names:
            yield Identifier(name=element, kind="element", path=(*path, "elements", element))
    for constant in project.constants:
        yield from _iter_declaration_identifiers(constant, "constant", ("constants", constant.name), is_shared=True)


def validate_identifier(identifier: Identifier, languages: tuple[str, ...]) -> IdentifierProblem | None:
    """Return the problem with a name: invalid form, reserved, or a keyword of a target language."""
    return (
        _validate_form(identifier) or _validate_not_reserved(identifier) or _validate_not_keyword(identifier, languages)
    )


def _iter_declaration_identifiers(
    declaration: Declaration, kind: str, path: DesignPath, *, is_shared: bool
) -> Iterator[Identifier]:
    yield Identifier(name=declaration.name, kind=kind, path=path, is_expression_name=is_shared)
    for argument in declaration.arguments or ():
        yield Identifier(name=argument.name, kind="argument", path=(*path, "arguments", argument.name))


def _validate_form(identifier: Identifier) -> IdentifierProblem | None:
    name, kind = identifier.name, identifier.kind
    if is_valid_name(name) or (kind == "state" and is_valid_state_name(name)):
        return None
    if name.startswith("_") and is_valid_state_name(name):
        return "D405", f"'{name}' starts with '_'; such names are reserved by the runtime", "remove the underscore"
    if len(name) > 80:
        return "D404", f"the name of this {kind} is longer than 80 characters", "use a shorter name"
    fix = "use ASCII letters, digits and underscores" + (", starting with a letter" if kind != "state" else "")
    return "D404", f"'{name}' is not a valid name for {with_article(kind)}", fix


def _validate_not_reserved(identifier: Identifier) -> IdentifierProblem | None:
    name, kind = identifier.name, identifier.kind
    fix = f"choose another name, such as {name}_value"
    # Parameters of hand-written components are passed by name and need not become attributes.
    is_member = kind in _MEMBERS and (identifier.is_expression_name or kind in ("output", "variable"))
    is_taken = (is_member and name in RESERVED_NAMES) or (kind in _WITH_SELF and name == "self")
    if is_taken or (kind, name) == ("element", "mro"):
        return "D405", f"'{name}' is reserved by the runtime", fix
    if identifier.is_expression_name and name in _EXPRESSION_WORDS:
        return "D407", f"'{name}' is already {_EXPRESSION_WORDS[name]}", fix
    return None


def keyword_languages(identifier: Identifier, languages: tuple[str, ...]) -> tuple[str, ...]:
    # Generated Python contains state names only in strings or after a prefix; no generated code contains agent names.
    exempt = {"state": {"python"}, "agent": set(LANGUAGES)}.get(identifier.kind, set())
    tested = [language for language in languages if language in LANGUAGES.keys() - exempt]
    return tuple(language for language in tested if identifier.name in LANGUAGES[language].keywords)


def _validate_not_keyword(identifier: Identifier, languages: tuple[str, ...]) -> IdentifierProblem | None:
    keyword_of = keyword_languages(identifier, languages)
    if not keyword_of:
        return None
    titles = " and ".join(LANGUAGES[language].title for language in keyword_of)
    return "D406", f"'{identifier.name}' is a keyword in {titles}", f"choose another name, such as my_{identifier.name}"
