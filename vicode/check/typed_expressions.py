"""Every expression of a design and of a project file, parsed against the type its place asks for."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

from vicode.check.identifiers_in_text import find_identifiers
from vicode.findings import DesignPath
from vicode.model.design import Assign, Call, Declaration, Design, Use
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    Done,
    Expr,
    ExpressionDiagnostic,
    Minus,
    Number,
    OutputRef,
    Scope,
    Variable,
    build_scope,
    parse_expression,
    walk,
)
from vicode.model.project import Interface, Project
from vicode.model.traversal import LocatedAction, LocatedDecision


class ExpressionSite(StrEnum):
    """What an expression is for."""

    INITIAL_VALUE = "first value"
    GUARD = "guard"
    AFTER = "time"
    ASSIGNED_VALUE = "assigned value"
    ARGUMENT = "argument"


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedExpression:
    """An expression at its place; `receiver` is what its value goes to, where that has a declaration."""

    site: ExpressionSite
    path: DesignPath
    text: str
    analysis: "ExpressionAnalysis"
    receiver: Declaration | None = None

    @property
    def tree(self) -> Expr | None:
        """Its tree, None when there is none."""
        return self.analysis.tree

    @property
    def is_sound(self) -> bool:
        """Whether its tree tells everything it reads."""
        return self.analysis.tree is not None and not self.analysis.diagnostics


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionAnalysis:
    """A parsed text with the names and aliases it reads; of a text with mistakes both are all its words."""

    tree: Expr | None
    diagnostics: tuple[ExpressionDiagnostic, ...]
    names: frozenset[str]
    aliases: frozenset[str]


ParseFunction = Callable[[str, str | None], ExpressionAnalysis]
"""Parses a text for the type its place expects."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionParser:
    """The names of a design with a parser that remembers what it has parsed for the same names."""

    scope: Scope
    parse: ParseFunction


def build_expression_parser(project: Project, design: Design | None) -> ExpressionParser:
    """A reader of a design's expressions; without a design, of those in the project file."""
    if design is None:
        return _build_cached_parser(
            replace(_EMPTY_PROJECT, constants=project.constants, enumerations=project.enumerations), None
        )
    found = (project.interface(use.component) for use in design.uses)
    used = tuple(dict.fromkeys(interface for interface in found if interface is not None))
    vocabulary = replace(
        _EMPTY_PROJECT, constants=project.constants, enumerations=project.enumerations, components=used
    )
    names = Design(
        component="",
        uses=tuple(Use(alias=use.alias, component=use.component) for use in design.uses),
        parameters=design.parameters,
        outputs=design.outputs,
        variables=design.variables,
    )
    return _build_cached_parser(vocabulary, names)


_EMPTY_PROJECT = Project(name="")


# The editor checks after every edit, and hardly ever do the names of a design change.
@lru_cache(maxsize=64)
def _build_cached_parser(vocabulary: Project, names: Design | None) -> ExpressionParser:
    reader = build_uncached_parser(build_scope(vocabulary, names))
    return replace(reader, parse=lru_cache(maxsize=20_000)(reader.parse))


def build_uncached_parser(scope: Scope) -> ExpressionParser:
    """A reader without a memory."""
    return ExpressionParser(scope=scope, parse=lambda text, expected: analyze_expression(text, scope, expected))


def analyze_expression(text: str, scope: Scope, expected: str | None) -> ExpressionAnalysis:
    """Parse a text and note what it reads."""
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.diagnostics:
        names = aliases = frozenset(find_identifiers(text))
    else:
        nodes = tuple(walk(parsed.tree))
        names = frozenset(node.name for node in nodes if isinstance(node, Variable))
        aliases = frozenset(node.alias for node in nodes if isinstance(node, OutputRef | Done))
    return ExpressionAnalysis(tree=parsed.tree, diagnostics=parsed.diagnostics, names=names, aliases=aliases)


def parse_expressions(
    design: Design, parser: ExpressionParser, decisions: Iterable[LocatedDecision], actions: Iterable[LocatedAction]
) -> Iterator[TypedExpression]:
    """Every expression of a design, in the order of its file."""
    for section, declaration in design.declarations():
        yield from parse_initial_values(declaration, (section, declaration.name), parser)
    for located in decisions:
        guard = located.decision.guard
        if guard.when:
            yield _parse(ExpressionSite.GUARD, (*located.path, "when"), guard.when, parser, expected=BOOL)
        if guard.after:
            yield _parse(ExpressionSite.AFTER, (*located.path, "after"), guard.after, parser, expected=FLOAT)
    for placed in actions:
        yield from _parse_action(placed, parser)


def parse_initial_values(
    declaration: Declaration, path: DesignPath, parser: ExpressionParser
) -> Iterator[TypedExpression]:
    """The first value of a declaration and the defaults of its arguments."""
    if declaration.initial:
        key = {"parameters": "default", "constants": "value", "arguments": "default"}.get(str(path[-2]), "initial")
        yield _parse(ExpressionSite.INITIAL_VALUE, (*path, key), declaration.initial, parser, receiver=declaration)
    for argument in declaration.arguments or ():
        yield from parse_initial_values(argument, (*path, "arguments", argument.name), parser)


def literal_value(tree: Expr | None, scope: Scope) -> float | None:
    """The number that a literal, or a constant with a literal value, stands for; None for anything else."""
    match tree:
        case Number(value=value):
            return value
        case Minus(operand=Number(value=value)):
            return -value
        case Variable(name=name, kind="constant"):
            symbol = scope.symbols.get(name)
            return _parse_number(symbol.declaration.initial) if symbol else None
        case _:
            return None


def _parse_number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _parse_action(placed: LocatedAction, reader: ExpressionParser) -> Iterator[TypedExpression]:
    match placed.action:
        case Assign(values=values):
            for name, text in values:
                path = (*placed.path, "set", name)
                yield _parse(
                    ExpressionSite.ASSIGNED_VALUE, path, text, reader, receiver=reader.scope.find_assignable(name)
                )
        case Call(alias=alias, arguments=arguments):
            interface: Interface | None = reader.scope.uses.get(alias)
            middle = () if placed.phase == "modulates" else ("with",)
            for name, text in arguments:
                parameter = interface.parameter(name) if interface else None
                yield _parse(ExpressionSite.ARGUMENT, (*placed.path, *middle, name), text, reader, receiver=parameter)


def _parse(
    place: ExpressionSite,
    path: DesignPath,
    text: str,
    reader: ExpressionParser,
    *,
    expected: str | None = None,
    receiver: Declaration | None = None,
) -> TypedExpression:
    if receiver is not None:
        expected = reader.scope.type_of(receiver)
    parsed = reader.parse(text, expected)
    return TypedExpression(site=place, path=path, text=text, analysis=parsed, receiver=receiver)
