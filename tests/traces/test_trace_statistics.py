"""How long and how often states were active, and where two runs differ."""

import pytest

from vicode.simulation import IterationResult
from vicode.traces.statistics import RunDifference, RunHistory, find_difference, read_history, sum_states

S = 10**9


def history(*states: str, other: str = "", start_s: int = 0) -> RunHistory:
    """A run with one iteration per second; "-" is an iteration in which the component `Arm` is not stepped."""
    iterations, before = [], None
    for number, state in enumerate(states):
        main = {"component": "Car", "state": "Drive", "changed_from": None, "transition": None}
        step = {"component": "Arm", "state": state, "changed_from": before, "transition": "go" if before else None}
        step["changed_from"] = before if before not in (None, "-", state) else None
        tree = [main] if state == "-" else [main, step]
        iterations.append(IterationResult(iteration=number + 1, time_ns=(start_s + number) * S, tree=tree))
        before = state
    return read_history(iterations)


def test_a_state_lasts_until_the_next_iteration_or_until_the_component_is_not_stepped() -> None:
    sums = sum_states([history("Up", "Up", "Down", "-", "Up", "Up"), history("Up", "Down", start_s=7)])["Arm"]
    figures = {name: (each.entries, each.total_ns / S, each.longest_ns / S) for name, each in sums.items()}
    assert figures == {"Up": (3, 4, 2), "Down": (2, 1, 1)}


def test_transitions_are_counted_by_their_ends_and_id() -> None:
    counts = history("Up", "Down", "Up", "-", "Up", "Down").transitions
    assert counts == {("Arm", "Up", "Down", "go"): 2, ("Arm", "Down", "Up", "go"): 1}


@pytest.mark.parametrize(
    ("second", "tolerance_s", "expected"),
    [
        ("Up Up Down Down Up Up", 0, None),
        ("Up Up Up Down Up Up", 0, (2, "Down", "Up")),
        ("Up Up Up Down Up Up", 1, None),
        ("Up Up Up Up Up Up", 1, (2, "Down", "Up")),
        ("Up Up Down - Up Up", 0, (3, "Down", "")),
        ("Up Up Down", 0, None),
    ],
)
def test_the_first_difference_that_lasts_is_found(
    second: str, tolerance_s: int, expected: tuple[int, str, str] | None
) -> None:
    first = history("Up", "Up", "Down", "Down", "Up", "Up")
    found = find_difference(first, history(*second.split(), start_s=100), tolerance_s * S)
    if expected is None:
        assert found is None
    else:
        time_s, one, two = expected
        assert found == RunDifference(time_ns=time_s * S, component="Arm", first=one, second=two)
