"""One robot: its world, its behavior and its clock. No I/O: the server calls it with messages and ticks."""

from collections import deque
from collections.abc import Callable, Iterable
from types import SimpleNamespace
from typing import Any

from vicode.bica.errors import USER_ERRORS, describe_exception
from vicode.bica.loader import describe_user_error
from vicode.bridge.ages import AgeFigures
from vicode.bridge.behaviors import Behavior, BehaviorCatalog, BehaviorError, BehaviorSetup, TickClock
from vicode.bridge.world import World

_MAX_REPORTED = 1000
_PATIENCE_NS = 1_000_000_000
_LONG_NS = 1 << 62


TeamKey = tuple[str, str]
"""The name of a team, and the behavior of its robots."""


class Broadcast:
    """What a robot told its team at the end of a tick: the message of its behavior, and published values."""

    __slots__ = ("message", "published", "time_ns")

    def __init__(self, time_ns: int, message: Any, published: SimpleNamespace | None) -> None:
        self.time_ns, self.message, self.published = time_ns, message, published


class TeamRound:
    """What the robots of a team hear in their ticks at one time: what was told before, so that order has no effect.

    Attributes:
        messages: The messages of behaviors, with the names of the robots.
        published: The published values of worlds.
    """

    __slots__ = ("messages", "published")

    def __init__(self, robots: "Iterable[Robot]" = (), at_ns: int = 0) -> None:
        self.messages: list[tuple[str, Any]] = []
        self.published: list[SimpleNamespace] = []
        for robot in robots:
            broadcast = robot.told_before(at_ns)
            if broadcast is not None and broadcast.message is not None:
                self.messages.append((robot.name, broadcast.message))
            if broadcast is not None and broadcast.published is not None:
                self.published.append(broadcast.published)


