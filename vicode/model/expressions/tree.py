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
class Truth:
    """True or False."""

    value: bool
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Element:
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
class Time:
    """`state_time` or `component_time` (`of` is "state" or "component"), in seconds."""

    of: str
    span: Span
    type: str = FLOAT


@dataclass(frozen=True, slots=True, kw_only=True)
class Status:
    """`action_done` (a component that the active state calls is done) or `conflict` (too many robots are in it)."""

    of: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """done(alias): the used component was in a final state after its latest work."""

    alias: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """An output of a used component; `arguments` are pairs of name and node, None when it takes none."""

    alias: str
    output: str
    arguments: "tuple[tuple[str, Node], ...] | None" = None
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Not:
    """Logical negation."""

    operand: "Node"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Minus:
    """Arithmetic negation."""

    operand: "Node"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Binary:
    """Arithmetic: + - * keep int, / // % always give float."""

    operator: str
    left: "Node"
    right: "Node"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A chain `a < b <= c`: n operators between n + 1 operands, each operand evaluated once at most, left to right."""

    operators: tuple[str, ...]
    operands: "tuple[Node, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Logic:
    """`and` or `or` of two or more, evaluated left to right until it is decided."""

    operator: str
    operands: "tuple[Node, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """`then if test else otherwise`; only the chosen side is evaluated."""

    test: "Node"
    then: "Node"
    otherwise: "Node"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Apply:
    """A listed function applied to arguments."""

    function: str
    arguments: "tuple[Node, ...]"
    type: str
    span: Span


Node = (
    Number
    | Truth
    | Element
    | Variable
    | Time
    | Status
    | Done
    | Reading
    | Not
    | Minus
    | Binary
    | Comparison
    | Logic
    | Choice
    | Apply
)


def children(node: Node) -> tuple[Node, ...]:
    """Direct operands in the order they are evaluated."""
    match node:
        case Not(operand=operand) | Minus(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Comparison(operands=operands) | Logic(operands=operands):
            return operands
        case Choice(test=test, then=then, otherwise=otherwise):
            return (test, then, otherwise)
        case Apply(arguments=arguments):
            return arguments
        case Reading(arguments=pairs) if pairs:
            return tuple(value for _name, value in pairs)
        case _:
            return ()


def walk(node: Node) -> Iterator[Node]:
    """The node and all below it, parents first."""
    yield node
    for child in children(node):
        yield from walk(child)
