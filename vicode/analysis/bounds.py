"""Bounds of computed values: interval arithmetic on the operations of docs/semantics.md.

The operations of doubles round monotonically, so the results of the ends enclose all results. Functions of the
platform's math library need not be monotonic in the last bit: only the values that they can have at all are used.
"""

import math
from collections.abc import Callable, Mapping

from vicode.analysis.interval_diagrams import BEFORE_ALL, BEFORE_NAN, Interval
from vicode.analysis.quantities import NANOSECONDS, QuantityTable, Shape, is_leaf, shape_of
from vicode.bica import arithmetic
from vicode.model.expressions import INT, Binary, Expr, FunctionCall, Minus, Ternary

_NUMBERS: Interval = (BEFORE_ALL, BEFORE_NAN)
_MONOTONIC: Mapping[str, Callable[[float], float]] = {
    "floor": arithmetic.floor,
    "ceil": arithmetic.ceil,
    "round": arithmetic.round_half_even,
    "int": arithmetic.to_int,
    "float": lambda x: x,
    "degrees": arithmetic.degrees,
    "radians": arithmetic.radians,
    "sign": arithmetic.sign,
}
_RIGHT_ANGLE = math.nextafter(math.pi / 2, 2)
_VALUES: Mapping[str, tuple[float, float]] = {
    "sin": (-1, 1),
    "cos": (-1, 1),
    "asin": (-_RIGHT_ANGLE, _RIGHT_ANGLE),
    "acos": (0, 2 * _RIGHT_ANGLE),
    "atan": (-_RIGHT_ANGLE, _RIGHT_ANGLE),
    "atan2": (-2 * _RIGHT_ANGLE, 2 * _RIGHT_ANGLE),
    "exp": (0, math.inf),
    "hypot": (0, math.inf),
}
_MAY_GIVE_NAN = frozenset({"sin", "cos", "asin", "acos"})

Cells = Mapping[Shape, Interval]
"""The interval of each value that is read; others have their domain."""


def find_bounds(node: Expr, cells: Cells, table: QuantityTable) -> tuple[Interval, bool]:
    """The interval that contains the value of a number, and whether it can be nan instead."""
    value = table.value_of(node)
    if isinstance(value, bool | int | float):
        return (((value, 0), (value, 1)), False) if not math.isnan(value) else (_NUMBERS, True)
    if is_leaf(node):
        return _read(node, cells, table)
    low, high, may_be_nan = _calculate(node, cells, table)
    if node.type == INT:
        low, high = (_limit(each) for each in (low, high))
    return ((low, 0), (high, 1)), may_be_nan


def _limit(value: float) -> float:
    if math.isinf(value):
        return -(2**63) if value < 0 else 2**63 - 1
    return arithmetic.saturate(int(value))


def _read(node: Expr, cells: Cells, table: QuantityTable) -> tuple[Interval, bool]:
    quantity = table.quantity(node)
    low, high = cells.get(shape_of(node), quantity.domain)
    may_be_nan, low, high = high > BEFORE_NAN, min(low, BEFORE_NAN), min(high, BEFORE_NAN)
    if quantity.type in (INT, NANOSECONDS):
        # The interval ends before the number.
        high = (high[0] - 1, 1)
    if quantity.type == NANOSECONDS:
        low, high = (low[0] / table.ns_per_unit, 0), (high[0] / table.ns_per_unit, 1)
    return (low, high), may_be_nan


def _ends(node: Expr, cells: Cells, table: QuantityTable) -> tuple[float, float, bool]:
    (low, high), may_be_nan = find_bounds(node, cells, table)
    return (low[0], high[0], may_be_nan)


def _calculate(node: Expr, cells: Cells, table: QuantityTable) -> tuple[float, float, bool]:
    """The least and the greatest number, and whether nan is possible."""
    match node:
        case Minus(operand=operand):
            low, high, nan = _ends(operand, cells, table)
            return (-high, -low, nan)
        case Ternary(then=then, otherwise=otherwise):
            return _hull(_ends(then, cells, table), _ends(otherwise, cells, table))
        case Binary(operator=operator, left=left, right=right):
            a, b = _ends(left, cells, table), _ends(right, cells, table)
            if operator in "-/" and shape_of(left) == shape_of(right):
                return _combine_equal(operator, a, is_xabsl=table.is_xabsl)
            return _combine(operator, a, b, is_xabsl=table.is_xabsl)
        case FunctionCall(function=function, arguments=arguments):
            return _call(function, [_ends(each, cells, table) for each in arguments])
        case _:
            start, end = table.quantity(node).domain
            return (start[0], end[0], end > BEFORE_NAN)


def _hull(a: tuple[float, float, bool], b: tuple[float, float, bool]) -> tuple[float, float, bool]:
    return (min(a[0], b[0]), max(a[1], b[1]), a[2] or b[2])


