"""Values and arithmetic: the table in the section "Arithmetic".

The runtimes have the same functions in `vicode.bica.arithmetic` and `bica.hpp`. This is a second implementation on
purpose, from the table alone: a comparison with a shared function would find no error in it.
"""

import math
from collections.abc import Callable, Mapping

from vicode.model.expressions import BOOL, FLOAT, INT

Value = bool | float | str
"""A bool, a number, or an element of an enumeration, written `Type.element`."""

InputFunction = Callable[[Mapping[str, Value]], Value]
"""An output with arguments: returns the value for arguments by name."""

STORED_INTS = (-(2**53), 2**53)
"""The ints that values hold."""
RESULTING_INTS = (-(2**63), 2**63 - 1)
"""The ints that operations result in, within an expression."""


def stored(value: Value, type_: str) -> Value:
    """Return what holds a value of a declared type: an int is limited."""
    converted = as_type(value, type_)
    return limited(converted, STORED_INTS) if type_ == INT else converted


def limited(value: Value, bounds: tuple[int, int]) -> int:
    assert isinstance(value, int)
    least, greatest = bounds
    return max(least, min(value, greatest))


def as_type(value: Value, type_: str) -> Value:
    """Convert a value to its declared type: an int becomes a float where the design declares one."""
    match type_:
        case "bool":
            return bool(value)
        case "int":
            return int(value)
        case "float":
            return float(value)
        case _:
            return value


def zero(type_: str, elements: tuple[str, ...]) -> Value:
    """Return the value of a declaration without a value: false, 0 or the first element."""
    return {BOOL: False, INT: 0, FLOAT: 0.0}.get(type_, f"{type_}.{elements[0]}" if elements else 0.0)


def _divide(a: float, b: float) -> float:
    a, b = float(a), float(b)
    if b != 0:
        return a / b
    if a == 0 or math.isnan(a):
        return math.nan
    return math.copysign(math.inf, math.copysign(1, a) * math.copysign(1, b))


def _floor_divide(a: float, b: float) -> float:
    return float(a) // float(b) if b != 0 else _divide(float(a), float(b))


def _modulo(a: float, b: float) -> float:
    return float(a) % float(b) if b != 0 else math.nan


def _xabsl_divide(a: float, b: float) -> float:
    return float(a) / float(b) if b != 0 else a / 0.0000001


def _xabsl_modulo(a: float, b: float) -> float:
    if not (math.isfinite(a) and math.isfinite(b)) or abs(b) < 1:
        return 0.0
    return math.fmod(math.trunc(a), math.trunc(b))


def _integer(rounding: Callable[[float], int]) -> Callable[[float], int]:
    """Limit the results of a rounding to the ints that values hold; nan gives 0."""

    def rounded(x: float) -> int:
        if math.isnan(x):
            return 0
        if math.isinf(x):
            return STORED_INTS[x > 0]
        return limited(rounding(x), STORED_INTS)

    return rounded


def _minimum(*values: float) -> float:
    chosen = values[0]
    for value in values[1:]:
        chosen = value if value < chosen else chosen  # noqa: FURB136 - the rule, which decides about nan
    return chosen


def _maximum(*values: float) -> float:
    chosen = values[0]
    for value in values[1:]:
        chosen = value if value > chosen else chosen  # noqa: FURB136
    return chosen


def _clamp(x: float, low: float, high: float) -> float:
    if x < low:
        return low
    return high if high < x else x  # noqa: FURB136 - nan stays nan


def _sign(x: float) -> int:
    return 1 if x > 0 else -1 if x < 0 else 0


def _inside(function: Callable[[float], float], is_inside: Callable[[float], bool]) -> Callable[[float], float]:
    """Return a function that gives nan outside its domain."""
    return lambda x: function(x) if is_inside(x) else math.nan


def _log(x: float) -> float:
    return -math.inf if x == 0 else math.log(x) if x > 0 else math.nan


def _exp(x: float) -> float:
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf


def _between(x: float) -> bool:
    return -1 <= x <= 1


FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "abs": abs,
    "min": _minimum,
    "max": _maximum,
    "clamp": _clamp,
    "sign": _sign,
    "floor": _integer(math.floor),
    "ceil": _integer(math.ceil),
    "round": _integer(round),
    "int": _integer(math.trunc),
    "float": float,
    "sqrt": _inside(math.sqrt, lambda x: x >= 0),
    "exp": _exp,
    "log": _log,
    "sin": _inside(math.sin, math.isfinite),
    "cos": _inside(math.cos, math.isfinite),
    "tan": _inside(math.tan, math.isfinite),
    "asin": _inside(math.asin, _between),
    "acos": _inside(math.acos, _between),
    "atan": math.atan,
    "atan2": math.atan2,
    "hypot": lambda x, y: math.sqrt(float(x) * x + float(y) * y),
    "degrees": lambda x: x * (180 / math.pi),
    "radians": lambda x: x * (math.pi / 180),
    "is_nan": math.isnan,
}

OPERATORS: Mapping[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": _divide,
    "//": _floor_divide,
    "%": _modulo,
}
XABSL_OPERATORS = {**OPERATORS, "/": _xabsl_divide, "%": _xabsl_modulo}
"""The operators of designs with `arithmetic: xabsl` (section "Designs with other rules")."""

COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}
