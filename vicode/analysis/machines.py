"""What guards mean for the state machine: which states can be active, and for how long.

A transition is live if it is not proved that it can never be taken. The graph of live transitions contains every change
of state that is possible, and possibly more: a state that it does not reach is never active.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.guards import GuardAnalysis, analyze_guards
from vicode.analysis.interval_diagrams import BEFORE_NAN, FALSE, TRUE, Interval, Node, TooLargeError
from vicode.findings import DesignPath
from vicode.model.design import Design, Transition
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, iter_transitions

_LATE_NS = 10**15
"""A time in a state after which also computed times are beyond the constants of a design."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveTransition:
    """A transition that may be taken.

    Attributes:
        path: Its path in the design.
        target: Another state.
        taken: The values for which it is taken.
    """

    path: DesignPath
    target: str
    taken: Node


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeInState:
    """How long a state is active, by the times at which its guards are tested.

    Attributes:
        at_least_ns: No transition is taken before this time, whatever the inputs are.
        at_most_ns: From this time on, some transition is taken, whatever the inputs are; None if none has to be.
    """

    at_least_ns: int
    at_most_ns: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class SettledState:
    """A state in which all timers have elapsed.

    Attributes:
        from_ns: The time after which no timer changes anything.
        may_stay: Whether it may be active for so long.
        live: The transitions that may still be taken.
    """

    from_ns: int
    may_stay: bool
    live: tuple[LiveTransition, ...]


class MachineAnalysis:
    """The live transitions of a design; everything is computed when it is first read.

    Args:
        project: The project.
        design: One of its designs, which may have errors.
    """

    def __init__(self, project: Project, design: Design) -> None:
        self._project = project
        self.design = design
        self._live: dict[str, tuple[LiveTransition, ...]] = {}

    @cached_property
    def guards(self) -> GuardAnalysis:
        """The decisions of the design."""
        return analyze_guards(self._project, self.design)

    @cached_property
    def live(self) -> Mapping[str, tuple[LiveTransition, ...]]:
        """The live transitions of each enabled state, common ones included."""
        return {state.name: self.live_in(state.name) for state in self.design.states if not state.disabled}

    def live_in(self, state: str) -> tuple[LiveTransition, ...]:
        """The live transitions of one state; none if there is no such state or it is disabled."""
        if state not in self._live:
            self._live[state] = tuple(self._find_live(state)) if state in self.guards.states else ()
        return self._live[state]

    @cached_property
    def reachable(self) -> frozenset[str]:
        """The states that may become active."""
        pending, reachable = [self.design.initial], set[str]()
        ways_back = {each.path for each in iter_transitions(self.design) if _continues(self.design, each)}
        while pending:
            name = pending.pop()
            if name not in reachable and name in self.live:
                reachable.add(name)
                pending += (each.target for each in self.live[name] if each.path not in ways_back)
        return frozenset(reachable)

    def time_in(self, state: str) -> TimeInState | None:
        """How long a state is active; None if its diagrams are too large."""
        self.guards.conditions.diagrams.begin_question()
        try:
            return self._find_time(state)
        except (TooLargeError, RecursionError):
            return None

    def settled(self, state: str) -> "SettledState | None":
        """What is possible once no timer of a state changes anything; None if its diagrams are too large."""
        diagrams = self.guards.conditions.diagrams
        diagrams.begin_question()
        try:
            stays, edges = self.staying(state), self.live_in(state)
            cuts = diagrams.find_cuts((stays, *(each.taken for each in edges))).get(STATE_TIME, ())
            last_ns = max((int(number) for number, _side in cuts if math.isfinite(number)), default=0)
            late = diagrams.test(STATE_TIME, (((max(last_ns, _LATE_NS) + 1, 0), BEFORE_NAN),))
            return SettledState(
                from_ns=last_ns,
                may_stay=self.guards.is_possible(diagrams.both(stays, late)),
                live=tuple(each for each in edges if self.guards.is_possible(diagrams.both(each.taken, late))),
            )
        except (TooLargeError, RecursionError):
            return None

    def staying(self, state: str) -> Node:
        """The values for which a state may not be left.

        Raises:
            TooLargeError: The diagram has too many nodes.
        """
        diagrams, stays = self.guards.conditions.diagrams, TRUE
        for each in self.live_in(state):
            # The team decides whether a robot enters a cooperative state.
            if not self._is_cooperative(each.target):
                stays = diagrams.without(stays, each.taken)
        return stays

    def find_times(self, node: Node) -> list[Interval]:
        """The times in a state for which some values are in a diagram.

        Raises:
            TooLargeError: The diagram has too many nodes.
        """
        possible = self.guards.conditions.possible((node,), with_nan=False)
        return self.guards.conditions.diagrams.intervals_of(
            self.guards.conditions.diagrams.both(node, possible), STATE_TIME
        )

    def _find_time(self, state: str) -> TimeInState:
        leaving = FALSE
        for each in self.live_in(state):
            leaving = self.guards.conditions.diagrams.either(leaving, each.taken)
        leaves, stays = (self.find_times(node) for node in (leaving, self.staying(state)))
        last = stays[-1][1] if stays else (0, 0)
        return TimeInState(
            at_least_ns=int(max(0, leaves[0][0][0])) if leaves else 0,
            at_most_ns=None if last >= BEFORE_NAN else int(last[0]),
        )

    def _find_live(self, state: str) -> list[LiveTransition]:
        self.guards.conditions.diagrams.begin_question()
        return [
            LiveTransition(path=each.path, target=each.decision.to, taken=taken)
            for each in (*self.guards.common, *self.guards.states[state])
            if isinstance(each.decision, Transition)
            and each.decision.to != state
            and self.guards.is_possible(taken := self.guards.taken(each))
        ]

    def _is_cooperative(self, name: str) -> bool:
        state = self.design.state(name)
        return state is not None and (state.capacity is not None or state.synchronized is not None)


def _continues(design: Design, located: LocatedDecision) -> bool:
    """Whether a transition leads from the end of an interrupt to where the design was, or would have been, before."""
    match getattr(located.decision, "origin", ()):
        case ("interrupts", int(number)) if located.source == design.interrupts[number].do:
            return design.interrupts[number].then in ("", "resume", "skip")
        case _:
            return False