def _combine(
    operator: str, a: tuple[float, float, bool], b: tuple[float, float, bool], *, is_xabsl: bool
) -> tuple[float, float, bool]:
    nan = a[2] or b[2]
    if operator == "+":
        return _from_results([a[0] + b[0], a[1] + b[1], a[0] + b[1], a[1] + b[0]], nan)
    if operator == "-":
        return _from_results([a[0] - b[1], a[1] - b[0], a[0] - b[0], a[1] - b[1]], nan)
    if operator == "*":
        return _from_results([_multiply(x, y) for x in a[:2] for y in b[:2]], nan or _may_multiply_to_nan(a, b))
    is_divisible = b[0] > 0 or b[1] < 0
    if operator == "/" and is_divisible and not is_xabsl:
        return _from_results([float(x) / float(y) for x in a[:2] for y in b[:2]], nan)
    if operator == "%" and b[0] > 0 and not is_xabsl:
        return (0, b[1], nan or math.isinf(a[0]) or math.isinf(a[1]))
    return (-math.inf, math.inf, True)


def _combine_equal(operator: str, value: tuple[float, float, bool], *, is_xabsl: bool) -> tuple[float, float, bool]:
    """A value minus or divided by itself: 0 or 1, or nan of inf, and of 0 / 0."""
    low, high, may_be_nan = value
    is_infinite = math.isinf(low) or math.isinf(high)
    if operator == "-":
        return (0, 0, may_be_nan or is_infinite)
    may_be_zero = low <= 0 <= high
    least = 0 if may_be_zero and is_xabsl else 1
    return (least, 1, may_be_nan or is_infinite or (may_be_zero and not is_xabsl))


def _multiply(x: float, y: float) -> float:
    return 0 if x == 0 or y == 0 else x * y


def _may_multiply_to_nan(a: tuple[float, float, bool], b: tuple[float, float, bool]) -> bool:
    def meet(x: tuple[float, float, bool], y: tuple[float, float, bool]) -> bool:
        return x[0] <= 0 <= x[1] and (math.isinf(y[0]) or math.isinf(y[1]))

    return meet(a, b) or meet(b, a)


def _from_results(results: list[float], may_be_nan: bool) -> tuple[float, float, bool]:
    """The hull of results of ends; inf - inf and inf / inf leave everything possible."""
    if any(math.isnan(each) for each in results):
        return (-math.inf, math.inf, True)
    return (min(results), max(results), may_be_nan)


def _call(function: str, given: list[tuple[float, float, bool]]) -> tuple[float, float, bool]:
    nan = any(each[2] for each in given)
    low, high, _nan = given[0]
    if function in _MONOTONIC:
        # nan is converted to 0.
        of_ends = _MONOTONIC[function](low), _MONOTONIC[function](high)
        is_float = function in ("float", "degrees", "radians")
        return (*of_ends, nan) if is_float or not nan else (min(0, of_ends[0]), max(0, of_ends[1]), False)
    if function == "abs":
        least = 0 if low <= 0 <= high else min(abs(low), abs(high))
        return (least, max(abs(low), abs(high)), nan)
    if function in ("min", "max"):
        choose = min if function == "min" else max
        return _hull_of_choice(choose, given, nan)
    if function == "clamp":
        return _hull_of_choice(max, [_hull_of_choice(min, [given[0], given[2]], nan), given[1]], nan)
    if function == "sqrt":
        return (math.sqrt(max(0, low)), math.sqrt(max(0, high)), nan or low < 0)
    values = _VALUES.get(function, (-math.inf, math.inf))
    return (*values, nan or function not in _VALUES or function in _MAY_GIVE_NAN)


def _hull_of_choice(
    choose: Callable[[float, float], float], given: list[tuple[float, float, bool]], nan: bool
) -> tuple[float, float, bool]:
    low, high, _nan = given[0]
    for each in given[1:]:
        low, high = choose(low, each[0]), choose(high, each[1])
    if nan:
        # A nan among them may hide the others: docs/semantics.md, "Arithmetic".
        low, high = min(low, *(each[0] for each in given)), max(high, *(each[1] for each in given))
    return (low, high, nan)


def find_orders(a: Interval, b: Interval) -> list[Interval]:
    """The possible orders of two numbers of which the intervals are known: -1, 0, 1."""
    (low_a, high_a), (low_b, high_b) = a, b
    possible: list[Interval] = []
    if low_a == high_a or low_b == high_b:
        # A value that can only be nan has no order.
        return possible
    if low_a[0] < high_b[0]:
        possible.append((BEFORE_ALL, (0, 0)))
    if max(low_a, low_b) < min(high_a, high_b):
        possible.append(((0, 0), (0, 1)))
    if low_b[0] < high_a[0]:
        possible.append(((0, 1), BEFORE_NAN))
    return possible
