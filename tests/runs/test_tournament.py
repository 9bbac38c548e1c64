"""The figures of a tournament, against computations that share nothing with them."""

from itertools import product
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.runs.sweep_page import sign_test
from vicode.runs.tournament import confidence_interval, evaluate, format_page, permutation_test


def rows(*scores: tuple[int, int] | None) -> list[dict[str, Any]]:
    """Matches with these goals of A and B; None has failed."""
    return [
        {"seed": number // 2 + 1, "values": {"home": "AB"[number % 2]}, "error": "" if score else "no picture"}
        | ({"world.goals_a": score[0], "world.goals_b": score[1]} if score else {})
        for number, score in enumerate(scores)
    ]


@given(st.lists(st.integers(-4, 4), max_size=9))
def test_the_p_value_is_the_share_of_all_signs(differences: list[int]) -> None:
    wanted = abs(sum(differences))
    sums = [abs(sum(map(int.__mul__, differences, signs))) for signs in product((1, -1), repeat=len(differences))]
    expected = sum(each >= wanted for each in sums) / len(sums)
    assert permutation_test(differences) == pytest.approx(expected, rel=1e-12)


def test_of_equal_differences_the_p_value_is_that_of_the_sign_test() -> None:
    assert permutation_test([2] * 15 + [-2] * 5) == pytest.approx(sign_test(15, 5), rel=1e-12)
    assert permutation_test([1] * 1000) == pytest.approx(sign_test(1000, 0), rel=1e-9)
    assert permutation_test([]) == permutation_test([0, 0]) == permutation_test([3, -3]) == 1


@pytest.mark.parametrize(("count", "t"), [(5, 2.776), (6, 2.571), (10, 2.262), (20, 2.093), (100, 1.984)])
def test_the_interval_has_the_quantile_of_the_t_table(count: int, t: float) -> None:
    values = [3.0, 4.0] * (count // 2) + [3.5] * (count % 2)
    deviation = (sum((each - 3.5) ** 2 for each in values) / (count - 1)) ** 0.5
    low, high = confidence_interval(values)
    assert (low + high) / 2 == pytest.approx(3.5)
    assert (high - low) / 2 == pytest.approx(t * deviation / count**0.5, rel=3e-3)


def test_a_seed_with_a_failed_match_does_not_count() -> None:
    result = evaluate(rows((3, 1), (1, 1), None, (9, 0), (0, 1), (2, 0)))
    assert (result.matches, result.goals_a, result.goals_b) == (4, 6, 3)
    assert (result.won, result.drawn, result.lost) == (2, 1, 1)
    # The seeds have the sums 2 and 1, and four ways to choose their signs.
    assert (result.difference, result.interval, result.p) == (0.75, None, 0.5)


def test_the_result_names_the_better_version() -> None:
    assert str(evaluate(rows(*[(0, 1)] * 12))) == (
        "Goal difference of A per match: -1.00 (95 % interval -1.00 to -1.00), p = 0.031: B is better."
    )
    assert str(evaluate(rows((1, 0), (1, 0)))) == (
        "Goal difference of A per match: +1.00, p = 1: the difference may be chance."
    )


def test_the_page_has_the_matches_of_each_seed() -> None:
    matches = rows((3, 1), (1, 1), None, (9, 0))
    page = format_page({"A": "new", "B": "HEAD:old"}, matches, evaluate(matches))
    assert "- B: `HEAD:old`" in page
    assert "|       4 : 2 |     1 |     1 |      0 |" in page
    assert "| 1 | 3 : 1 | 1 : 1 |\n| 2 | failed | 9 : 0 |\n" in page
