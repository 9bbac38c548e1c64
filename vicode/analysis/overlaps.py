"""Which guards of a state can hold together although they lead to different states: their order decides."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from vicode.analysis.examples import Example, find_example
from vicode.analysis.guards import GuardAnalysis, TestedDecision
from vicode.analysis.interval_diagrams import TRUE, TooLargeError
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Transition


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """Two decisions of a state that can hold together, the first of which is taken.

    Attributes:
        first: The path of the decision that is taken.
        second: The path of the other one.
        example: Values for which both hold.
    """

    first: DesignPath
    second: DesignPath
    example: Example


def find_overlaps(guards: GuardAnalysis, state: str) -> Iterator[Overlap]:
    """Yield the pairs of decisions of a state with different targets that can hold together.

    A decision without a guard always holds; pairs with it are left out. So are those that depend on hand-written code.
    """
    leaves = [
        each for each in guards.states[state] if not isinstance(each.decision, DecisionGroup) and each.own != TRUE
    ]
    diagrams = guards.conditions.diagrams
    diagrams.begin_question()
    for first, second in combinations(leaves, 2):
        if _target(first, state) == _target(second, state):
            continue
        try:
            both = diagrams.both(guards.taken(first), second.own)
        except (TooLargeError, RecursionError):
            return
        example = find_example(guards.conditions, both)
        if example is not None:
            yield Overlap(first=first.path, second=second.path, example=example)


def _target(tested: TestedDecision, state: str) -> str:
    return tested.decision.to if isinstance(tested.decision, Transition) else state
