"""The typed tree of an expression.

`type` is "bool", "int", "float", the name of an enumeration, or UNKNOWN after an error. `span` refers to the text.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from vicode.findings import Span

BOOL, INT, FLOAT, UNKNOWN = "bool", "int", "float", "?"
TEAM_SIZE = "team_size"


@dataclass(frozen=True, slots=True, kw_only=True)
class Number:
    """A non-negative number literal."""

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
    """An enumeration literal such as `Side.left`; its type is the name of the enumeration."""

    element: str
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A variable, output or parameter of the component, or a constant; `kind` is a `ScopeSymbolKind`."""

    name: str
    kind: str
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class ElapsedTime:
    """`state_time` or `component_time` (`kind` is "state" or "component"), in seconds."""

    kind: str
    span: Span
    type: str = FLOAT


@dataclass(frozen=True, slots=True, kw_only=True)
class StatusFlag:
    """`action_done` (a component called by the active state is done), `conflict` (its capacity is exceeded), or
    `team_size` (the number of robots that are alive, an int).
    """

    name: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """done(alias): whether the used component was in a final state after its last step."""

    alias: str
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputRef:
    """An output of a used component; `arguments` are pairs of name and node, None if it takes none."""

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
    """A chain such as `a < b <= c`: n operators and n + 1 operands, each evaluated at most once, left to right."""

    operators: tuple[str, ...]
    operands: "tuple[Expr, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Logic:
    """`and` or `or` with two or more operands, with short-circuit evaluation."""

    operator: str
    operands: "tuple[Expr, ...]"
    span: Span
    type: str = BOOL


@dataclass(frozen=True, slots=True, kw_only=True)
class Ternary:
    """`then if test else otherwise`; only the selected branch is evaluated."""

    test: "Expr"
    then: "Expr"
    otherwise: "Expr"
    type: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionCall:
    """A call of a built-in function."""

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
    """Return the direct operands in evaluation order."""
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
    """Yield a node and its descendants in pre-order."""
    yield node
    for child in children(node):
        yield from walk(child)


def map_tree(node: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """Apply a change to a tree, from its leaves to its root."""
    match node:
        case Not(operand=operand) | Minus(operand=operand):
            node = replace(node, operand=map_tree(operand, change))
        case Binary(left=left, right=right):
            node = replace(node, left=map_tree(left, change), right=map_tree(right, change))
        case Comparison(operands=operands) | Logic(operands=operands):
            node = replace(node, operands=tuple(map_tree(each, change) for each in operands))
        case Ternary(test=test, then=then, otherwise=otherwise):
            test, then, otherwise = (map_tree(each, change) for each in (test, then, otherwise))
            node = replace(node, test=test, then=then, otherwise=otherwise)
        case FunctionCall(arguments=arguments):
            node = replace(node, arguments=tuple(map_tree(each, change) for each in arguments))
        case OutputRef(arguments=pairs) if pairs:
            node = replace(node, arguments=tuple((name, map_tree(value, change)) for name, value in pairs))
        case _:
            pass
    return change(node)
