"""Cooperative states: robots of a team limit the number of robots in a state, or enter a state together.

The robots coordinate with `TeamMessage`s, which the robot program exchanges.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .component import Component

StateKey = tuple[str, str]
"""A cooperative state: the names of its component and of itself."""


@dataclass(frozen=True, slots=True)
class TeamMessage:
    """The message of a robot to its team.

    Attributes:
        priority: Priority of the robot.
        executed: Cooperative states that the robot is in.
        entering: Cooperative states that the robot is about to enter.
        near: Cooperative states of active components.
    """

    priority: int = 0
    executed: tuple[StateKey, ...] = ()
    entering: tuple[StateKey, ...] = ()
    near: tuple[StateKey, ...] = ()


@dataclass(slots=True, eq=False)
class CooperativeState:
    """A cooperative state, and what the other robots do there.

    Args:
        team: The team of this robot.
        number: The capacity, or the number of robots that enter together.
        is_capacity: Whether `number` is the capacity.
        executing: Number of other robots in the state.
        entering: Number of other robots that are about to enter the state.
        in_component: Number of other robots whose component is active.
        highest_priority: Highest priority of the robots that are about to enter the state.
        is_entering: Whether this robot is about to enter the state.
        waiting_iterations: Number of iterations since this robot is about to enter the state.
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
        """Clear the messages of the last iteration and update `waiting_iterations`."""
        self.executing = self.entering = self.in_component = 0
        self.waiting_iterations = self.waiting_iterations + 1 if self.is_entering else 0
        self.is_entering = False

    @property
    def is_full(self) -> bool:
        """Whether other robots fill the capacity."""
        return self.is_capacity and self.executing >= self.number

    def may_enter(self) -> bool:
        """Return whether this robot may enter the state now. If not, announce its intention, unless it yields."""
        return self._can_enter_within_capacity() if self.is_capacity else self._can_enter_together()

    def _can_enter_within_capacity(self) -> bool:
        is_contested = self.executing + self.entering >= self.number
        if is_contested and not self.is_full and self.highest_priority == self.team.priority:
            # Robots with equal priority yield to each other: none of them enters.
            return False
        is_free = not self.is_full and not (is_contested and self.highest_priority > self.team.priority)
        if is_free and self.waiting_iterations >= self.team.ticks:
            return True
        self.is_entering = True
        return False

    def _can_enter_together(self) -> bool:
        self.is_entering = True
        has_enough_robots = self.in_component + 1 >= self.number
        is_team_ready = self.executing + self.entering == self.in_component
        return has_enough_robots and is_team_ready and self.waiting_iterations > self.team.ticks // 2


@dataclass(slots=True, eq=False)
class Team:
    """The states of this robot that the robots of a team coordinate.

    Attributes:
        priority: Priority of this robot, where only one may enter a state.
        ticks: Number of iterations until the other robots have answered a message.
        size: Number of robots that are alive: this one, and those whose messages were received for this iteration.
    """

    priority: int = 0
    ticks: int = 0
    size: int = 1
    _states: dict[StateKey, tuple[Component, CooperativeState]] = field(default_factory=dict)
    _is_alone: bool = True
    """Whether the robot program exchanges no messages."""

    def join(self, component: Component, state: str, *, capacity: int | None, synchronized: int) -> CooperativeState:
        """Register a state of a component as a cooperative state."""
        number = synchronized if capacity is None else capacity
        cooperative_state = CooperativeState(self, number, capacity is not None)
        self._states[type(component).__name__, state] = (component, cooperative_state)
        return cooperative_state

    def prepare(self) -> None:
        """Clear the messages of the last iteration. Call it once per iteration, before `hear`.

        If the robot program never calls it, the robot is alone in its team.
        """
        self._is_alone = False
        self._clear()

    def _begin_iteration(self) -> None:
        if self._is_alone:
            self._clear()

    def _clear(self) -> None:
        self.size = 1
        for _component, state in self._states.values():
            state.reset()

    def hear(self, message: TeamMessage) -> None:
        """Process the message of another robot; unknown states are ignored."""
        self.size += 1
        for key in message.executed:
            if key in self._states:
                self._states[key][1].executing += 1
        for key in message.entering:
            if key in self._states:
                state = self._states[key][1]
                state.highest_priority = (
                    max(state.highest_priority, message.priority) if state.entering else message.priority
                )
                state.entering += 1
        for key in message.near:
            if key in self._states:
                self._states[key][1].in_component += 1

    def tell(self) -> TeamMessage:
        """Return the message to the other robots. Call it after each iteration."""
        executed, entering, near = [], [], []
        for key, (component, state) in self._states.items():
            if component._stepped_in != component.root.iteration:
                continue
            near.append(key)
            if component.state == key[1]:
                executed.append(key)
            elif state.is_entering:
                entering.append(key)
        return TeamMessage(self.priority, tuple(executed), tuple(entering), tuple(near))
