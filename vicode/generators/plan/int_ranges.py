"""The ranges of int expressions: which results need no function that limits them (docs/semantics.md, "Ints").

This is interval analysis. Values that a design stores lie within ±2**53, so most results provably fit into 64 bits, and
generated code computes them with plain operators. The ranges of variables are found by `int_growth`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from vicode.model.expressions import (
    INT,
    Binary,
    Expr,
    FunctionCall,
    Minus,
    Number,
    OutputRef,
    ScopeSymbolKind,
    StatusFlag,
    Ternary,
    Variable,
)

Interval = tuple[int, int]
"""The least and the greatest value."""

STORED: Interval = (-(2**53), 2**53)
"""Ints that a design stores."""
RESULT: Interval = (-(2**63), 2**63 - 1)
"""Results of operations on ints."""
_TEAM: Interval = (0, 2**32)

Offsets = tuple[Interval | None, Interval | None]
"""An expression as a variable plus the first interval, or as any value of the second one; None for neither."""


@dataclass(frozen=True, slots=True)
class IntRanges:
    """The ranges of the ints that the expressions of a component read.

    Attributes:
        names: The ranges of variables, outputs and constants; other values may be any stored int.
        external: Aliases of components whose ints are limited when they are read: the designs do not set them.
    """

    names: Mapping[str, Interval] = field(default_factory=dict)
    external: frozenset[str] = frozenset()

    def may_overflow(self, node: Expr) -> bool:
        """Whether the exact result of an operation may leave 64 bits."""
        return node.type == INT and not _contains(RESULT, self._exact(node))

    def is_storable(self, node: Expr) -> bool:
        """Whether a value lies within ±2**53."""
        return node.type != INT or _contains(STORED, self.of(node))

    def is_inside(self, node: Expr) -> bool:
        """Whether limiting the other side of a comparison with this int cannot change the comparison."""
        if node.type != INT:
            return False
        low, high = self.of(node)
        return STORED[0] < low and high < STORED[1]

    def is_external(self, node: Expr) -> bool:
        return isinstance(node, OutputRef) and node.type == INT and node.alias in self.external

    def of(self, node: Expr) -> Interval:
        """The range of the value of an int expression."""
        return limited(self._exact(node), RESULT)

    def _exact(self, node: Expr) -> Interval:
        """The range of the exact result of the outermost operation."""
        match node:
            case Number(value=int(value)):
                return (value, value)
            case Variable(name=name):
                return self.names.get(name, STORED)
            case StatusFlag():
                return _TEAM
            case Minus(operand=operand):
                low, high = self.of(operand)
                return (-high, -low)
            case Binary(operator=operator, left=left, right=right) if operator in _OPERATORS:
                return _OPERATORS[operator](self.of(left), self.of(right))
            case Ternary(then=then, otherwise=otherwise):
                return _join(self.of(then), self.of(otherwise))
            case FunctionCall(function=function, arguments=arguments) if node.type == INT and function in _FUNCTIONS:
                return _FUNCTIONS[function](*(self.of(argument) for argument in arguments))
            case _:
                return STORED

    def offsets(self, node: Expr, name: str) -> Offsets:
        """Return an expression relative to a variable."""
        match node:
            case Variable(name=own, kind=kind) if own == name and kind != ScopeSymbolKind.CONSTANT:
                return (0, 0), None
            case Binary(operator="+" | "-" as operator, left=left, right=right) if node.type == INT:
                if operator == "+" and self.offsets(left, name)[0] is None:
                    left, right = right, left
                (relative, absolute), (other, moved) = self.offsets(left, name), self.offsets(right, name)
                if other is not None or moved is None:
                    return None, self.of(node)
                combine = _OPERATORS[operator]
                return relative and combine(relative, moved), absolute and combine(absolute, moved)
            case Ternary(then=then, otherwise=otherwise):
                return _join_offsets(self.offsets(then, name), self.offsets(otherwise, name))
            case FunctionCall(function="min" | "max", arguments=arguments) if node.type == INT:
                return _join_offsets(*(self.offsets(argument, name) for argument in arguments))
            case _:
                return None, self.of(node)


def limited(interval: Interval, to: Interval = STORED) -> Interval:
    """Return what a range becomes when its values are limited to another one."""
    low, high = (min(max(value, to[0]), to[1]) for value in interval)
    return low, high


def _contains(outer: Interval, inner: Interval) -> bool:
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def _join(*ranges: Interval) -> Interval:
    return min(low for low, _high in ranges), max(high for _low, high in ranges)


def _join_offsets(*offsets: Offsets) -> Offsets:
    relative = [each for each, _absolute in offsets if each is not None]
    absolute = [each for _relative, each in offsets if each is not None]
    return _join(*relative) if relative else None, _join(*absolute) if absolute else None


def _add(a: Interval, b: Interval) -> Interval:
    return a[0] + b[0], a[1] + b[1]


def _subtract(a: Interval, b: Interval) -> Interval:
    return a[0] - b[1], a[1] - b[0]


def _multiply(a: Interval, b: Interval) -> Interval:
    products = [x * y for x in a for y in b]
    return min(products), max(products)


def _abs(x: Interval) -> Interval:
    low, high = x
    return (0 if low <= 0 <= high else min(abs(low), abs(high))), max(abs(low), abs(high))


def _min(*ranges: Interval) -> Interval:
    return min(low for low, _high in ranges), min(high for _low, high in ranges)


def _max(*ranges: Interval) -> Interval:
    return max(low for low, _high in ranges), max(high for _low, high in ranges)


def _clamp(_x: Interval, low: Interval, high: Interval) -> Interval:
    # The result is `low`, or `high`, or between them.
    return _join(low, high)


_OPERATORS: Mapping[str, Callable[[Interval, Interval], Interval]] = {"+": _add, "-": _subtract, "*": _multiply}
_FUNCTIONS: Mapping[str, Callable[..., Interval]] = {
    "abs": _abs,
    "min": _min,
    "max": _max,
    "clamp": _clamp,
    "sign": lambda _x: (-1, 1),
}
