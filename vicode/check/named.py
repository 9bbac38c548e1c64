"""Everything that has a name in a design or in a project file, with what a name must be there."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.bica import RESERVED_NAMES
from vicode.check.keywords import KEYWORDS, SHOWN
from vicode.findings import Path
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS
from vicode.model.names import is_name, is_state_name
from vicode.model.project import Project

_MEMBERS = {"alias", "parameter", "output", "variable"}
_WITH_SELF = {*_MEMBERS, "argument"}
_TIMES = frozenset({"state_time", "component_time", "action_done", "conflict"})
_OWN_WORDS = {
    **dict.fromkeys(FUNCTIONS, "a function of expressions"),
    **dict.fromkeys(("done", "True", "False", "true", "false", *_TIMES), "a word of expressions"),
    **dict.fromkeys(("bool", "int", "float"), "a type"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Named:
    """A name: what it names, in the user's word, and where it stands; `is_shared` if expressions may say it."""

    name: str
    what: str
    path: Path
    is_shared: bool = False
    of_key: bool = True


Problem = tuple[str, str, str]
"""Code, message and mend."""


def with_article(what: str) -> str:
    """The word with a or an before it."""
    return f"an {what}" if what[0] in "aeiou" else f"a {what}"


def names_of_design(design: Design) -> Iterator[Named]:
    """Every name in a design, in the order of its file."""
    yield Named(name=design.component, what="component", path=("component",), of_key=False)
    for use in design.uses:
        yield Named(name=use.alias, what="alias", path=("uses", use.alias), is_shared=True)
    for section, declaration in design.declarations():
        yield from _declared(declaration, section.removesuffix("s"), (section, declaration.name), is_shared=True)
    for state in design.states:
        yield Named(name=state.name, what="state", path=("states", state.name))


def names_of_project(project: Project) -> Iterator[Named]:
    """Every name in a project file, in the order of its file."""
    yield from names_for_designs(project)
    for interface in project.components:
        path: Path = ("components", interface.component)
        yield Named(name=interface.component, what="hand-written component", path=path)
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(interface, section):
                here = (*path, section, declaration.name)
                yield from _declared(declaration, section.removesuffix("s"), here, is_shared=False)
    for agent in project.agents:
        yield Named(name=agent.name, what="agent", path=("agents", agent.name))


def names_for_designs(project: Project) -> Iterator[Named]:
    """Those names of a project file that expressions of its designs may say."""
    for enumeration in project.enumerations:
        path: Path = ("enumerations", enumeration.name)
        yield Named(name=enumeration.name, what="enumeration", path=path, is_shared=True)
        for element in enumeration.element_names:
            yield Named(name=element, what="element", path=(*path, "elements", element))
    for constant in project.constants:
        yield from _declared(constant, "constant", ("constants", constant.name), is_shared=True)


def name_problem(named: Named, languages: tuple[str, ...]) -> Problem | None:
    """What is wrong with a name: its shape, or that the runtime, expressions or a language keep it for themselves."""
    return _shape_problem(named) or _reserved_problem(named) or _keyword_problem(named, languages)


def _declared(declaration: Declaration, what: str, path: Path, *, is_shared: bool) -> Iterator[Named]:
    yield Named(name=declaration.name, what=what, path=path, is_shared=is_shared)
    for argument in declaration.arguments or ():
        yield Named(name=argument.name, what="argument", path=(*path, "arguments", argument.name))


def _shape_problem(named: Named) -> Problem | None:
    name, what = named.name, named.what
    if is_name(name) or (what == "state" and is_state_name(name)):
        return None
    if name.startswith("_") and is_state_name(name):
        return "D405", f"'{name}' begins with '_', which the runtime keeps for itself", "drop the underscore"
    if len(name) > 80:
        return "D404", f"the name of this {what} is longer than 80 characters", "shorten it"
    mend = "use letters, digits and underscores" + (", a letter first" if what != "state" else "")
    return "D404", f"'{name}' cannot be the name of {with_article(what)}", mend


def _reserved_problem(named: Named) -> Problem | None:
    name, what = named.name, named.what
    mend = f"choose another name, such as {name}_value"
    # Parameters of hand-written components are handed over by name and need not become attributes.
    is_member = what in _MEMBERS and (named.is_shared or what in ("output", "variable"))
    is_taken = (is_member and name in RESERVED_NAMES) or (what in _WITH_SELF and name == "self")
    if is_taken or (what, name) == ("element", "mro"):
        return "D405", f"'{name}' is a name of the runtime", mend
    if named.is_shared and name in _OWN_WORDS:
        return "D407", f"'{name}' is already {_OWN_WORDS[name]}", mend
    return None


def keyword_languages(named: Named, languages: tuple[str, ...]) -> tuple[str, ...]:
    """The languages that keep a name for themselves."""
    # In Python a state's name only ever stands in a string or behind a prefix, an agent's never in code.
    spared = {"state": {"python"}, "agent": set(KEYWORDS)}.get(named.what, set())
    return tuple(each for each in languages if each not in spared and named.name in KEYWORDS.get(each, ()))


def _keyword_problem(named: Named, languages: tuple[str, ...]) -> Problem | None:
    guilty = keyword_languages(named, languages)
    if not guilty:
        return None
    shown = " and ".join(SHOWN[each] for each in guilty)
    return "D406", f"'{named.name}' is a keyword in {shown}", f"choose another name, such as my_{named.name}"
