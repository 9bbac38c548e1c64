"""Runs of the reference interpreter that break a property, confirmed by its monitor."""

import random
from collections.abc import Callable, Sequence
from functools import partial
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
_MOST_HELD, _MOST_STEPS = 5_000, 20_000
_RANDOM_RUNS, _RANDOM_STEPS = 8, 50


class CounterexampleSearch:
    """Looks for runs that break a property; an empty result means that none was found.

    Args:
        project: The project, with all designs; None to find nothing.
        machine: The machine of the design that is the root.
    """

    def __init__(self, project: Project | None, machine: MachineAnalysis) -> None:
        self._project = project
        self._machine = machine
        self._design = machine.design

    def lose(self, promised: Property, begin: str, way: _Way, hold_ns: int) -> tuple[WalkStep, ...]:
        """A run along a way at the end of which the property still waits; its last state lasts longer than a time."""

        def search(walk: Walk) -> bool:
            is_there = self._follow(walk, begin, way) and walk.state == (way[-1].target if way else begin)
            return is_there and (not hold_ns or self._hold(walk, hold_ns)) and self._replay(promised, walk.steps)[1]

        return self._find(search)

    def follow(self, promised: Property, begin: str, way: _Way, limit_ns: int = 0) -> tuple[WalkStep, ...]:
        """A run along a way that breaks the property; with a limit, each state lasts as long as possible up to it."""
        steps = self._find(
            lambda walk: self._follow(walk, begin, way, limit_ns) and bool(self._replay(promised, walk.steps)[0])
        )
        # The run ends where the property is broken.
        return steps[: self._replay(promised, steps)[0]]

    def go_to(self, *states: str, hold_ns: int = 0) -> tuple[WalkStep, ...]:
        """A run that visits states one after another; the last one lasts longer than a time."""
        return self._find(
            lambda walk: all(walk.go_to(state) for state in states) and (not hold_ns or self._hold(walk, hold_ns))
        )

    def explore(self, promised: InvariantProperty) -> tuple[WalkStep, ...]:
        """A run at the end of which a condition is false, among some random ones, always the same."""
        runs = (
            self._find(partial(self._wander, condition=promised.holds, generator=random.Random(seed)))
            for seed in range(_RANDOM_RUNS)
        )
        return next((steps for steps in runs if steps), ())

    def _find(self, search: Callable[[Walk], bool]) -> tuple[WalkStep, ...]:
        """The steps of a run that is successful; none if it is not, or the designs cannot be interpreted."""
        if self._project is None:
            return ()
        try:
            walk = Walk(self._project, self._machine)
            return self._fill(self._project, walk.steps) if search(walk) else ()
        except NotInterpretableError:
            return ()

    def _fill(self, project: Project, steps: Sequence[WalkStep]) -> tuple[WalkStep, ...]:
        """The run with an iteration in each period; none if that is another run."""
        walk, state = Walk(project, self._machine), self._design.initial
        for step in steps:
            while walk.steps and walk.steps[-1].time_ns + walk.tick_ns < step.time_ns:
                walk.step({}, walk.steps[-1].time_ns + walk.tick_ns)
                if walk.state != state or len(walk.steps) > _MOST_STEPS:
                    return ()
            walk.step(step.inputs, step.time_ns)
            state = walk.state
            if state != step.state:
                return ()
        return tuple(walk.steps)

    def _wander(self, walk: Walk, *, condition: str, generator: random.Random) -> bool:
        """Take random transitions until a condition is false."""
        walk.step({}, 0)
        for _ in range(_RANDOM_STEPS):
            if not walk.holds(condition):
                return True
            edges = list(self._machine.live_in(walk.state)) if generator.random() < 0.5 else []
            generator.shuffle(edges)
            if not any(walk.take(edge) for edge in edges):
                walk.step({}, walk.steps[-1].time_ns + walk.tick_ns)
        return False

    def _follow(self, walk: Walk, begin: str, way: _Way, limit_ns: int = 0) -> bool:
        """Go to a state and along a way, as far as possible; whether the state was reached."""
        if not walk.go_to(begin):
            # The initial state may be left in the first iteration.
            if not way or begin != self._design.initial or walk.steps or not walk.go_to(way[0].target):
                return False
            way = way[1:]
        for edge in way:
            if limit_ns:
                self._hold(walk, limit_ns)
            same = [each for each in self._machine.live_in(walk.state) if each.target == edge.target]
            if not any(walk.take(each) for each in same):
                break
        if limit_ns:
            self._hold(walk, limit_ns)
        return True

    def _hold(self, walk: Walk, limit_ns: int) -> bool:
        """Stay in the active state beyond a time, or as long as possible."""
        time = self._machine.time_in(walk.state)
        if time is None:
            return False
        longest = limit_ns + walk.tick_ns
        if time.at_most_ns is not None:
            longest = min(longest, time.at_most_ns - 1)
        count = min(longest // walk.tick_ns, _MOST_HELD)
        diagrams = self._machine.guards.conditions.diagrams
        diagrams.begin_question()
        try:
            late = diagrams.test(STATE_TIME, (((count * walk.tick_ns, 0), BEFORE_NAN),))
            node = diagrams.both(self._machine.staying(walk.state), late)
        except (TooLargeError, RecursionError):
            return False
        return count > 0 and walk.hold(node, [walk.state] * count)

    def _replay(self, promised: Property, steps: Sequence[WalkStep]) -> tuple[int, bool]:
        """How many steps break a property, 0 if none do, and whether the property waits for a state at the end."""
        monitor = create_monitor(self._machine.guards.conditions.table, promised)
        broken_after, before = 0, ""
        for count, step in enumerate(steps, start=1):
            # The initial state may be left in the first iteration.
            for state in (step.state,) if before else dict.fromkeys((self._design.initial, step.state)):
                observed = ObservedStep(
                    time_ns=step.time_ns, state=state, is_start=not before, is_entered=state != before
                )
                if monitor.observe(observed, _unknown) and not broken_after:
                    broken_after = count
                before = state
        return broken_after, monitor.since_ns is not None


def _unknown(_condition: str) -> Any:
    return None
