"""States that the robots of a team coordinate: "Teams" in the section "Rules around a step".

Each robot tells the others after an iteration which of these states its active components have (`near`), which it is in
(`executed`) and which it waits to enter (`entering`).
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

Place = tuple[str, str]
"""A component and one of its states."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotReport:
    """What a robot tells the others after an iteration."""

    priority: int = 0
    executed: frozenset[Place] = frozenset()
    entering: frozenset[Place] = frozenset()
    near: frozenset[Place] = frozenset()


@dataclass(slots=True)
class TeamMemory:
    """What a robot knows of its team.

    Attributes:
        priority: The priority of this robot.
        ticks: The number of iterations until the other robots have answered.
        reports: What the others told since the last iteration.
        waiting: The places that this robot announces in this iteration.
        waited: For how many iterations in a row it has announced a place before this one.
    """

    priority: int = 0
    ticks: int = 0
    reports: tuple[RobotReport, ...] = ()
    waiting: set[Place] = field(default_factory=set)
    waited: dict[Place, int] = field(default_factory=dict)

    def begin_iteration(self, reports: Iterable[RobotReport]) -> None:
        self.reports = tuple(reports)
        self.waited = {place: self.waited.get(place, 0) + 1 for place in self.waiting}
        self.waiting = set()

    def is_full(self, place: Place, capacity: int) -> bool:
        """Whether the other robots fill the capacity of a state."""
        return sum(place in report.executed for report in self.reports) >= capacity

    def may_enter_with_capacity(self, place: Place, capacity: int) -> bool:
        """Whether there is room, and this robot has waited until the others have answered."""
        rivals = [report.priority for report in self.reports if place in report.entering]
        is_full = self.is_full(place, capacity)
        in_state = sum(place in report.executed for report in self.reports)
        is_contested = in_state + len(rivals) >= capacity
        strongest = max(rivals, default=0)
        if is_contested and not is_full and rivals and strongest == self.priority:
            return False
        is_free = not is_full and not (is_contested and rivals and strongest > self.priority)
        if is_free and self.waited.get(place, 0) >= self.ticks:
            return True
        self.waiting.add(place)
        return False

    def may_enter_together(self, place: Place, number: int) -> bool:
        """Whether enough robots are near the state, and all of them are in it or wait for it."""
        self.waiting.add(place)
        near = sum(place in report.near for report in self.reports)
        ready = sum((place in report.executed) + (place in report.entering) for report in self.reports)
        return near + 1 >= number and ready == near and self.waited.get(place, 0) > self.ticks // 2
