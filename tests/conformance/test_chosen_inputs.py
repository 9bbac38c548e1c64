"""The inputs that a search chooses."""

import math
from pathlib import Path

from tests.conformance.conformance_cases import CASES, Case
from vicode.conformance.chosen_inputs import choose_runs
from vicode.conformance.coverage import GoalKind, measure_coverage
from vicode.conformance.inputs import ConformanceRun


def choose(name: str, folder: Path, iterations: int = 80) -> tuple[ConformanceRun, ...]:
    case = Case(CASES / f"{name}.yaml", folder)
    return choose_runs(case.project, case.root, iterations=iterations, seed=0)


def test_each_input_that_is_read_gets_nan_infinities_and_negative_zero(tmp_path: Path) -> None:
    given: dict[str, set[str]] = {}
    for run in choose("arithmetic_selection", tmp_path):
        for step in run.steps:
            for (_component, name), value in step.inputs[0].items():
                given.setdefault(name, set()).add(repr(value))
    assert given["x"] >= {"nan", "inf", "-inf", "-0.0"}
    assert given["y"] >= {"nan", "inf", "-inf", "-0.0"}


def test_an_unusual_value_is_replaced_in_the_next_iteration(tmp_path: Path) -> None:
    for run in choose("arithmetic_rounding", tmp_path):
        for before, after in zip(run.steps, run.steps[1:], strict=False):
            if math.isnan(before.inputs[0].get(("W", "x"), 0.0)):
                assert ("W", "x") in after.inputs[0]


def test_robots_wait_for_the_same_state_at_the_same_time(tmp_path: Path) -> None:
    coverage = measure_coverage(choose("team_capacity", tmp_path, iterations=160))
    (count,) = (each for each in coverage.counts if each.kind == GoalKind.TEAM.value)
    assert (count.seen, count.total) == (1, 1)
