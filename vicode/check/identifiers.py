"""Everything that has a name in a design or in a project file, with what a name must be there."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.bica import RESERVED_NAMES
from vicode.check.keywords import KEYWORDS, LANGUAGE_TITLES
from vicode.findings import DesignPath
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS
from vicode.model.names import is_valid_name, is_valid_state_name
from vicode.model.project import Project

_MEMBERS = {"alias", "parameter", "output", "variable"}
_WITH_SELF = {*_MEMBERS, "argument"}
_TIMES = frozenset({"state_time", "component_time", "action_done", "conflict"})
_EXPRESSION_WORDS = {
    **dict.fromkeys(FUNCTIONS, "a function of expressions"),
    **dict.fromkeys(("done", "True", "False", "true", "false", *_TIMES), "a word of expressions"),
    **dict.fromkeys(("bool", "int", "float"), "a type"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Identifier:
    """A name: what it names, in the user's word, and where it stands; `is_expression_name` if expressions may say it."""

    name: str
    kind: str
    path: DesignPath
    is_expression_name: bool = False
    is_key: bool = True


IdentifierProblem = tuple[str, str, str]
"""Code, message and mend."""


def with_article(what: str) -> str:
    """The word with a or an before it."""
    return f"an {what}" if what[0] in "aeiou" else f"a {what}"


def iter_design_identifiers(design: Design) -> Iterator[Identifier]:
    """Every name in a design, in the order of its file."""
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
    """Every name in a project file, in the order of its file."""
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
    """Those names of a project file that expressions of its designs may say."""
    for enumeration in project.enumerations:
        path: DesignPath = ("enumerations", enumeration.name)
        yield Identifier(name=enumeration.name, kind="enumeration", path=path, is_expression_name=True)
        for element in enumeration.element_names:
            yield Identifier(name=element, kind="element", path=(*path, "elements", element))
    for constant in project.constants:
        yield from _iter_declaration_identifiers(constant, "constant", ("constants", constant.name), is_shared=True)


def validate_identifier(identifier: Identifier, languages: tuple[str, ...]) -> IdentifierProblem | None:
    """What is wrong with a name: its shape, or that the runtime, expressions or a language keep it for themselves."""
    return (
        _validate_form(identifier) or _validate_not_reserved(identifier) or _validate_not_keyword(identifier, languages)
    )


def _iter_declaration_identifiers(
    declaration: Declaration, what: str, path: DesignPath, *, is_shared: bool
) -> Iterator[Identifier]:
    yield Identifier(name=declaration.name, kind=what, path=path, is_expression_name=is_shared)
    for argument in declaration.arguments or ():
        yield Identifier(name=argument.name, kind="argument", path=(*path, "arguments", argument.name))


def _validate_form(named: Identifier) -> IdentifierProblem | None:
    name, what = named.name, named.kind
    if is_valid_name(name) or (what == "state" and is_valid_state_name(name)):
        return None
    if name.startswith("_") and is_valid_state_name(name):
        return "D405", f"'{name}' begins with '_', which the runtime keeps for itself", "drop the underscore"
    if len(name) > 80:
        return "D404", f"the name of this {what} is longer than 80 characters", "shorten it"
    mend = "use letters, digits and underscores" + (", a letter first" if what != "state" else "")
    return "D404", f"'{name}' cannot be the name of {with_article(what)}", mend


def _validate_not_reserved(named: Identifier) -> IdentifierProblem | None:
    name, what = named.name, named.kind
    mend = f"choose another name, such as {name}_value"
    # Parameters of hand-written components are handed over by name and need not become attributes.
    is_member = what in _MEMBERS and (named.is_expression_name or what in ("output", "variable"))
    is_taken = (is_member and name in RESERVED_NAMES) or (what in _WITH_SELF and name == "self")
    if is_taken or (what, name) == ("element", "mro"):
        return "D405", f"'{name}' is a name of the runtime", mend
    if named.is_expression_name and name in _EXPRESSION_WORDS:
        return "D407", f"'{name}' is already {_EXPRESSION_WORDS[name]}", mend
    return None


def keyword_languages(identifier: Identifier, languages: tuple[str, ...]) -> tuple[str, ...]:
    """The languages that keep a name for themselves."""
    # In Python a state's name only ever stands in a string or behind a prefix, an agent's never in code.
    spared = {"state": {"python"}, "agent": set(KEYWORDS)}.get(identifier.kind, set())
    return tuple(each for each in languages if each not in spared and identifier.name in KEYWORDS.get(each, ()))


def _validate_not_keyword(named: Identifier, languages: tuple[str, ...]) -> IdentifierProblem | None:
    guilty = keyword_languages(named, languages)
    if not guilty:
        return None
    shown = " and ".join(LANGUAGE_TITLES[each] for each in guilty)
    return "D406", f"'{named.name}' is a keyword in {shown}", f"choose another name, such as my_{named.name}"
