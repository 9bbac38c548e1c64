"""Statistics of recorded runs: how often and how long states were active, how often transitions were taken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.simulation.messages import IterationResult

INACTIVE = ""
"""The state of a component that is not stepped."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateRun:
    """A time in one state; times are relative to the first iteration."""

    state: str
    start_ns: int
    end_ns: int

    @property
    def duration_ns(self) -> int:
        return self.end_ns - self.start_ns


@dataclass(slots=True, kw_only=True)
class StateStatistics:
    """How often a state was entered and how long it was active."""

    entries: int = 0
    total_ns: int = 0
    longest_ns: int = 0

    def add(self, run: StateRun) -> None:
        self.entries += 1
        self.total_ns += run.duration_ns
        self.longest_ns = max(self.longest_ns, run.duration_ns)


@dataclass(slots=True, kw_only=True)
class RunHistory:
    """One run: the states of each component over time, and its transitions by component, source, target and id."""

    duration_ns: int = 0
    runs: dict[str, list[StateRun]] = field(default_factory=dict)
    transitions: Counter[tuple[str, str, str, str]] = field(default_factory=Counter)


def read_history(iterations: Iterable[IterationResult]) -> RunHistory:
    """Read a run; a state lasts until the next iteration, and components without states are left out."""
    history = RunHistory()
    active: dict[str, tuple[str, int]] = {}
    first_ns: int | None = None
    for iteration in iterations:
        first_ns = iteration.time_ns if first_ns is None else first_ns
        now_ns = history.duration_ns = iteration.time_ns - first_ns
        steps = {str(step["component"]): step for step in iteration.tree if step["state"]}
        for component in [name for name in active if name not in steps]:
            _end_run(history, component, active.pop(component), now_ns)
        for component, step in steps.items():
            state, left = str(step["state"]), step.get("changed_from")
            # In the order of the first steps, so that the root component comes first.
            history.runs.setdefault(component, [])
            known = active.get(component)
            if left is not None:
                history.transitions[component, str(left), state, str(step.get("transition") or "")] += 1
            if known is None or known[0] != state or left is not None:
                if known is not None:
                    _end_run(history, component, known, now_ns)
                active[component] = (state, now_ns)
    for component, known in active.items():
        _end_run(history, component, known, history.duration_ns)
    return history


def sum_states(histories: Iterable[RunHistory]) -> dict[str, dict[str, StateStatistics]]:
    """The statistics of several runs, by component and state."""
    sums: dict[str, dict[str, StateStatistics]] = {}
    for history in histories:
        for component, runs in history.runs.items():
            states = sums.setdefault(component, {})
            for run in runs:
                states.setdefault(run.state, StateStatistics()).add(run)
    return sums


@dataclass(frozen=True, slots=True, kw_only=True)
class RunDifference:
    """The first time at which a component has different states in two runs."""

    time_ns: int
    component: str
    first: str
    second: str


def find_difference(first: RunHistory, second: RunHistory, tolerance_ns: int = 0) -> RunDifference | None:
    """The earliest difference that lasts longer than the tolerance, up to the end of the shorter run."""
    end_ns = min(first.duration_ns, second.duration_ns)
    components = dict.fromkeys((*first.runs, *second.runs))
    found = (
        _first_difference(component, _fill(first, component, end_ns), _fill(second, component, end_ns), tolerance_ns)
        for component in components
    )
    return min((each for each in found if each is not None), key=lambda each: each.time_ns, default=None)


def _end_run(history: RunHistory, component: str, known: tuple[str, int], now_ns: int) -> None:
    state, start_ns = known
    history.runs[component].append(StateRun(state=state, start_ns=start_ns, end_ns=now_ns))


def _fill(history: RunHistory, component: str, end_ns: int) -> list[StateRun]:
    """The runs up to a time without gaps."""
    filled: list[StateRun] = []
    at_ns = 0
    for run in history.runs.get(component, ()):
        if run.start_ns > at_ns:
            filled.append(StateRun(state=INACTIVE, start_ns=at_ns, end_ns=run.start_ns))
        filled.append(run)
        at_ns = run.end_ns
    filled.append(StateRun(state=INACTIVE, start_ns=at_ns, end_ns=max(at_ns, end_ns)))
    return [run for run in filled if run.start_ns < end_ns]


def _first_difference(
    component: str, first: list[StateRun], second: list[StateRun], tolerance_ns: int
) -> RunDifference | None:
    difference: RunDifference | None = None
    at = [0, 0]
    while at[0] < len(first) and at[1] < len(second):
        runs = first[at[0]], second[at[1]]
        start_ns, end_ns = max(run.start_ns for run in runs), min(run.end_ns for run in runs)
        if runs[0].state == runs[1].state:
            difference = None
        elif end_ns > start_ns:
            difference = difference or RunDifference(
                time_ns=start_ns, component=component, first=runs[0].state, second=runs[1].state
            )
            if end_ns - difference.time_ns > tolerance_ns:
                return difference
        for side in (0, 1):
            at[side] += runs[side].end_ns == end_ns
    return None
