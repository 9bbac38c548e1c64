"""World: what one robot senses and does, declared by the user; and the bridge's side of it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from types import SimpleNamespace
from typing import Any, ClassVar, Self, TypeVar

from vicode.bridge.commands import CommandQueue
from vicode.bridge.declarations import Command, Event, Sensor
from vicode.bridge.flow_control import FlowControl
from vicode.bridge.notices import Notices
from vicode.bridge.parameters import Raw
from vicode.bridge.readings import EventQueue, Readings

D = TypeVar("D", Sensor, Event, Command)


class World:
    """The world of one robot; derive from it, and declare sensors, events and commands as class attributes.

    Everything else that a behavior reads or calls is a property or a method of the subclass, computed when it is read.

    Attributes:
        published: Names of attributes that teammates may read.
        max_age: In seconds: commands go to rest if nothing has arrived for longer; None: never for this reason.
        bridge: The data of the bridge.
    """

    published: ClassVar[tuple[str, ...]] = ()
    max_age: ClassVar[float | None] = 1.0
    bridge: "WorldData"

    def __new__(cls, *_arguments: object, **_named: object) -> Self:
        world = super().__new__(cls)
        world.bridge = WorldData(cls)
        return world

    @property
    def time(self) -> float:
        """Seconds since the behavior started, constant in a tick."""
        return self.bridge.time_ns / 1e9

    @property
    def robot(self) -> str:
        """The name of the robot."""
        return self.bridge.robot

    @property
    def input_age(self) -> float:
        """Seconds since the newest value or event was sent; infinite before the first."""
        return self.bridge.input_age_s

    @property
    def at_rest(self) -> bool:
        """Whether the watchdog holds the commands at rest in this tick."""
        return bool(self.bridge.rest_reasons)

    @property
    def command_age(self) -> float:
        """Age in seconds of the commands that the robot obeys; infinite if it has acknowledged none."""
        age_ns = self.bridge.command_age_ns
        return math.inf if age_ns is None else age_ns / 1e9

    @property
    def team(self) -> tuple[SimpleNamespace, ...]:
        """The teammates: `robot`, and the values that they published at the end of their last tick."""
        return tuple(each for each in self.bridge.published if each.robot != self.robot)


@dataclass(slots=True)
class Counts:
    """Counts of one robot.

    Attributes:
        lines: Messages received.
        dropped: Values that a newer one replaced before anyone read them.
        late: Values that were stale when they were first read.
        malformed: Lines and values that could not be read.
        unknown: Values and events without a declaration.
        events_dropped: Events, and values of sensors that keep all, for which there was no room.
        sent: Commands sent.
        commands_dropped: Commands that a newer one replaced because the robot reads slowly.
        ticks: Ticks of the behavior.
        rests: Times that the watchdog let the commands go to rest.
        errors: Exceptions in the behavior or the world.
        connections: Times that the robot connected.
    """

    lines: int = 0
    dropped: int = 0
    late: int = 0
    malformed: int = 0
    unknown: int = 0
    events_dropped: int = 0
    sent: int = 0
    commands_dropped: int = 0
    ticks: int = 0
    rests: int = 0
    errors: int = 0
    connections: int = 0

    def __add__(self, other: "Counts") -> "Counts":
        return Counts(*(getattr(self, each.name) + getattr(other, each.name) for each in fields(Counts)))


@dataclass(slots=True, init=False)
class WorldData:
    """The data behind a world: newest readings, queued events, commands, and what the team published."""

    robot: str
    time_ns: int
    published: Sequence[SimpleNamespace]
    counts: Counts
    readings: Readings
    events: EventQueue
    commands: CommandQueue
    targets: tuple[str, ...]
    cache: dict[object, Any]
    """Values of this tick."""
    flow: FlowControl | None
    """The commands on their way; None in lock step and without a connection."""
    notices: Notices
    rest_reasons: list[str]
    """Why the commands are at rest in this tick; empty if they are not."""
    _input_ns: int | None
    _now_ns: int
    _max_age_ns: float

    def __init__(self, world_class: type[World]) -> None:
        self.robot, self.time_ns, self.published, self.cache = "", 0, (), {}
        self.flow, self.notices, self.rest_reasons = None, Notices(), []
        self._input_ns, self._now_ns = None, 0
        self._max_age_ns = math.inf if world_class.max_age is None else world_class.max_age * 1e9
        self.counts = Counts()
        sensors, events = list_declarations(world_class, Sensor), list_declarations(world_class, Event)
        self.readings = Readings(sensors, self.counts, self.notices)
        self.events = EventQueue(events, self.counts, self.notices)
        self.commands = CommandQueue(list_declarations(world_class, Command), self.counts)
        self.targets = (*(each.target for each in sensors), *(each.target for each in events))

    def receive(self, target: str, raw: Raw, at_ns: int) -> bool:
        """Store the parameters of a line that was sent at this time; return whether the target is declared."""
        counts = self.counts
        if self.readings.put(target, raw, at_ns) or self.events.put(target, raw):
            counts.lines += 1
            self._input_ns = at_ns if self._input_ns is None else max(self._input_ns, at_ns)
            return True
        counts.unknown += 1
        return False

    @property
    def awaited(self) -> list[str]:
        """What must arrive before the behavior starts: required sensors, or else any value."""
        if self._input_ns is None and self.targets:
            return self.readings.awaited or ["any"]
        return self.readings.awaited

    @property
    def input_age_s(self) -> float:
        return math.inf if self._input_ns is None else max(0, self._now_ns - self._input_ns) / 1e9

    @property
    def command_age_ns(self) -> int | None:
        return None if self.flow is None else self.flow.age_ns(self._now_ns)

    def begin_tick(self, time_ns: int, now_ns: int) -> None:
        """Prepare a tick of the behavior at `time_ns`; ages count from `now_ns`, the clock of `receive`."""
        self.time_ns = time_ns
        self.counts.ticks += 1
        self.cache.clear()
        self._now_ns = now_ns
        self.readings.begin_tick(now_ns)
        self.events.begin_tick()
        self._watch(was_at_rest=bool(self.rest_reasons))

    def end_tick(self) -> None:
        """Select the commands to send."""
        self.commands.end_tick(self.time_ns, is_at_rest=bool(self.rest_reasons))

    def take_problems(self) -> list[str]:
        """What was wrong with values that were read since the last call."""
        problems = self.readings.problems + self.events.problems
        if problems:
            self.readings.problems, self.events.problems = [], []
        return problems

    def take_notices(self) -> list[str]:
        """What both sides should know, if it is due."""
        return self.notices.take(self._now_ns)

    def connect_again(self) -> None:
        """Forget what the robot obeyed before it was gone; that its values are old by now needs no notice."""
        self.commands.repeat()
        self.rest_reasons = ["the robot has connected again"]

    def _watch(self, *, was_at_rest: bool) -> None:
        """The watchdog: find out whether what has arrived is too old to act on."""
        reasons = [f"{each.target} is older than {each.max_age_ns / 1e9:g} s" for each in self.readings.stale]
        if self._input_ns is not None and self._now_ns - self._input_ns > self._max_age_ns:
            reasons = [f"nothing has arrived for {self._max_age_ns / 1e9:g} s"]
        self.rest_reasons = reasons
        if reasons and not was_at_rest:
            self.counts.rests += 1
            self.notices.add(f"commands are at rest: {', '.join(reasons)}")


def list_declarations(world_class: type[World], kind: type[D]) -> list[D]:
    """The declarations of a kind, those of base classes first; a subclass may replace or remove them."""
    names = dict.fromkeys(name for base in reversed(world_class.__mro__) for name in vars(base))
    found = (getattr(world_class, name, None) for name in names)
    return [each for each in found if isinstance(each, kind)]
