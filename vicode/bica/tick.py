"""The tick, that is, the time between two iterations, and the frequencies that result from it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .component import Component

_LEAST_HZ = 50
_MOST_HZ = 200
_TOLERANCE = 0.01


def choose_tick_ns(frequencies_hz: Iterable[float]) -> int:
    """Return the longest tick up to 20 ms of which all periods are multiples.

    If it is below 5 ms and below all periods, a tick of 5 ms or more that suits the highest frequency is used instead.
    """
    finite = (Fraction(each).limit_denominator(1000) for each in frequencies_hz if math.isfinite(each))
    rates = [rate for rate in finite if rate > 0]
    if not rates:
        return 1_000_000_000 // _LEAST_HZ
    highest = max(rates)
    most = max(highest, Fraction(_MOST_HZ))
    common = Fraction(math.lcm(*(rate.numerator for rate in rates)), math.gcd(*(rate.denominator for rate in rates)))
    rate = common * math.ceil(_LEAST_HZ / common) if common <= most else highest * (most // highest)
    # Rounded up, or a number of ticks could be a nanosecond shorter than the period.
    return math.ceil(1_000_000_000 / rate)


def describe_wrong_frequencies(components: Iterable[Component], tick_ns: int) -> Iterator[str]:
    """Describe each component whose frequency differs from the declared one, because it only works at ticks."""
    for component in components:
        target_hz, period_ns = component.frequency_hz, component._period_ns
        if target_hz and period_ns > 0:
            real_hz = 1e9 / (-(-period_ns // tick_ns) * tick_ns)
            if abs(real_hz / target_hz - 1) > _TOLERANCE:
                rates = f"{type(component).__name__} works at {real_hz:.4g} Hz instead of {target_hz:g} Hz"
                yield f"{rates}: its period is not a multiple of the tick of {tick_ns / 1e6:.4g} ms"
