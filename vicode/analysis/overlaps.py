"""Which guards of a state can hold together although they lead to different states: their order decides."""

from collections.abc import Iterator
from itertools import combinations

from vicode.analysis.examples import Example, find_example
from vicode.analysis.guards import GuardAnalysis, TestedDecision
from vicode.analysis.interval_diagrams import TRUE, TooLargeError
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Transition


def find_overlaps(guards: GuardAnalysis, state: str) -> Iterator[tuple[DesignPath, DesignPath, Example]]:
    """Yield the pairs of decisions of a state with different targets that can hold together, with values for it.

    The first one is taken. Pairs with a decision that always holds are left out, as are those that depend on
    hand-written code.
    """
    leaves = [
        each for each in guards.states[state] if not isinstance(each.decision, DecisionGroup) and each.own != TRUE
    ]
    guards.conditions.diagrams.begin_question()
    for first, second in combinations(leaves, 2):
        if _target(first, state) != _target(second, state):
            try:
                both = guards.conditions.diagrams.both(guards.taken(first), second.own)
            except (TooLargeError, RecursionError):
                return
            example = find_example(guards.conditions, both)
            if example is not None:
                yield first.path, second.path, example


def _target(tested: TestedDecision, state: str) -> str:
    return tested.decision.to if isinstance(tested.decision, Transition) else state
