"""The expressions of a design or project file, parsed with their expected types."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from vicode.check.identifiers_in_text import find_identifiers
from vicode.findings import DesignPath
from vicode.model.design import Assign, Call, Declaration, Design, InvariantProperty, ReachProperty
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
    is_type_only,
    parse_expression,
    walk,
)
from vicode.model.project import Interface
from vicode.model.traversal import LocatedAction, LocatedDecision, iter_construct_expressions


class ExpressionSite(StrEnum):
    """The role of an expression."""

    INITIAL_VALUE = "initial value"
    GUARD = "guard"
    AFTER = "time"
    ASSIGNED_VALUE = "assigned value"
    ARGUMENT = "argument"
    PROPERTY = "property"


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedExpression:
    """A parsed expression. `receiver` is the declaration that its value is assigned to, if any."""

    site: ExpressionSite
    path: DesignPath
    text: str
    analysis: "ExpressionAnalysis"
    receiver: Declaration | None = None

    @property
    def tree(self) -> Expr | None:
        return self.analysis.tree

    @property
    def is_sound(self) -> bool:
        """Whether the expression was parsed without errors."""
        return self.analysis.tree is not None and not self.analysis.diagnostics


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionAnalysis:
    """A parsed text with the names and aliases that it reads; with errors, both contain all identifiers of the text."""

    tree: Expr | None
    diagnostics: tuple[ExpressionDiagnostic, ...]
    names: frozenset[str]
    aliases: frozenset[str]


@lru_cache(maxsize=1 << 16)
def analyze_expression(text: str, scope: Scope, expected: str | None) -> ExpressionAnalysis:
    """Parse a text and collect the names that it reads."""
    parsed = parse_expression(text, scope, expected)
    if parsed.tree is None or parsed.diagnostics:
        names = aliases = frozenset(find_identifiers(text))
    else:
        nodes = tuple(walk(parsed.tree))
        names = frozenset(node.name for node in nodes if isinstance(node, Variable))
        aliases = frozenset(node.alias for node in nodes if isinstance(node, OutputRef | Done))
    return ExpressionAnalysis(tree=parsed.tree, diagnostics=parsed.diagnostics, names=names, aliases=aliases)


def parse_expressions(
    design: Design, scope: Scope, decisions: Iterable[LocatedDecision], actions: Iterable[LocatedAction]
) -> Iterator[TypedExpression]:
    """Yield the expressions of a design, in file order."""
    for section, declaration in design.declarations():
        yield from parse_initial_values(declaration, (section, declaration.name), scope)
    for located in decisions:
        guard = located.decision.guard
        if guard.when:
            yield _parse(ExpressionSite.GUARD, (*located.path, "when"), guard.when, scope, expected=BOOL)
        if guard.after:
            yield _parse(ExpressionSite.AFTER, (*located.path, "after"), guard.after, scope, expected=FLOAT)
    for placed in actions:
        yield from _parse_action(placed, scope)
    for construct in iter_construct_expressions(design):
        site = ExpressionSite.GUARD if construct.expected == BOOL else ExpressionSite.AFTER
        yield _parse(site, construct.path, construct.text, scope, expected=construct.expected)
    for index, promised in enumerate(design.properties):
        match promised:
            case ReachProperty(within=within) if within:
                yield _parse(ExpressionSite.AFTER, ("properties", index, "within"), within, scope, expected=FLOAT)
            case InvariantProperty(holds=holds):
                yield _parse(ExpressionSite.PROPERTY, ("properties", index, "holds"), holds, scope, expected=BOOL)


def parse_initial_values(declaration: Declaration, path: DesignPath, scope: Scope) -> Iterator[TypedExpression]:
    """Yield the initial value of a declaration and the defaults of its arguments."""
    if declaration.initial and not is_type_only(declaration, scope):
        key = {"parameters": "default", "constants": "value", "arguments": "default"}.get(str(path[-2]), "initial")
        yield _parse(ExpressionSite.INITIAL_VALUE, (*path, key), declaration.initial, scope, receiver=declaration)
    for argument in declaration.arguments or ():
        yield from parse_initial_values(argument, (*path, "arguments", argument.name), scope)


def literal_value(tree: Expr | None, scope: Scope) -> float | None:
    """Return the value of a number or of a constant with a literal value, otherwise None."""
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


def _parse_action(placed: LocatedAction, scope: Scope) -> Iterator[TypedExpression]:
    match placed.action:
        case Assign(values=values):
            for name, text in values:
                path = (*placed.path, "set", name)
                yield _parse(ExpressionSite.ASSIGNED_VALUE, path, text, scope, receiver=scope.find_assignable(name))
        case Call(alias=alias, arguments=arguments):
            interface: Interface | None = scope.uses.get(alias)
            middle = () if placed.phase == "modulates" else ("with",)
            for name, text in arguments:
                parameter = interface.parameter(name) if interface else None
                yield _parse(ExpressionSite.ARGUMENT, (*placed.path, *middle, name), text, scope, receiver=parameter)


def _parse(
    site: ExpressionSite,
    path: DesignPath,
    text: str,
    scope: Scope,
    *,
    expected: str | None = None,
    receiver: Declaration | None = None,
) -> TypedExpression:
    if receiver is not None:
        expected = scope.type_of(receiver)
    parsed = analyze_expression(text, scope, expected)
    return TypedExpression(site=site, path=path, text=text, analysis=parsed, receiver=receiver)
