"""Robots that agree on who is in a state: only so many at once, or so many together, by what they tell each other."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .component import Component

StateKey = tuple[str, str]
"""A cooperative state: the names of its component and of itself."""


@dataclass(frozen=True, slots=True)
class TeamMessage:
    """What a robot tells the others: the cooperative states it is in, wants to enter, and whose component works."""

    priority: int = 0
    executed: tuple[StateKey, ...] = ()
    entering: tuple[StateKey, ...] = ()
    near: tuple[StateKey, ...] = ()


@dataclass(slots=True, eq=False)
class CooperativeState:
    """What a robot knows of the others at one state.

    Args:
        team: This robot among the others.
        number: How many may be in it, or must enter it at once.
        is_capacity: At most `number` may be in it; else at least so many enter at once.
    """

    team: Team
    number: int
    is_capacity: bool
    executing: int = 0
    entering: int = 0
    in_component: int = 0
    highest_priority: int = 0
    is_entering: bool = False
    waiting_iterations: int = 0

    def reset(self) -> None:
        """Forget what the others told; count the cycles since this robot wants to enter."""
        self.executing = self.entering = self.in_component = 0
        self.waiting_iterations = self.waiting_iterations + 1 if self.is_entering else 0
        self.is_entering = False

    @property
    def is_full(self) -> bool:
        """Whether as many others are in it as may be."""
        return self.is_capacity and self.executing >= self.number

    def may_enter(self) -> bool:
        """Whether this robot may be in it now; else the others are told that it wants to, unless it gives way."""
        return self._can_enter_within_capacity() if self.is_capacity else self._can_enter_together()

    def _can_enter_within_capacity(self) -> bool:
        is_wanted = self.executing + self.entering >= self.number
        if is_wanted and not self.is_full and self.highest_priority == self.team.priority:
            # Two of one priority: neither enters, and both give way.
            return False
        is_free = not self.is_full and not (is_wanted and self.highest_priority > self.team.priority)
        if is_free and self.waiting_iterations >= self.team.ticks:
            return True
        self.is_entering = True
        return False

    def _can_enter_together(self) -> bool:
        self.is_entering = True
        are_enough = self.in_component + 1 >= self.number
        are_ready = self.executing + self.entering == self.in_component
        return are_enough and are_ready and self.waiting_iterations > self.team.ticks // 2


@dataclass(slots=True, eq=False)
class Team:
    """This robot among the others; `ticks` are the iterations until an answer of the others has come."""

    priority: int = 0
    ticks: int = 0
    _states: dict[StateKey, tuple[Component, CooperativeState]] = field(default_factory=dict)

    def join(self, component: Component, state: str, *, capacity: int | None, synchronized: int) -> CooperativeState:
        """Make a state of a component one that robots agree on."""
        number = synchronized if capacity is None else capacity
        made = CooperativeState(self, number, capacity is not None)
        self._states[type(component).__name__, state] = (component, made)
        return made

    def prepare(self) -> None:
        """Forget what the others told; before their new messages are heard, once an iteration."""
        for _component, state in self._states.values():
            state.reset()

    def hear(self, message: TeamMessage) -> None:
        """Take in the message of another robot; states that this one does not have are ignored."""
        for place in message.executed:
            if place in self._states:
                self._states[place][1].executing += 1
        for place in message.entering:
            if place in self._states:
                state = self._states[place][1]
                state.highest_priority = (
                    max(state.highest_priority, message.priority) if state.entering else message.priority
                )
                state.entering += 1
        for place in message.near:
            if place in self._states:
                self._states[place][1].in_component += 1

    def tell(self) -> TeamMessage:
        """What the others must hear after this iteration."""
        executed, entering, near = [], [], []
        for place, (component, state) in self._states.items():
            if component._stepped_in != component.root.iteration:
                continue
            near.append(place)
            if component.state == place[1]:
                executed.append(place)
            elif state.is_entering:
                entering.append(place)
        return TeamMessage(self.priority, tuple(executed), tuple(entering), tuple(near))
