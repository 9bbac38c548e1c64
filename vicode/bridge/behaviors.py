"""The behaviors that a server runs: generated designs on the runtime, and agents of an XABSL program on the engine."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from vicode.bica import ComponentError, CyclicUseError, ErrorRecord, Root, TeamMessage
from vicode.bica.errors import USER_ERRORS
from vicode.bica.loader import UserCodeError, describe_user_error, load_component
from vicode.bridge.world import World
from vicode.xabsl.engine import CoopMessage, Engine, LoadError, Program, SymbolList

TEAM_TICKS = 1
"""Ticks until the team has answered: each robot hears in a tick what all others told in the tick before."""

ActiveState = tuple[str, str]
"""An active option or component, and its state."""


class BehaviorError(Exception):
    """A behavior does not exist or cannot be created; the text is one line."""


class TickClock:
    """The clock of one robot: constant in a tick."""

    __slots__ = ("ns",)

    def __init__(self) -> None:
        self.ns = 0

    def now_ns(self) -> int:
        return self.ns

    def now_ms(self) -> int:
        return self.ns // 1_000_000


class Behavior(Protocol):
    """A running behavior of one robot."""

    def step(self) -> None:
        """Run one tick; an exception of user code is reported and ends at most this tick."""

    def active_states(self) -> list[ActiveState]: ...

    def tell(self) -> Any:
        """The message to the team after a tick; None if there is nothing to say."""

    def hear(self, messages: Iterable[Any]) -> None:
        """Take what the teammates sent, before a tick."""

    def close(self) -> None:
        """Close the components; the world is that of the robot."""


class BehaviorCatalog(Protocol):
    """All behaviors that robots can choose; `default` is "" if a robot must choose."""

    @property
    def default(self) -> str: ...

    @property
    def names(self) -> tuple[str, ...]: ...

    def create(self, name: str, setup: "BehaviorSetup") -> Behavior:
        """Create a behavior.

        Raises:
            BehaviorError: There is no such behavior, or its code fails.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class BehaviorSetup:
    """What a behavior runs with; `report` gets a line for each exception of user code."""

    world: World
    clock: TickClock
    priority: int
    report: Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignCatalog:
    """Generated components, as "module:Class" by the name of an agent or a design."""

    classes: Mapping[str, str]
    default: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.classes)

    def create(self, name: str, setup: BehaviorSetup) -> "DesignBehavior":
        try:
            component_class = load_component(self.classes[name])
            return DesignBehavior(component_class, setup)
        except KeyError:
            raise BehaviorError(_describe_unknown(name, self.names)) from None
        except (UserCodeError, CyclicUseError) as error:
            raise BehaviorError(" ".join(str(error).split())) from error
        except USER_ERRORS as error:
            raise BehaviorError(f"cannot create {name}: {describe_user_error(error)}") from error


class DesignBehavior:
    """A component and all that it uses, in its own root."""

    def __init__(self, component_class: Any, setup: BehaviorSetup) -> None:
        self._report_line = setup.report
        self.root = Root(component_class, clock=setup.clock, world=setup.world, on_error=self._report)
        self.root.team.priority, self.root.team.ticks = setup.priority, TEAM_TICKS

    def step(self) -> None:
        try:
            self.root.step()
        except ComponentError as error:
            self._report_line(describe_user_error(error))

    def active_states(self) -> list[ActiveState]:
        return list(self.root.active_states)

    def tell(self) -> TeamMessage | None:
        message = self.root.team.tell()
        return message if message.near else None

    def hear(self, messages: Iterable[TeamMessage]) -> None:
        team = self.root.team
        team.prepare()
        for message in messages:
            team.hear(message)

    def close(self) -> None:
        # The world belongs to the robot, which may continue with another behavior.
        self.root.world = None
        self.root.close()

    def _report(self, record: ErrorRecord) -> None:
        self._report_line(str(record))


@dataclass(frozen=True, slots=True, kw_only=True)
class XabslCatalog:
    """The agents and options of an XABSL program."""

    program: Program
    symbols: SymbolList
    default: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        agents = tuple(name for name, _root in self.program.agents)
        return (*agents, *(each.name for each in self.program.options if each.name not in agents))

    def create(self, name: str, setup: BehaviorSetup) -> "XabslBehavior":
        if name not in self.names:
            raise BehaviorError(_describe_unknown(name, self.names))
        try:
            return XabslBehavior(self, name, setup)
        except LoadError as error:
            raise BehaviorError(str(error)) from error
        except USER_ERRORS as error:
            raise BehaviorError(f"cannot create {name}: {describe_user_error(error)}") from error


class XabslBehavior:
    """An agent or option in its own engine."""

    def __init__(self, catalog: XabslCatalog, name: str, setup: BehaviorSetup) -> None:
        self._report_line, self._clock = setup.report, setup.clock
        self.on_step: Callable[[int], None] = lambda _time_ns: None
        self.on_close: Callable[[], None] = lambda: None
        self.engine = Engine(catalog.program, setup.world, symbols=catalog.symbols, clock=setup.clock.now_ms)
        self.engine.team.priority, self.engine.team.ticks = setup.priority, TEAM_TICKS
        if not self.engine.select(name):
            self.engine.set_root(name)

    def step(self) -> None:
        try:
            self.engine.execute()
        except USER_ERRORS as error:
            # The options that were not finished restart in the next tick, as after a cycle without them.
            self._report_line(describe_user_error(error))
        self.on_step(self._clock.ns)

    def active_states(self) -> list[ActiveState]:
        return [(view.name, view.state) for view in self.engine.active_options]

    def tell(self) -> CoopMessage | None:
        message = self.engine.generate_outgoing_message()
        return message if message.option_executed else None

    def hear(self, messages: Iterable[CoopMessage]) -> None:
        self.engine.prepare_incoming_messages()
        for message in messages:
            self.engine.process_incoming_message(message)

    def close(self) -> None:
        self.on_close()


def _describe_unknown(name: str, names: Iterable[str]) -> str:
    return f"there is no behavior {name[:60]!r}; choose from: {', '.join(names)}"