class Robot:
    """A robot and its state, which outlives a connection.

    Args:
        name: Unique in the server.
        make_world: Creates the world.
        catalog: The behaviors that it can run.
        team: Robots with the same team and behavior hear each other.
        priority: Of its messages to the team; unique there.
        waits: Whether a behavior starts only when values have arrived.
    """

    def __init__(
        self,
        name: str,
        make_world: Callable[[], World],
        catalog: BehaviorCatalog,
        *,
        team: str = "",
        priority: int = 0,
        waits: bool = True,
    ) -> None:
        self.name, self.team, self.priority, self.waits = name, team, priority, waits
        self.world = make_world()
        self.data = self.world.bridge
        self.data.robot = name
        self.clock = TickClock()
        self.behavior: Behavior | None = None
        self.behavior_name = ""
        self.ages = AgeFigures()
        """The age of the oldest value read, for all ticks that read any."""
        self.command_ages = AgeFigures()
        """The age of commands when the robot has acknowledged them."""
        self.reports: list[str] = []
        """Lines about exceptions and malformed values since the last `take_reports`."""
        self._reported: set[str] = set()
        self.catalog = catalog
        advance = getattr(self.world, "advance", None)
        self._advance: Callable[[int], object] | None = advance if callable(advance) else None
        self.ticked_ns = 0
        """The time of the last tick, on the clock of the messages."""
        self._start_ns: int | None = None
        self._waits_since_ns: int | None = None
        self._broadcasts: deque[Broadcast] = deque(maxlen=2)

    def select(self, name: str) -> None:
        """Start a behavior in place of that before; the sensors keep their values.

        Raises:
            BehaviorError: There is no such behavior, or its code fails.
        """
        setup = BehaviorSetup(world=self.world, clock=self.clock, priority=self.priority, report=self._report)
        before, self.clock.ns = self.clock.ns, 0
        try:
            behavior = self.catalog.create(name, setup)
        except BehaviorError:
            self.clock.ns = before
            raise
        if self.behavior is not None:
            self.behavior.close()
        self.behavior, self.behavior_name, self._start_ns = behavior, name, None
        self.data.commands.repeat()

    def tick(self, at_ns: int, now_ns: int, team: TeamRound) -> None:
        """Run the behavior once.

        Args:
            at_ns: When the tick is due, on a clock that all robots of a team share.
            now_ns: The time on the clock of the messages, from which ages are counted.
            team: What the team told before.
        """
        behavior, data = self.behavior, self.data
        if behavior is None:
            return
        if self._start_ns is None:
            self._start_ns = at_ns
        self.ticked_ns = now_ns
        self.clock.ns = max(self.clock.ns, at_ns - self._start_ns)
        data.begin_tick(self.clock.ns, now_ns)
        data.published = team.published
        behavior.hear([message for name, message in team.messages if name != self.name])
        if self._advance is not None:
            self._advance_world(self._advance)
        behavior.step()
        data.end_tick()
        if (age_ns := data.readings.age_ns) is not None:
            self.ages.add(age_ns)
        self._tell(at_ns, behavior)
        for problem in data.take_problems():
            self.reports.append(problem)

    def told_before(self, at_ns: int) -> Broadcast | None:
        """What this robot told last before a time."""
        if not self._broadcasts:
            return None
        newest = self._broadcasts[-1]
        if newest.time_ns < at_ns:
            return newest
        return self._broadcasts[0] if len(self._broadcasts) > 1 else None

    @property
    def awaited(self) -> list[str]:
        """What must arrive before the behavior starts: targets, or "any"; empty once it has started."""
        return self.data.awaited if self.waits and self._start_ns is None else []

    def wait(self, at_ns: int) -> bool:
        """Whether the behavior does not start yet; a wait for required sensors is reported after a while."""
        awaited = self.awaited
        if not awaited:
            return False
        if self._waits_since_ns is None:
            self._waits_since_ns = at_ns
        elif at_ns - self._waits_since_ns >= _PATIENCE_NS and awaited != ["any"]:
            self.data.notices.add(f"{self.behavior_name} waits for the first value of {', '.join(awaited)}")
            self._waits_since_ns = at_ns + _LONG_NS
        return True

    @property
    def team_key(self) -> TeamKey:
        """Robots with the same key are a team."""
        return self.team, self.behavior_name

    @property
    def speaks(self) -> bool:
        """Whether the team hears anything of this robot."""
        return bool(self._broadcasts)

    def leave_team(self) -> None:
        """Withdraw what the team heard: the robot is not controlled any more."""
        self._broadcasts.clear()

    def take_reports(self) -> list[str]:
        reports, self.reports = self.reports, []
        return reports

    def close(self) -> None:
        """Close the behavior and the world."""
        if self.behavior is not None:
            self.behavior.close()
            self.behavior = None
        close_world = getattr(self.world, "close", None)
        if callable(close_world):
            try:
                close_world()
            except USER_ERRORS as error:
                self._report(f"close of the world: {describe_exception(error)}")

    def _tell(self, at_ns: int, behavior: Behavior) -> None:
        message = behavior.tell()
        names = self.world.published
        if message is None and not names:
            self._broadcasts.clear()
            return
        self._broadcasts.append(Broadcast(at_ns, message, self._publish(names) if names else None))

    def _advance_world(self, advance: Callable[[int], object]) -> None:
        try:
            advance(self.clock.ns)
        except USER_ERRORS as error:
            self._report(describe_user_error(error))

    def _publish(self, names: Iterable[str]) -> SimpleNamespace:
        published = SimpleNamespace(robot=self.name)
        for name in names:
            try:
                setattr(published, name, getattr(self.world, name))
            except USER_ERRORS as error:
                self._report(f"published {name}: {describe_exception(error)}")
        return published

    def _report(self, line: str) -> None:
        """Count an exception; report each one once."""
        self.data.counts.errors += 1
        if line not in self._reported and len(self._reported) < _MAX_REPORTED:
            self._reported.add(line)
            self.reports.append(line)
