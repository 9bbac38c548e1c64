"""The typed tree of an expression; every language is spelt from it and analysis reads it.

`type` is "bool", "int", "float", an enumeration's name, or UNKNOWN after a mistake; `span` are characters of the text.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.findings import Span

BOOL, INT, FLOAT, UNKNOWN = "bool", "int", "float", "?"


@dataclass(frozen=True, slots=True, kw_only=True)
class Number:
    """A literal number, never negative."""

    value: int | float
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Boolean:
    """True or False."""

    value: bool
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class EnumElement:
    """A literal of an enumeration: `Side.left`; its type is the enumeration's name."""

    element: str
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """An own variable, output or parameter, or a constant of the project; `kind` says which."""

    name: str
    kind: str
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class ElapsedTime:
    """`state_time` or `component_time` (`of` is "state" or "component"), in seconds."""

    kind: str
    span: Span
    type: str = FLOAT


@dataclass(frozen=True, slots=True, kw_only=True)
class StatusFlag:
    """`action_done` (a component that the active state calls is done) or `conflict` (too many robots are in it)."""

    name: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """done(alias): the used component was in a final state after its latest work."""

    alias: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputRef:
    """An output of a used component; `arguments` are pairs of name and node, None when it takes none."""

    alias: str
    output: str
    arguments: "tuple[tuple[str, Expr], ...] | None" = None
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Not:
    """Logical negation."""

    operand: "Expr"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Minus:
    """Arithmetic negation."""

    operand: "Expr"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Binary:
    """Arithmetic: + - * keep int, / // % always give float."""

    operator: str
    left: "Expr"
    right: "Expr"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A chain `a < b <= c`: n operators between n + 1 operands, each operand evaluated once at most, left to right."""

    operators: tuple[str, ...]
    operands: "tuple[Expr, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Logic:
    """`and` or `or` of two or more, evaluated left to right until it is decided."""

    operator: str
    operands: "tuple[Expr, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Ternary:
    """`then if test else otherwise`; only the chosen side is evaluated."""

    test: "Expr"
    then: "Expr"
    otherwise: "Expr"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionCall:
    """A listed function applied to arguments."""

    function: str
    arguments: "tuple[Expr, ...]"
    type: str
    span: Span


Expr = (
    Number
    | Boolean
    | EnumElement
    | Variable
    | ElapsedTime
    | StatusFlag
    | Done
    | OutputRef
    | Not
    | Minus
    | Binary
    | Comparison
    | Logic
    | Ternary
    | FunctionCall
)


def children(node: Expr) -> tuple[Expr, ...]:
    """Direct operands in the order they are evaluated."""
    match node:
        case Not(operand=operand) | Minus(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Comparison(operands=operands) | Logic(operands=operands):
            return operands
        case Ternary(test=test, then=then, otherwise=otherwise):
            return (test, then, otherwise)
        case FunctionCall(arguments=arguments):
            return arguments
        case OutputRef(arguments=pairs) if pairs:
            return tuple(value for _name, value in pairs)
        case _:
            return ()


def walk(node: Expr) -> Iterator[Expr]:
    """The node and all below it, parents first."""
    yield node
    for child in children(node):
        yield from walk(child)
