"""The comparison of the values of a sweep."""

from math import comb, inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.runs.sweep import Combination, Row
from vicode.runs.sweep_page import MAXIMIZE, MINIMIZE, Result, compare, format_table, sign_test, write_page

TIMES: dict[int, list[float | None]] = {1: [3.0, 5.0, None, 4.0], 2: [2.0, 6.0, 9.0, None], 3: [None, None, None, None]}


def combination(value: int) -> Combination:
    return Combination(changes=(), values={"a": value}, is_baseline=value == 1)


def results(error: str = "") -> list[Result]:
    def row(value: int, seed: int, time: float | None) -> Row:
        return {"values": {"a": value}, "seed": seed, "error": error, "stopped": "limit", "time_s": time}

    return [
        (combination(value), [row(value, seed, time) for seed, time in enumerate(times, start=1)])
        for value, times in TIMES.items()
    ]


def test_a_run_that_lacks_a_figure_with_a_goal_is_the_worst() -> None:
    for goal, missing, best in ((MINIMIZE, inf, 1), (MAXIMIZE, -inf, 2)):
        found = compare(results(), "time_s", goal)
        first, second, third = found.outcomes
        assert list(first.numbers) == [3.0, 5.0, missing, 4.0]
        assert list(third.numbers) == [missing] * 4
        assert (second.higher, second.lower) == (2, 2)
        assert (third.higher, third.lower) == ((3, 0) if goal == MINIMIZE else (0, 3))
        assert third.p == pytest.approx(2 * 2 / 8)
        assert found.best is not None
        assert found.best.combination.values == {"a": best}


def test_without_a_goal_a_run_that_lacks_a_figure_is_left_out() -> None:
    found = compare(results(), "time_s")
    assert [list(each.numbers) for each in found.outcomes] == [[3.0, 5.0, 4.0], [2.0, 6.0, 9.0]]
    assert (found.outcomes[1].lower, found.outcomes[1].higher) == (1, 1)
    assert found.best is None


def test_the_mean_decides_between_equal_medians() -> None:
    def row(value: int, seed: int) -> Row:
        return {"values": {"a": value}, "seed": seed, "error": "", "goals": int(seed <= 5 + value)}

    scored = [(combination(value), [row(value, seed) for seed in range(1, 10)]) for value in TIMES]
    best = compare(scored, "goals", MAXIMIZE).best
    assert best is not None
    assert best.combination.values == {"a": 3}
    assert best.quartiles[1] == 1


def test_the_baseline_is_the_best_if_others_are_only_as_good() -> None:
    row: Row = {"values": {}, "seed": 1, "error": "", "goals": 1}
    found = compare([(combination(value), [row]) for value in reversed(TIMES)], "goals", MAXIMIZE)
    assert found.describe_best() == "Best goals: a=1, median 1, mean 1. This is the value in the files."


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([None, None], "No run has this figure: time_s. Runs with errors are left out."),
        ([None, 2.0], "No value is the best: with each, at least half of the runs lack time_s."),
    ],
)
def test_without_a_median_no_value_is_the_best(times: list[float | None], message: str) -> None:
    rows: list[Row] = [
        {"values": {}, "seed": seed, "error": "", "stopped": "limit", "time_s": time} for seed, time in enumerate(times)
    ]
    found = compare([(combination(value), rows) for value in TIMES], "time_s", MINIMIZE)
    assert found.describe_best() == message


def test_runs_with_errors_are_in_the_table_only() -> None:
    found = results("it failed")
    nothing = "No run has this figure: time_s. Runs with errors are left out."
    assert compare(found, "time_s", MINIMIZE).describe_best() == nothing
    assert format_table([row for _combination, own in found for row in own]).count("it failed") == 12
    assert "All runs have the same figures" in write_page("A sweep", found)


@given(st.integers(0, 60), st.integers(0, 60))
def test_the_sign_test_sums_what_is_as_unequal(higher: int, lower: int) -> None:
    count = higher + lower
    as_unequal = [n for n in range(count + 1) if abs(2 * n - count) >= abs(higher - lower)]
    assert sign_test(higher, lower) == pytest.approx(sum(comb(count, n) for n in as_unequal) / 2**count)


def test_the_page_escapes_names_and_has_no_scripts() -> None:
    page = write_page("A <b> sweep", results("<script>alert(1)</script>"))
    assert "A &lt;b&gt; sweep" in page
    assert "<script" not in page
