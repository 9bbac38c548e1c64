"""Runs of the reference interpreter that break a property, confirmed by its monitor."""

import random
from collections.abc import Sequence
from typing import Any

from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.interval_diagrams import BEFORE_NAN, TooLargeError
from vicode.analysis.machines import LiveTransition, MachineAnalysis
from vicode.analysis.property_monitor import ObservedStep, create_monitor
from vicode.analysis.walk import Walk, WalkStep
from vicode.model.design import InvariantProperty, Property
from vicode.model.project import Project
from vicode.semantics import NotInterpretableError

_Way = Sequence[LiveTransition]
_MOST_HELD = 5_000
_RANDOM_RUNS, _RANDOM_STEPS = 12, 60


class CounterexampleSearch:
    """Looks for runs that break a property; an empty result means that none was found.

    Args:
        project: The project, with all designs.
        machine: The machine of the design that is the root.
    """

    def __init__(self, project: Project, machine: MachineAnalysis) -> None:
        self._project = project
        self._machine = machine
        self._design = machine.design

    def lose(self, promised: Property, begin: str, way: _Way, hold_ns: int) -> tuple[WalkStep, ...]:
        """A run along a way at the end of which the property still waits; its last state lasts longer than a time."""
        walk = self._walk(begin, way)
        if walk is not None and hold_ns and not self._hold(walk, hold_ns):
            return ()
        is_there = walk is not None and walk.state == (way[-1].target if way else begin)
        return tuple(walk.steps) if walk and is_there and self._replay(promised, walk.steps)[1] else ()

    def follow(self, promised: Property, begin: str, way: _Way) -> tuple[WalkStep, ...]:
        """A run along a way that breaks the property."""
        walk = self._walk(begin, way)
        return tuple(walk.steps) if walk and self._replay(promised, walk.steps)[0] else ()

    def exceed(self, promised: Property, begin: str, way: _Way, limit_ns: int) -> tuple[WalkStep, ...]:
        """A run along a way in which the states last as long as possible, beyond a time."""
        walk = self._walk(begin, way, limit_ns)
        return tuple(walk.steps) if walk and self._replay(promised, walk.steps)[0] else ()

    def go_to(self, *states: str, hold_ns: int = 0) -> tuple[WalkStep, ...]:
        """A run that visits states one after another; the last one lasts longer than a time."""
        walk = self._create_walk()
        is_there = (
            walk is not None
            and all(walk.go_to(state) for state in states)
            and (not hold_ns or self._hold(walk, hold_ns))
        )
        return tuple(walk.steps) if walk is not None and is_there else ()

    def explore(self, promised: InvariantProperty) -> tuple[WalkStep, ...]:
        """A run at the end of which a condition is false, among some random ones, always the same."""
        for seed in range(_RANDOM_RUNS):
            walk, generator = self._create_walk(), random.Random(seed)
            if walk is None:
                return ()
            walk.step({}, 0)
            for _ in range(_RANDOM_STEPS):
                if not walk.holds(promised.holds):
                    return tuple(walk.steps)
                edges = list(self._machine.live_in(walk.state))
                generator.shuffle(edges)
                if generator.random() < 0.4 and self._hold(walk, walk.tick_ns):
                    continue
                if not any(walk.take(edge) for edge in edges) and not self._hold(walk, walk.tick_ns):
                    break
        return ()

    def _create_walk(self) -> Walk | None:
        try:
            return Walk(self._project, self._machine)
        except NotInterpretableError:
            return None

    def _walk(self, begin: str, way: _Way, limit_ns: int = 0) -> Walk | None:
        """A run to a state and along a way, as far as possible; None if the state was not reached."""
        walk = self._create_walk()
        if walk is None:
            return None
        if not walk.go_to(begin):
            # The initial state may be left in the first iteration.
            walk = self._create_walk()
            if walk is None or not way or begin != self._design.initial or not walk.go_to(way[0].target):
                return None
            way = way[1:]
        for edge in way:
            if limit_ns:
                self._hold(walk, limit_ns)
            same = [each for each in self._machine.live_in(walk.state) if each.target == edge.target]
            if not any(walk.take(each) for each in same):
                break
        if limit_ns:
            self._hold(walk, limit_ns)
        return walk

    def _hold(self, walk: Walk, limit_ns: int) -> bool:
        """Stay in the active state beyond a time, or as long as possible."""
        time = self._machine.time_in(walk.state)
        if time is None:
            return False
        longest = limit_ns + walk.tick_ns if time.at_most_ns is None else min(limit_ns, time.at_most_ns - 1)
        count = min(longest // walk.tick_ns, _MOST_HELD)
        diagrams = self._machine.guards.conditions.diagrams
        diagrams.begin_question()
        try:
            late = diagrams.test(STATE_TIME, (((count * walk.tick_ns, 0), BEFORE_NAN),))
            node = diagrams.both(self._machine.staying(walk.state), late)
        except (TooLargeError, RecursionError):
            return False
        return count > 0 and walk.hold(node, [walk.state] * count)

    def _replay(self, promised: Property, steps: Sequence[WalkStep]) -> tuple[bool, bool]:
        """Whether a run breaks a property, and whether the property waits for a state at its end."""
        monitor = create_monitor(self._machine.guards.conditions.table, promised)
        is_broken, before = False, ""
        for step in steps:
            # The initial state may be left in the first iteration.
            for state in (step.state,) if before else dict.fromkeys((self._design.initial, step.state)):
                observed = ObservedStep(
                    time_ns=step.time_ns, state=state, is_start=not before, is_entered=state != before
                )
                is_broken = monitor.observe(observed, _unknown) or is_broken
                before = state
        return is_broken, monitor.since_ns is not None


def _unknown(_condition: str) -> Any:
    return None
