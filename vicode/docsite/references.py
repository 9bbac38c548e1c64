"""References: the names of other components and of the project that designs read and set."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.model.design import COMMON, Assign, Call, Design
from vicode.model.project import Project
from vicode.model.texts import LocatedText, TextKind, iter_texts
from vicode.model.traversal import iter_actions
from vicode.model.xabsl.names import list_symbols

READ, SET = "read", "set"
_NAME = re.compile(r"(?<![\w.])(?:(?:self\.|self->|this->)_?)?([A-Za-z_]\w*)(?:(?:\.|->)([A-Za-z_]\w*))?(\s*=(?!=))?")
_SYMBOL = re.compile(r"@?[A-Za-z_][\w.]*(\s*=(?!=))?")

ReferenceKey = tuple[str, str, str]
"""Access (read or set), component ("" for the project), and name; parameters end with `()`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolReferences:
    """The designs that refer to a symbol, each with the states of the references; "" is outside all states."""

    users_by_key: Mapping[ReferenceKey, Mapping[str, tuple[str, ...]]]

    def users(self, how: str, component: str, name: str) -> Mapping[str, tuple[str, ...]]:
        """The designs that refer to a name, with their states."""
        return self.users_by_key.get((how, component, name), {})


def find_symbol_references(project: Project) -> SymbolReferences:
    found: dict[ReferenceKey, dict[str, dict[str, None]]] = {}
    symbols = dict(_symbols(project))
    for design in project.designs:
        for key, state in _design_references(project, design, symbols):
            found.setdefault(key, {}).setdefault(design.component, {})[state] = None
    return SymbolReferences(
        users_by_key={key: {component: tuple(states) for component, states in by.items()} for key, by in found.items()}
    )


def _design_references(
    project: Project, design: Design, symbols: Mapping[str, tuple[str, str]]
) -> Iterator[tuple[ReferenceKey, str]]:
    aliases = {use.alias: use.component for use in design.uses}
    own = {declaration.name for _section, declaration in design.declarations()}
    shared = ({each.name for each in project.constants} | {each.name for each in project.enumerations}) - own
    for placed in iter_texts(design):
        if placed.kind is TextKind.DOC:
            continue
        state = _state_name(placed)
        if placed.language == "xabsl":
            yield from ((key, state) for key in _xabsl_references(placed.text, symbols))
            continue
        for match in _NAME.finditer(placed.text):
            first, member, sets = match.groups()
            if first in aliases and member:
                how = SET if sets and placed.kind is TextKind.CODE else READ
                yield (how, aliases[first], member), state
            elif first in own and placed.kind is TextKind.CODE and sets:
                yield (SET, design.component, first), state
            elif first in own and not sets:
                yield (READ, design.component, first), state
            elif first in shared and not sets:
                yield (READ, "", first), state
    yield from _writes(design, aliases)


def _writes(design: Design, aliases: Mapping[str, str]) -> Iterator[tuple[ReferenceKey, str]]:
    """Yield what actions set (variables, and parameters of calls), with the state."""
    for placed in iter_actions(design):
        match placed.action:
            case Assign(values=values):
                for name, _text in values:
                    first, dot, member = name.partition(".")
                    owner = aliases.get(first, "") if dot else design.component
                    if owner:
                        yield (SET, owner, member or first), placed.state
            case Call(alias=alias, arguments=arguments) if alias in aliases:
                for name, _text in arguments:
                    yield (SET, aliases[alias], f"{name}()"), placed.state


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
