"""The arithmetic of expressions against C's libm, against Python, and where both would fail."""

import ctypes
import ctypes.util
import math
import operator
from collections.abc import Callable

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from vicode.bica import arithmetic

LIBM = ctypes.CDLL(ctypes.util.find_library("m"))
NUMBERS = st.one_of(
    st.floats(), st.integers(-(2**53), 2**53), st.sampled_from([0, 0.0, -0.0, math.nan, math.inf, -math.inf])
)


def same(a: float, b: float) -> bool:
    if math.isnan(a) or math.isnan(b):
        return math.isnan(a) and math.isnan(b)
    return a == b and math.copysign(1, a) == math.copysign(1, b)


def from_libm(name: str, arity: int) -> Callable[..., float]:
    function = getattr(LIBM, name)
    function.restype = ctypes.c_double
    function.argtypes = [ctypes.c_double] * arity
    return function  # type: ignore[no-any-return]


@pytest.mark.parametrize("name", ["sqrt", "log", "log10", "exp", "sin", "cos", "tan", "asin", "acos", "atan"])
@given(x=NUMBERS)
def test_functions_of_one_number_are_those_of_c(name: str, x: float) -> None:
    assert same(getattr(arithmetic, name)(x), from_libm(name, 1)(x))


@pytest.mark.parametrize(("name", "c_name"), [("power", "pow"), ("atan2", "atan2")])
@given(x=NUMBERS, y=NUMBERS)
def test_functions_of_two_numbers_are_those_of_c(name: str, c_name: str, x: float, y: float) -> None:
    assert same(getattr(arithmetic, name)(x, y), from_libm(c_name, 2)(x, y))


@given(x=NUMBERS, y=NUMBERS)
def test_the_length_of_a_vector_is_a_square_root(x: float, y: float) -> None:
    assert same(arithmetic.hypot(x, y), from_libm("sqrt", 1)(float(x) * float(x) + float(y) * float(y)))


@pytest.mark.parametrize(
    ("name", "python"), [("divide", operator.truediv), ("floor_divide", operator.floordiv), ("modulo", operator.mod)]
)
@given(a=NUMBERS, b=NUMBERS.filter(bool))
def test_division_is_that_of_python(name: str, python: Callable[[float, float], float], a: float, b: float) -> None:
    assert same(getattr(arithmetic, name)(a, b), python(float(a), float(b)))


@given(a=st.integers(-(2**53), 2**53), b=st.integers(-(2**53), 2**53).filter(bool))
def test_division_of_integers_is_exact(a: int, b: int) -> None:
    assert arithmetic.floor_divide(a, b) == a // b
    assert arithmetic.modulo(a, b) == a % b
    assert isinstance(arithmetic.floor_divide(a, b), float)


@pytest.mark.parametrize(
    ("a", "b", "quotient"),
    [
        (1, 0, math.inf),
        (-1, 0, -math.inf),
        (1, -0.0, -math.inf),
        (-2.5, -0.0, math.inf),
        (math.inf, 0, math.inf),
        (0, 0, math.nan),
        (math.nan, 0, math.nan),
    ],
)
def test_division_by_zero_is_that_of_ieee(a: float, b: float, quotient: float) -> None:
    assert same(arithmetic.divide(a, b), quotient)
    assert same(arithmetic.floor_divide(a, b), quotient)
    assert math.isnan(arithmetic.modulo(a, b))


@given(x=st.floats(allow_nan=False, allow_infinity=False, min_value=-(2.0**53), max_value=2.0**53))
def test_rounding_is_that_of_python(x: float) -> None:
    assert arithmetic.to_int(x) == int(x)
    assert arithmetic.floor(x) == math.floor(x)
    assert arithmetic.ceil(x) == math.ceil(x)
    assert arithmetic.round_half_even(x) == round(x)


@pytest.mark.parametrize("name", ["to_int", "floor", "ceil", "round_half_even"])
def test_rounding_is_limited(name: str) -> None:
    rounding = getattr(arithmetic, name)
    assert rounding(math.nan) == 0
    assert rounding(math.inf) == rounding(1e300) == rounding(2.0**63) == rounding(2.0**53 + 2) == 2**53
    assert rounding(-math.inf) == rounding(-1e300) == rounding(-(2.0**63)) == -(2**53)


@given(x=st.integers(-(2**70), 2**70))
def test_ints_are_limited(x: int) -> None:
    assert arithmetic.limit(x) == sorted((-(2**53), x, 2**53))[1]
    assert arithmetic.saturate(x) == sorted((-(2**63), x, 2**63 - 1))[1]


@given(a=NUMBERS, b=NUMBERS, c=NUMBERS)
@example(a=math.nan, b=1.0, c=2.0)
@example(a=1.0, b=math.nan, c=2.0)
@example(a=0.0, b=-0.0, c=0.0)
def test_least_and_greatest_keep_the_written_rule(a: float, b: float, c: float) -> None:
    least = b if b < a else a  # noqa: FURB136 - this is the rule
    greatest = b if b > a else a  # noqa: FURB136
    assert same(arithmetic.minimum(a, b), least)
    assert same(arithmetic.maximum(a, b), greatest)
    assert same(arithmetic.minimum(a, b, c), arithmetic.minimum(least, c))
    assert same(arithmetic.maximum(a, b, c), arithmetic.maximum(greatest, c))
    assert same(arithmetic.minimum(a), a)


@given(x=NUMBERS)
def test_signs_and_limits(x: float) -> None:
    assert arithmetic.sign(x) == (0 if math.isnan(x) or x == 0 else math.copysign(1, x))
    assert arithmetic.is_nan(x) == math.isnan(x)
    clamped = arithmetic.clamp(x, -1.0, 1.0)
    assert math.isnan(clamped) if math.isnan(x) else -1 <= clamped <= 1


def test_the_lower_limit_is_tested_first() -> None:
    assert arithmetic.clamp(0.0, 5.0, -5.0) == 5.0


@given(x=NUMBERS)
def test_angles_are_one_multiplication(x: float) -> None:
    assert same(arithmetic.degrees(x), float(x) * (180.0 / math.pi))
    assert same(arithmetic.radians(x), float(x) * (math.pi / 180.0))
