"""Figures of ages: quantiles within an eighth, also after a merge."""

import math

from hypothesis import given
from hypothesis import strategies as st

from vicode.bridge.ages import AgeFigures


@given(
    st.lists(st.integers(0, 10**12), min_size=1), st.lists(st.integers(0, 100)), st.sampled_from([0.01, 0.5, 0.99, 1])
)
def test_quantiles(some: list[int], others: list[int], part: float) -> None:
    figures, more = AgeFigures(), AgeFigures()
    for age_ns in some:
        figures.add(age_ns)
    for age_ns in others:
        more.add(age_ns)
    figures.merge(more)
    ages = sorted(some + others)
    exact = ages[math.ceil(part * len(ages)) - 1]
    assert exact <= figures.quantile(part) <= max(exact * 1.125, exact)
    assert (figures.newest, figures.greatest, figures.number) == (some[-1], ages[-1], len(ages))


def test_without_ages() -> None:
    figures = AgeFigures()
    assert (figures.newest, figures.greatest, figures.quantile(0.5)) == (None, 0, 0)
