"""The arithmetic of the original engine where it differs from Python's."""

import math


def divide(dividend: float, divisor: float) -> float:
    """A quotient; instead of 0 one divides by 1e-7."""
    return dividend / (divisor or 0.0000001)


def remainder(dividend: float, divisor: float) -> float:
    """The remainder of whole parts, with the dividend's sign; 0 for a divisor below 1, which ended the original."""
    if not (math.isfinite(dividend) and math.isfinite(divisor)) or not int(divisor):
        return 0.0
    return math.fmod(int(dividend), int(divisor))
