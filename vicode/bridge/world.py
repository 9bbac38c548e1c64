"""World: what one robot senses and does, declared by the user; and the bridge's side of it."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from types import SimpleNamespace
from typing import Any, ClassVar, Self, TypeVar

from vicode.bridge.commands import CommandQueue
from vicode.bridge.declarations import Command, Event, Sensor
from vicode.bridge.parameters import Raw
from vicode.bridge.readings import EventQueue, Readings

D = TypeVar("D", Sensor, Event, Command)


class World:
    """The world of one robot; derive from it, and declare sensors, events and commands as class attributes.

    Everything else that a behavior reads or calls is a property or a method of the subclass, computed when it is read.

    Attributes:
        published: Names of attributes that team mates may read.
        bridge: The data of the bridge.
    """

    published: ClassVar[tuple[str, ...]] = ()
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
    def team(self) -> tuple[SimpleNamespace, ...]:
        """The team mates: `robot`, and what they published, as it was at the end of their last tick."""
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
        events_dropped: Events for which there was no room.
        sent: Commands sent.
        commands_dropped: Commands that a newer one replaced because the robot reads slowly.
        ticks: Ticks of the behavior.
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

    def __init__(self, world_class: type[World]) -> None:
        self.robot, self.time_ns, self.published, self.cache = "", 0, (), {}
        self.counts = Counts()
        sensors, events = list_declarations(world_class, Sensor), list_declarations(world_class, Event)
        self.readings = Readings(sensors, self.counts)
        self.events = EventQueue(events, self.counts)
        self.commands = CommandQueue(list_declarations(world_class, Command), self.counts)
        self.targets = (*(each.target for each in sensors), *(each.target for each in events))

    def receive(self, target: str, raw: Raw, at_ns: int) -> bool:
        """Store the parameters of a line that was sent at this time; return whether the target is declared."""
        counts = self.counts
        if self.readings.put(target, raw, at_ns) or self.events.put(target, raw):
            counts.lines += 1
            return True
        counts.unknown += 1
        return False

    def begin_tick(self, time_ns: int, now_ns: int) -> None:
        """Prepare a tick of the behavior at `time_ns`; ages count from `now_ns`, the clock of `receive`."""
        self.time_ns = time_ns
        self.counts.ticks += 1
        self.cache.clear()
        self.readings.begin_tick(now_ns)
        self.events.begin_tick()

    def take_problems(self) -> list[str]:
        """What was wrong with values that were read since the last call."""
        problems = self.readings.problems + self.events.problems
        if problems:
            self.readings.problems, self.events.problems = [], []
        return problems


def list_declarations(world_class: type[World], kind: type[D]) -> list[D]:
    """The declarations of a kind, those of base classes first; a subclass may replace or remove them."""
    names = dict.fromkeys(name for base in reversed(world_class.__mro__) for name in vars(base))
    found = (getattr(world_class, name, None) for name in names)
    return [each for each in found if isinstance(each, kind)]
