"""References: the names of other components and of the project that designs read and set."""

import re
from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Assign, Call, Design
from vicode.model.project import Project
from vicode.model.texts import LocatedText, TextKind, iter_texts
from vicode.model.traversal import LocatedAction, iter_actions
from vicode.model.xabsl.names import list_symbols

READ, SET, CALL = "read", "set", "call"
_NAME = re.compile(r"(?<![\w.])(?:(?:self\.|self->|this->)_?)?([A-Za-z_]\w*)(?:(?:\.|->)([A-Za-z_]\w*))?(\s*=(?!=))?")
_SYMBOL = re.compile(r"@?[A-Za-z_][\w.]*(\s*=(?!=))?")

ReferenceKey = tuple[str, str, str]
"""Access (read, set or call), component ("" for the project), and name.

Parameters of calls end with `()`, the name of a call is "", elements are `Enumeration.element`.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """A place in a design; `state` is "" outside all states, `value` is the expression that is set."""

    component: str
    state: str
    path: DesignPath
    value: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolReferences:
    """The places that read and set names, in the order of the designs."""

    places_by_key: Mapping[ReferenceKey, tuple[Reference, ...]]

    def places(self, how: str, component: str, name: str) -> tuple[Reference, ...]:
        """The places that refer to a name."""
        return self.places_by_key.get((how, component, name), ())

    def users(self, how: str, component: str, name: str) -> Mapping[str, tuple[str, ...]]:
        """The designs that refer to a name, with their states."""
        found: dict[str, dict[str, None]] = {}
        for place in self.places(how, component, name):
            found.setdefault(place.component, {})[place.state] = None
        return {component: tuple(states) for component, states in found.items()}


def find_symbol_references(project: Project, shown: Project | None = None) -> SymbolReferences:
    """Find all references; `shown` is the project with the expressions that pages show as values."""
    found: dict[ReferenceKey, dict[Reference, None]] = {}
    symbols = dict(_symbols(project))
    for design, shown_design in zip(project.designs, (shown or project).designs, strict=True):
        for key, place in _design_references(project, design, symbols):
            found.setdefault(key, {})[place] = None
        for key, place in _writes(design, shown_design):
            found.setdefault(key, {})[place] = None
    return SymbolReferences(places_by_key={key: tuple(places) for key, places in found.items()})


def _design_references(
    project: Project, design: Design, symbols: Mapping[str, tuple[str, str]]
) -> Iterator[tuple[ReferenceKey, Reference]]:
    own = {declaration.name for _section, declaration in design.declarations()}
    scope = _Scope(
        component=design.component,
        aliases={use.alias: use.component for use in design.uses},
        own=own,
        shared=({each.name for each in project.constants} | {each.name for each in project.enumerations}) - own,
    )
    for placed in iter_texts(design):
        if placed.kind is not TextKind.DOC:
            is_xabsl = placed.language == "xabsl"
            keys = _xabsl_references(placed.text, symbols) if is_xabsl else _text_references(placed, scope)
            place = Reference(component=design.component, state=_state_name(placed), path=placed.path)
            yield from ((key, place) for key in keys)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scope:
    """The names that are visible in a design; `shared` are constants and enumerations."""

    component: str
    aliases: Mapping[str, str]
    own: Set[str]
    shared: Set[str]


def _text_references(placed: LocatedText, scope: _Scope) -> Iterator[ReferenceKey]:
    is_code = placed.kind is TextKind.CODE
    for match in _NAME.finditer(placed.text):
        first, member, sets = match.groups()
        if first in scope.aliases and member:
            yield SET if sets and is_code else READ, scope.aliases[first], member
        elif first in scope.own and (is_code or not sets):
            yield SET if sets else READ, scope.component, first
        elif first in scope.shared and not sets:
            yield READ, "", first
            if member:
                yield READ, "", f"{first}.{member}"


def _writes(design: Design, shown: Design) -> Iterator[tuple[ReferenceKey, Reference]]:
    """Yield what actions set (variables, and parameters of calls)."""
    aliases = {use.alias: use.component for use in design.uses}
    for placed, shown_action in zip(iter_actions(design), iter_actions(shown), strict=True):

        def place(value: str, *steps: str, placed: LocatedAction = placed) -> Reference:
            path = (*placed.path, *steps)
            return Reference(component=design.component, state=placed.state, path=path, value=value)

        match placed.action, shown_action.action:
            case Assign(values=values), Assign(values=shown_values):
                for (name, _text), (_name, value) in zip(values, shown_values, strict=True):
                    first, dot, member = name.partition(".")
                    owner = aliases.get(first, "") if dot else design.component
                    if owner:
                        yield (SET, owner, member or first), place(value, "set", name)
            case Call(alias=alias, arguments=arguments), Call(arguments=shown_values) if alias in aliases:
                yield (CALL, aliases[alias], ""), place("")
                for (name, _text), (_name, value) in zip(arguments, shown_values, strict=True):
                    yield (SET, aliases[alias], f"{name}()"), place(value)


def _xabsl_references(text: str, symbols: Mapping[str, tuple[str, str]]) -> Iterator[ReferenceKey]:
    for match in _SYMBOL.finditer(text):
        sets = match.group(1)
        name = match.group().removesuffix(sets or "").strip()
        if name in symbols:
            yield (SET if sets else READ, *symbols[name])


def _symbols(project: Project) -> Iterator[tuple[str, tuple[str, str]]]:
    for each in list_symbols(project):
        owner = each.path[1] if each.path[0] == "components" else each.component
        yield each.name, (str(owner), each.declaration.name)


def _state_name(placed: LocatedText) -> str:
    match placed.path:
        case ("states", str(name), *_):
            return name
        case ("common", *_):
            return COMMON
        case _:
            return ""
