"""Operators of the original engine that differ from Python's."""

import math


def divide(dividend: float, divisor: float) -> float:
    """Divide; a divisor of 0 is replaced by 1e-7."""
    return dividend / (divisor or 0.0000001)


def remainder(dividend: float, divisor: float) -> float:
    """Remainder of the integer parts with the sign of the dividend; 0 for a divisor below 1 (the original crashes)."""
    if not (math.isfinite(dividend) and math.isfinite(divisor)) or not int(divisor):
        return 0.0
    return math.fmod(int(dividend), int(divisor))
