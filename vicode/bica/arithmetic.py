"""IEEE arithmetic for guards and actions: no function raises, and all generated languages give the same results.

Numbers are doubles and integers within ±2**53, which doubles represent exactly. Where Python raises, the result is that
of C's libm: nan or an infinity. docs/semantics.md lists the rules.
"""

import math
from collections.abc import Callable

MAX_INT = 2**53
"""Stored ints lie between -MAX_INT and MAX_INT."""


def divide(a: float, b: float) -> float:
    """Return a / b; division by zero gives an infinity, with the signs of both operands, and nan for 0 / 0."""
    try:
        return a / b
    except ZeroDivisionError:
        return _divide_by_zero(float(a), float(b))


def floor_divide(a: float, b: float) -> float:
    """Return a // b, rounded towards minus infinity, as a float; division by zero as in `divide`."""
    try:
        return float(a) // float(b)
    except ZeroDivisionError:
        return _divide_by_zero(float(a), float(b))


def modulo(a: float, b: float) -> float:
    """Return a % b with the sign of b, as a float; nan if b is 0."""
    try:
        return float(a) % float(b)
    except ZeroDivisionError:
        return math.nan


def xabsl_divide(a: float, b: float) -> float:
    """Return a / b as the XABSL engine computes it: it divides by 1e-7 instead of 0."""
    return a / (b or 1e-7)


def xabsl_remainder(a: float, b: float) -> float:
    """Return the remainder of the integer parts as the XABSL engine computes it: sign of a; 0 if int(b) is 0."""
    if not (math.isfinite(a) and math.isfinite(b)) or not int(b):
        return 0.0
    return math.fmod(int(a), int(b))


def power(a: float, b: float) -> float:
    """Return a to the power of b, as C's pow does."""
    x, y = float(a), float(b)
    try:
        return math.pow(x, y)
    except OverflowError:
        return -math.inf if x < 0 and _is_odd(y) else math.inf
    except ValueError:
        if x != 0:
            return math.nan
        return math.copysign(math.inf, x) if _is_odd(y) else math.inf


def sqrt(x: float) -> float:
    """Return the square root; nan for negative x."""
    return math.sqrt(x) if x >= 0 else math.nan


def log(x: float) -> float:
    """Return the natural logarithm; -inf for 0, nan for negative x."""
    return _log_with(math.log, x)


def log10(x: float) -> float:
    """Return the decimal logarithm; -inf for 0, nan for negative x."""
    return _log_with(math.log10, x)


def exp(x: float) -> float:
    """Return e to the power of x; inf on overflow."""
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf


def sin(x: float) -> float:
    """Return the sine of x radians; nan at infinity."""
    return math.sin(x) if math.isfinite(x) else math.nan


def cos(x: float) -> float:
    """Return the cosine of x radians; nan at infinity."""
    return math.cos(x) if math.isfinite(x) else math.nan


def tan(x: float) -> float:
    """Return the tangent of x radians; nan at infinity."""
    return math.tan(x) if math.isfinite(x) else math.nan


def asin(x: float) -> float:
    """Return the arc sine in radians; nan outside -1 to 1."""
    return math.asin(x) if -1 <= x <= 1 else math.nan


def acos(x: float) -> float:
    """Return the arc cosine in radians; nan outside -1 to 1."""
    return math.acos(x) if -1 <= x <= 1 else math.nan


def atan(x: float) -> float:
    """Return the arc tangent in radians."""
    return math.atan(x)


def atan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y) in radians."""
    return math.atan2(y, x)


def hypot(x: float, y: float) -> float:
    """Return sqrt(x * x + y * y). The hypot functions of libraries differ in the last bit; this does not."""
    x, y = float(x), float(y)
    return math.sqrt(x * x + y * y)


def degrees(x: float) -> float:
    """Return x radians in degrees: x * (180 / pi)."""
    return x * _DEGREES_PER_RADIAN


def radians(x: float) -> float:
    """Return x degrees in radians: x * (pi / 180)."""
    return x * _RADIANS_PER_DEGREE


def limit(x: int) -> int:
    """Return an int that is stored: x limited to ±2**53."""
    # Python reads numbers faster than names.
    if -9007199254740992 <= x <= 9007199254740992:
        return x
    return MAX_INT if x > 0 else -MAX_INT


def saturate(x: int) -> int:
    """Return the result of an operation on ints: x limited to 64 bits."""
    if _INT64_MIN <= x <= _INT64_MAX:
        return x
    return _INT64_MAX if x > 0 else _INT64_MIN


def to_int(x: float) -> int:
    """Return x truncated towards zero and limited to ±2**53; 0 for nan."""
    return _limited(x, int)


def floor(x: float) -> int:
    """Return the greatest integer <= x, limited as in `to_int`."""
    return _limited(x, math.floor)


def ceil(x: float) -> int:
    """Return the least integer >= x, limited as in `to_int`."""
    return _limited(x, math.ceil)


def round_half_even(x: float) -> int:
    """Return the nearest integer, ties to even, limited as in `to_int`."""
    return _limited(x, round)


def minimum(a: float, *others: float) -> float:
    """Return the minimum: `b if b < a else a` from left to right, so a leading nan stays and a later nan is skipped."""
    return min(a, *others) if others else a


def maximum(a: float, *others: float) -> float:
    """Return the maximum: `b if b > a else a` from left to right."""
    return max(a, *others) if others else a


def clamp(x: float, low: float, high: float) -> float:
    """Return x limited to [low, high]; `low` is tested first, and nan stays nan."""
    if x < low:
        return low
    return min(x, high)


def sign(x: float) -> int:
    """Return -1, 0 or 1; 0 for both zeros and nan."""
    return (x > 0) - (x < 0)


def is_nan(x: float) -> bool:
    return x != x  # noqa: PLR0124 - only true for nan, and faster than a call


_INT64_MIN, _INT64_MAX = -(2**63), 2**63 - 1
_DEGREES_PER_RADIAN = 180.0 / math.pi
_RADIANS_PER_DEGREE = math.pi / 180.0


def _divide_by_zero(a: float, zero: float) -> float:
    if a == 0 or is_nan(a):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, zero)


def _is_odd(y: float) -> bool:
    return math.fmod(y, 2.0) in {1.0, -1.0}


def _log_with(function: Callable[[float], float], x: float) -> float:
    if x > 0:
        return function(x)
    return -math.inf if x == 0 else math.nan


def _limited(x: float, rounding: Callable[[float], int]) -> int:
    if is_nan(x):
        return 0
    if x >= MAX_INT:
        return MAX_INT
    return rounding(x) if x > -MAX_INT else -MAX_INT
