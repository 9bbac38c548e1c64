"""Properties of small random designs, compared with an exploration of every state, time and input."""

import os
import random
from collections import Counter
from functools import cache
from itertools import product

import pytest

from tests.analysis.test_explored_designs import LAST, NAMES, TICK_NS, Explored, Explorer, draw_design
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.properties import Judgement, PropertyAnalysis, PropertyVerdict
from vicode.model.design import NeverProperty, ReachProperty, RecoveryProperty
from vicode.model.project import Project

SEEDS = range(int(os.environ.get("VICODE_EXPLORED", "8")))
Place = tuple[str, int]
"""A state, and the time in it in ticks when the next iteration comes."""


class Graph:
    """All that can follow each other, iteration by iteration."""

    def __init__(self, explored: Explored) -> None:
        self.explored = explored

    def following(self, place: Place) -> set[Place]:
        state, elapsed = place
        return {(each, min(elapsed + 1, LAST) if each == state else 1) for each in self.explored[place]}

    def reachable(self, places: set[Place]) -> set[Place]:
        pending, found = list(places), set[Place]()
        while pending:
            place = pending.pop()
            if place not in found:
                found.add(place)
                pending += self.following(place)
        return found

    @property
    def all(self) -> set[Place]:
        return self.reachable({("A", 0)})

    def longest(self, place: Place, goal: str) -> float:
        """The most iterations after that of a place until a goal is entered; infinite if it may never be."""

        @cache
        def count(place: Place, steps: int) -> float:
            if steps == 0:
                return float("inf")
            after = [
                1 if each == goal and each != place[0] else 1 + count((each, elapsed), steps - 1)
                for each, elapsed in self.following(place)
            ]
            return max(after)

        # A run that is longer than the number of places repeats one.
        return count(place, len(NAMES) * (LAST + 1) + 1)

    def can_enter(self, place: Place, goal: str) -> bool:
        return any(
            each == goal and each != state
            for state, elapsed in self.reachable({place})
            for each in self.explored[state, elapsed]
        )

    def without(self, place: Place, goal: str) -> set[Place]:
        """The places after a place before a goal is entered, itself included."""
        pending, found = [place], set[Place]()
        while pending:
            here = pending.pop()
            if here not in found:
                found.add(here)
                pending += [each for each in self.following(here) if each[0] != goal or each[0] == here[0]]
        return found

    def begins(self, after: str) -> set[Place]:
        """The places after the entry into a state, or after the start."""
        entered = {("A", 0)} if after in ("", "A") else set()
        is_reentered = any(after in self.explored[place] and place[0] != after for place in self.all)
        return entered | ({(after, 1)} if is_reentered else set())


def explore(seed: int) -> tuple[PropertyAnalysis, Graph]:
    design = draw_design(random.Random(seed))
    project = Project(name="p", designs=(design,))
    return PropertyAnalysis(project, MachineAnalysis(project, design)), Graph(Explorer(design).explore())


UNDECIDED: Counter[tuple[str, str]] = Counter()


def compare(judged: Judgement, expected: PropertyVerdict) -> None:
    """No verdict claims too much; those that claim too little are counted."""
    kept = (PropertyVerdict.GUARANTEED, PropertyVerdict.FAIR, PropertyVerdict.UNDECIDED)
    allowed = {
        PropertyVerdict.GUARANTEED: kept,
        PropertyVerdict.FAIR: kept[1:],
        PropertyVerdict.FOUND: (PropertyVerdict.FOUND, *kept[1:]),
        # A time between two iterations is possible if an iteration is late.
        PropertyVerdict.FAILS: (PropertyVerdict.FAILS, *kept[1:]),
    }
    assert judged.verdict in allowed[expected], judged
    kind = type(judged.promised).__name__
    UNDECIDED[kind, "all"] += 1
    UNDECIDED[kind, "too little"] += judged.verdict is not expected


@pytest.mark.parametrize("seed", SEEDS)
def test_states_that_are_reached(seed: int) -> None:
    analysis, graph = explore(seed)
    for after, goal in product(("", *NAMES), NAMES):
        judged = analysis.judge(ReachProperty(after=after, reach=goal))
        begins = graph.begins(after) if after or goal != "A" else set()
        longest = max((graph.longest(each, goal) for each in begins), default=0)
        if longest < float("inf"):
            expected = PropertyVerdict.GUARANTEED
            # The first iteration after a start tests at the time 0.
            assert judged.at_most_ns is None or judged.at_most_ns >= (longest - (("A", 0) in begins)) * TICK_NS
        elif all(graph.can_enter(each, goal) for begin in begins for each in graph.without(begin, goal)):
            expected = PropertyVerdict.FAIR
        else:
            expected = PropertyVerdict.FAILS
        compare(judged, expected)


@pytest.mark.parametrize("seed", SEEDS)
def test_states_that_are_reached_in_time(seed: int) -> None:
    analysis, graph = explore(seed)
    for after, goal, ticks in product(NAMES[1:], NAMES, (1, 3, 6)):
        judged = analysis.judge(ReachProperty(after=after, reach=goal, within=f"{ticks * TICK_NS / 1e9:g}"))
        is_kept = all(graph.longest(each, goal) <= ticks for each in graph.begins(after))
        compare(judged, PropertyVerdict.GUARANTEED if is_kept else PropertyVerdict.FAILS)


@pytest.mark.parametrize("seed", SEEDS)
def test_states_that_are_never_active(seed: int) -> None:
    analysis, graph = explore(seed)
    for after, never, before in product(("", *NAMES), NAMES, ("", *NAMES)):
        judged = analysis.judge(NeverProperty(after=after, never=never, before=before))
        is_broken = any(
            each == never and each != state
            for begin in graph.begins(after)
            for state, elapsed in graph.without(begin, before)
            for each in graph.explored[state, elapsed]
        )
        if not after:
            is_broken = before != "A" and (is_broken or never == "A")
        compare(judged, PropertyVerdict.FAILS if is_broken else PropertyVerdict.GUARANTEED)


@pytest.mark.parametrize("seed", SEEDS)
def test_states_that_can_be_reached_again(seed: int) -> None:
    analysis, graph = explore(seed)
    for goal in NAMES:
        judged = analysis.judge(RecoveryProperty(can_reach=goal))
        is_kept = all(place[0] == goal or graph.can_enter(place, goal) for place in graph.all)
        compare(judged, PropertyVerdict.FOUND if is_kept else PropertyVerdict.FAILS)


def test_few_properties_are_not_decided() -> None:
    for seed in range(4):
        for test in (
            test_states_that_are_reached,
            test_states_that_are_reached_in_time,
            test_states_that_are_never_active,
            test_states_that_can_be_reached_again,
        ):
            test(seed)
    kinds = {kind for kind, _ in UNDECIDED}
    shares = {kind: UNDECIDED[kind, "too little"] / UNDECIDED[kind, "all"] for kind in kinds}
    assert max(shares.values()) < 0.1, shares
