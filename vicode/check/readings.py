"""Every expression of a design and of a project file, parsed against the type its place asks for."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

from vicode.check.words import words_of
from vicode.findings import Path
from vicode.model.design import Assign, Call, Declaration, Design, Use
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    Done,
    Minus,
    Mistake,
    Node,
    Number,
    Reading,
    Scope,
    Variable,
    parse_expression,
    scope_of,
    walk,
)
from vicode.model.project import Interface, Project
from vicode.model.walks import Located, PlacedAction


class Place(StrEnum):
    """What an expression is for."""

    FIRST = "first value"
    GUARD = "guard"
    TIME = "time"
    ASSIGNED = "assigned value"
    ARGUMENT = "argument"


@dataclass(frozen=True, slots=True, kw_only=True)
class Expression:
    """An expression at its place; `receiver` is what its value goes to, where that has a declaration."""

    place: Place
    path: Path
    text: str
    parsed: "Understood"
    receiver: Declaration | None = None

    @property
    def tree(self) -> Node | None:
        """Its tree, None when there is none."""
        return self.parsed.tree

    @property
    def is_sound(self) -> bool:
        """Whether its tree tells everything it reads."""
        return self.parsed.tree is not None and not self.parsed.mistakes


@dataclass(frozen=True, slots=True, kw_only=True)
class Understood:
    """A parsed text with the names and aliases it reads; of a text with mistakes both are all its words."""

    tree: Node | None
    mistakes: tuple[Mistake, ...]
    names: frozenset[str]
    aliases: frozenset[str]


Parser = Callable[[str, str | None], Understood]
"""Parses a text for the type its place expects."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reader:
    """The names of a design with a parser that remembers what it has parsed for the same names."""

    scope: Scope
    parse: Parser


def reader_of(project: Project, design: Design | None) -> Reader:
    """A reader of a design's expressions; without a design, of those in the project file."""
    if design is None:
        return _reader(replace(_NAMELESS, constants=project.constants, enumerations=project.enumerations), None)
    found = (project.interface(use.component) for use in design.uses)
    used = tuple(dict.fromkeys(interface for interface in found if interface is not None))
    vocabulary = replace(_NAMELESS, constants=project.constants, enumerations=project.enumerations, components=used)
    names = Design(
        component="",
        uses=tuple(Use(alias=use.alias, component=use.component) for use in design.uses),
        parameters=design.parameters,
        outputs=design.outputs,
        variables=design.variables,
    )
    return _reader(vocabulary, names)


_NAMELESS = Project(name="")


# The editor checks after every edit, and hardly ever do the names of a design change.
@lru_cache(maxsize=64)
def _reader(vocabulary: Project, names: Design | None) -> Reader:
    reader = plain_reader(scope_of(vocabulary, names))
    return replace(reader, parse=lru_cache(maxsize=20_000)(reader.parse))


def plain_reader(scope: Scope) -> Reader:
    """A reader without a memory."""
    return Reader(scope=scope, parse=lambda text, expected: understand(text, scope, expected))


def understand(text: str, scope: Scope, expected: str | None) -> Understood:
    """Parse a text and note what it reads."""
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.mistakes:
        names = aliases = frozenset(words_of(text))
    else:
        nodes = tuple(walk(parsed.tree))
        names = frozenset(node.name for node in nodes if isinstance(node, Variable))
        aliases = frozenset(node.alias for node in nodes if isinstance(node, Reading | Done))
    return Understood(tree=parsed.tree, mistakes=parsed.mistakes, names=names, aliases=aliases)


def read_expressions(
    design: Design, reader: Reader, decisions: Iterable[Located], actions: Iterable[PlacedAction]
) -> Iterator[Expression]:
    """Every expression of a design, in the order of its file."""
    for section, declaration in design.declarations():
        yield from read_first_values(declaration, (section, declaration.name), reader)
    for located in decisions:
        guard = located.decision.guard
        if guard.when:
            yield _read(Place.GUARD, (*located.path, "when"), guard.when, reader, expected=BOOL)
        if guard.after:
            yield _read(Place.TIME, (*located.path, "after"), guard.after, reader, expected=FLOAT)
    for placed in actions:
        yield from _read_action(placed, reader)


def read_first_values(declaration: Declaration, path: Path, reader: Reader) -> Iterator[Expression]:
    """The first value of a declaration and the defaults of its arguments."""
    if declaration.initial:
        key = {"parameters": "default", "constants": "value", "arguments": "default"}.get(str(path[-2]), "initial")
        yield _read(Place.FIRST, (*path, key), declaration.initial, reader, receiver=declaration)
    for argument in declaration.arguments or ():
        yield from read_first_values(argument, (*path, "arguments", argument.name), reader)


def literal_value(tree: Node | None, scope: Scope) -> float | None:
    """The number that a literal, or a constant with a literal value, stands for; None for anything else."""
    match tree:
        case Number(value=value):
            return value
        case Minus(operand=Number(value=value)):
            return -value
        case Variable(name=name, kind="constant"):
            symbol = scope.symbols.get(name)
            return _number(symbol.declaration.initial) if symbol else None
        case _:
            return None


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _read_action(placed: PlacedAction, reader: Reader) -> Iterator[Expression]:
    match placed.action:
        case Assign(values=values):
            for name, text in values:
                path = (*placed.path, "set", name)
                yield _read(Place.ASSIGNED, path, text, reader, receiver=reader.scope.settable(name))
        case Call(alias=alias, arguments=arguments):
            interface: Interface | None = reader.scope.uses.get(alias)
            middle = () if placed.phase == "modulates" else ("with",)
            for name, text in arguments:
                parameter = interface.parameter(name) if interface else None
                yield _read(Place.ARGUMENT, (*placed.path, *middle, name), text, reader, receiver=parameter)


def _read(
    place: Place,
    path: Path,
    text: str,
    reader: Reader,
    *,
    expected: str | None = None,
    receiver: Declaration | None = None,
) -> Expression:
    if receiver is not None:
        expected = reader.scope.type_of(receiver)
    parsed = reader.parse(text, expected)
    return Expression(place=place, path=path, text=text, parsed=parsed, receiver=receiver)
