"""Judges the properties of a design: what is guaranteed for all inputs, and what a run breaks.

What no live transition allows is impossible. What the graph allows is possible only if a run of the reference
interpreter shows it: such a run is a counterexample, and without one the property is not decided.
"""

import math
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise

from vicode.analysis.counterexamples import CounterexampleSearch
from vicode.analysis.guards import Basis
from vicode.analysis.input_choice import DEFAULT_TICK_NS
from vicode.analysis.invariants import prove_invariant
from vicode.analysis.machines import LiveTransition, MachineAnalysis, SettledState
from vicode.analysis.property_monitor import within_ns
from vicode.analysis.walk import WalkStep
from vicode.model.design import (
    Design,
    InvariantProperty,
    NeverProperty,
    Property,
    ReachProperty,
    RecoveryProperty,
)
from vicode.model.project import Project

_ROUNDS = 20


class PropertyVerdict(StrEnum):
    """What is known about a property."""

    GUARANTEED = "guaranteed"
    """It holds for all inputs."""
    FAIR = "fair"
    """It holds if each state that may be left is left at some time, and each transition that may be taken is taken; for
    a way back, the guards always allow one.
    """
    FOUND = "found"
    """The way back was replayed from each state."""
    FAILS = "fails"
    """A replayed run breaks it."""
    UNDECIDED = "not decided"


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What is known about a property.

    Attributes:
        promised: The property.
        verdict: What is known.
        at_most_ns: The longest time until a state is reached, if it is guaranteed.
        lasso: States that can be active in this order without reaching a state; the last one is active forever, or
            the states from its earlier occurrence on repeat.
        steps: The run that breaks the property.
        basis: What a proof rests on.
    """

    promised: Property
    verdict: PropertyVerdict
    at_most_ns: int | None = None
    lasso: tuple[str, ...] = ()
    steps: tuple[WalkStep, ...] = ()
    basis: Basis = field(default_factory=Basis)


class PropertyAnalysis:
    """Judges the properties of a design without errors.

    Args:
        project: The project, with all designs.
        machine: The machine of one of them.
        may_search: Whether to search for counterexamples; without them, only proofs are found.
    """

    def __init__(self, project: Project, machine: MachineAnalysis, *, may_search: bool = True) -> None:
        self._machine = machine
        self._design = machine.design
        self._search = CounterexampleSearch(project if may_search else None, machine)
        self._settled_states: dict[str, SettledState | None] = {}
        hertz = machine.design.frequency_hz
        self._period_ns = round(1e9 / hertz) if hertz else DEFAULT_TICK_NS

    def judge_all(self) -> Iterator[Judgement]:
        """Yield what is known about each property, in their order."""
        return (self.judge(each) for each in self._design.properties)

    def judge(self, promised: Property) -> Judgement:
        """What is known about one property."""
        match promised:
            case ReachProperty():
                return self._judge_reach(promised)
            case NeverProperty():
                return self._judge_never(promised)
            case RecoveryProperty():
                return self._judge_recovery(promised)
            case InvariantProperty():
                return self._judge_invariant(promised)

    def _edges_of(self, name: str) -> list[LiveTransition]:
        """The first live transition to each target; none of a state that does not exist."""
        return self._edges.get(name, [])

    @cached_property
    def _edges(self) -> dict[str, list[LiveTransition]]:
        """The first live transition to each target, of the states that may be active."""
        return {
            name: list({each.target: each for each in reversed(self._machine.live_in(name))}.values())
            for name in self._machine.reachable
        }

    def _after(self, begin: str, goals: Collection[str]) -> dict[str, list[LiveTransition]]:
        """A shortest way to each state that can be active after one, without a goal on the way.

        The state itself has the way without transitions; goals that can be reached are in the result.
        """
        ways: dict[str, list[LiveTransition]] = {begin: []}
        pending = [begin]
        for name in pending:
            for edge in self._edges_of(name) if name not in goals or name == begin else ():
                if edge.target not in ways:
                    ways[edge.target] = [*ways[name], edge]
                    pending.append(edge.target)
        return ways

    # Reaching a state

    def _judge_reach(self, promised: ReachProperty) -> Judgement:
        begin, goal = promised.after or self._design.initial, promised.reach
        if begin not in self._machine.reachable or (begin == goal and not promised.after):
            return Judgement(promised=promised, verdict=PropertyVerdict.GUARANTEED, at_most_ns=0)
        ways = self._after(begin, {goal})
        passed = [name for name in ways if name != goal or name == begin]
        limit_ns = within_ns(self._machine.guards.conditions.table, promised, is_least=True)
        longest = self._find_longest(begin, goal, passed)
        if promised.within and limit_ns is None:
            return Judgement(promised=promised, verdict=PropertyVerdict.UNDECIDED, at_most_ns=longest)
        if longest is not None and (limit_ns is None or longest <= limit_ns):
            return Judgement(promised=promised, verdict=PropertyVerdict.GUARANTEED, at_most_ns=longest)
        lost = [name for name in passed if not self._leads_to(name, goal)]
        for name in lost:
            steps = self._search.lose(promised, begin, ways[name], self._time_to_lose(name, goal))
            if steps:
                states = (begin, *(edge.target for edge in ways[name]))
                return Judgement(promised=promised, verdict=PropertyVerdict.FAILS, lasso=states, steps=steps)
        lasso = () if longest is not None else self._find_lasso(begin, goal, passed, ways)
        if limit_ns is None and not lost:
            return Judgement(promised=promised, verdict=PropertyVerdict.FAIR, lasso=lasso)
        if limit_ns is not None:
            slow = [
                [*ways[name], *(edge for edge in self._edges_of(name) if edge.target == goal)]
                for name in sorted(passed, key=self._longest_in, reverse=True)
            ]
            for way in (*slow, self._repeat(lasso)):
                steps = self._search.follow(promised, begin, way, limit_ns)
                if steps:
                    return Judgement(promised=promised, verdict=PropertyVerdict.FAILS, lasso=lasso, steps=steps)
        return Judgement(promised=promised, verdict=PropertyVerdict.UNDECIDED, at_most_ns=longest, lasso=lasso)

    def _leads_to(self, name: str, goal: str) -> bool:
        """Whether transitions lead from a state to a goal, perhaps through others, however long it was active."""
        settled = self._settled(name)
        ways = (
            [self._edges_of(name)] if settled is None or not settled.may_stay else [self._edges_of(name), settled.live]
        )
        return all(self._can_lead(edges, goal) for edges in ways)

    def _can_lead(self, edges: Iterable[LiveTransition], goal: str) -> bool:
        return any(edge.target == goal or goal in self._after(edge.target, {goal}) for edge in edges)

    def _time_to_lose(self, name: str, goal: str) -> int:
        """How long a state must be active until no transitions lead from it to a goal, in ns; 0 if they never do."""
        settled = self._settled(name)
        is_lost_at_once = not self._can_lead(self._edges_of(name), goal)
        return 0 if is_lost_at_once or settled is None else settled.from_ns + self._period_ns

    def _settled(self, name: str) -> SettledState | None:
        if name not in self._settled_states:
            self._settled_states[name] = self._machine.settled(name)
        return self._settled_states[name]

    def _longest_in(self, state: str) -> float:
        """The longest time in a state in ns, as whole periods; infinite if it may be active forever."""
        time = self._machine.time_in(state)
        if time is None or time.at_most_ns is None:
            return math.inf
        # Without a frequency, iterations may come at other times: up to one period later.
        late_ns = 0 if self._design.frequency_hz else self._period_ns
        return max(1, math.ceil(time.at_most_ns / self._period_ns)) * self._period_ns + late_ns

    def _find_longest(self, begin: str, goal: str, passed: Collection[str]) -> int | None:
        """The longest time from the entry into a state until a goal is reached; None if there is none."""
        following = {name: {edge.target for edge in self._edges_of(name)} - {goal} for name in passed}
        times = {name: self._longest_in(name) for name in passed}
        try:
            order = list(TopologicalSorter(following).static_order())
        except CycleError:
            return None
        for name in order:
            times[name] += max((times[each] for each in following[name]), default=0)
        return None if math.isinf(times[begin]) else int(times[begin])

    def _find_lasso(
        self, begin: str, goal: str, passed: Collection[str], ways: dict[str, list[LiveTransition]]
    ) -> tuple[str, ...]:
        """States that may be active forever without the goal: one that may be held, or a cycle."""
        for name in passed:
            if math.isinf(self._longest_in(name)):
                return (begin, *(edge.target for edge in ways[name]))
        for name in passed:
            for edge in self._edges_of(name):
                back = {} if edge.target == goal else self._after(edge.target, {goal})
                if name in back:
                    cycle = (edge.target, *(each.target for each in back[name]))
                    return (begin, *(each.target for each in ways[name]), *cycle)
        return ()

    def _repeat(self, lasso: tuple[str, ...]) -> list[LiveTransition]:
        """The transitions along a lasso, with its cycle some times."""
        if not lasso:
            return []
        first = lasso.index(lasso[-1])
        states = (*lasso, *(lasso[first + 1 :] * _ROUNDS))
        return [
            next(edge for edge in self._edges_of(state) if edge.target == following)
            for state, following in pairwise(states)
        ]

    # The others

    def _judge_never(self, promised: NeverProperty) -> Judgement:
        begin, never, before = promised.after or self._design.initial, promised.never, promised.before
        ways = self._after(begin, {before}) if begin in self._machine.reachable else {}
        if begin == never and promised.after:
            # It is active again after some transition.
            again = [
                [*ways[name], edge]
                for name in ways
                if name != before
                for edge in self._edges_of(name)
                if edge.target == never
            ]
            way = min(again, key=len, default=None)
        else:
            way = ways.get(never) if begin != before or promised.after else None
        if way is None:
            return Judgement(promised=promised, verdict=PropertyVerdict.GUARANTEED)
        steps = self._search.follow(promised, begin, way)
        states = (begin, *(edge.target for edge in way))
        verdict = PropertyVerdict.FAILS if steps else PropertyVerdict.UNDECIDED
        return Judgement(promised=promised, verdict=verdict, lasso=states, steps=steps)

    def _judge_recovery(self, promised: RecoveryProperty) -> Judgement:
        goal, verdict = promised.can_reach, PropertyVerdict.FAIR
        lost = sorted(name for name in self._machine.reachable if name != goal and not self._leads_to(name, goal))
        for name in lost:
            steps = self._search.go_to(name, hold_ns=self._time_to_lose(name, goal))
            if steps:
                return Judgement(promised=promised, verdict=PropertyVerdict.FAILS, lasso=(name,), steps=steps)
        if lost:
            verdict = PropertyVerdict.UNDECIDED
        elif all(self._has_way_back(name, goal) for name in self._machine.reachable):
            verdict = PropertyVerdict.FOUND
        return Judgement(promised=promised, verdict=verdict, lasso=tuple(lost[:1]))

    def _has_way_back(self, name: str, goal: str) -> bool:
        """Whether a run leads from a state to a goal; the initial state may be left before it can be seen."""
        return bool(self._search.go_to(name, goal) or (name == self._design.initial and self._search.go_to(goal)))

    def _judge_invariant(self, promised: InvariantProperty) -> Judgement:
        basis = prove_invariant(self._machine, promised.holds)
        if basis is not None:
            return Judgement(promised=promised, verdict=PropertyVerdict.GUARANTEED, basis=basis)
        steps = self._search.explore(promised)
        return Judgement(
            promised=promised,
            verdict=PropertyVerdict.FAILS if steps else PropertyVerdict.UNDECIDED,
            steps=steps,
        )


def judge_properties(project: Project, design: Design, *, may_search: bool = True) -> tuple[Judgement, ...]:
    """Judge the properties of a design, with the assumptions without which the verdicts would differ."""
    if not design.properties:
        return ()
    machine = MachineAnalysis(project, design)
    judged = tuple(PropertyAnalysis(project, machine, may_search=may_search).judge_all())
    assumptions = machine.guards.conditions.table.assumptions
    if not assumptions:
        return judged
    components = tuple(replace(each, assume="") for each in project.components)
    plain = replace(project, components=components)
    without = PropertyAnalysis(plain, MachineAnalysis(plain, design), may_search=may_search).judge_all()
    facts = tuple(f"assumed of {each.text}" for each in assumptions)
    return tuple(
        each if each.verdict is other.verdict or each.basis.facts else replace(each, basis=Basis(facts=facts))
        for each, other in zip(judged, without, strict=True)
    )
