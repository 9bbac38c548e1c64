"""Tests of a world, and of behaviors in it, without a socket and without waiting: time passes with each tick."""

from collections.abc import Callable, Iterator
from typing import Any

from vicode.bica import Component
from vicode.bridge.behaviors import BehaviorSetup, DesignBehavior
from vicode.bridge.frames import FrameError
from vicode.bridge.robot import Robot, TeamRound
from vicode.bridge.world import World

_NS_PER_S = 1_000_000_000


class RobotTester:
    """A robot of a bridge with its world, driven by a test.

    Args:
        world_class: The class of the world.
        behavior: A generated component, or a function of the world that is called in each tick; None for none.
        tick_s: Time between ticks.

    Attributes:
        world: The world.
        robot: The robot, as in the server.
        notices: What the bridge would have told both sides.
        errors: Exceptions, and values that could not be read.
    """

    def __init__(
        self,
        world_class: type[World],
        behavior: type[Component] | Callable[[Any], object] | None = None,
        *,
        tick_s: float = 0.05,
    ) -> None:
        self.robot = Robot("robot", world_class, _SingleCatalog(behavior or (lambda _world: None)))
        self.world = self.robot.world
        self.notices: list[str] = []
        self.errors: list[str] = []
        self._tick_ns = round(tick_s * _NS_PER_S)
        self._now_ns = 0
        self.robot.select("behavior")

    @property
    def state(self) -> str:
        """The active state of the component; "" for a function."""
        states = self.robot.behavior.active_states() if self.robot.behavior is not None else []
        return states[0][1] if states else ""

    def send(self, **values: Any) -> None:
        """Send a value for each target, as the robot does: `send(LASER=[1, 2], BATTERY=0.5)`.

        Raises:
            FrameError: The world has no such target.
        """
        for target, value in values.items():
            parameters = list(value) if isinstance(value, list | tuple) else [value]
            if not self.robot.data.receive(target, parameters, self._now_ns):
                raise FrameError(f"no sensor or event {target}; the world has {', '.join(self.robot.data.targets)}")

    def tick(self) -> dict[str, tuple[Any, ...]]:
        """Advance the time by one tick and run it; return the commands that the robot would get."""
        self._now_ns += self._tick_ns
        if not self.robot.wait(self._now_ns):
            self.robot.tick(self._now_ns, self._now_ns, TeamRound())
        self.errors += self.robot.take_reports()
        self.notices += self.robot.data.take_notices()
        return self.robot.data.commands.take()

    def run(self, seconds: float, **values: Any) -> list[dict[str, tuple[Any, ...]]]:
        """Run ticks for some time, with these values before each; return the commands of each tick that sends any."""
        return [commands for commands in self._run(seconds, values) if commands]

    def _run(self, seconds: float, values: dict[str, Any]) -> Iterator[dict[str, tuple[Any, ...]]]:
        for _tick in range(round(seconds * _NS_PER_S / self._tick_ns)):
            self.send(**values)
            yield self.tick()


class _FunctionBehavior:
    """A function that is called in each tick."""

    def __init__(self, function: Callable[[Any], object], setup: BehaviorSetup) -> None:
        self._function, self._world = function, setup.world

    def step(self) -> None:
        self._function(self._world)

    def active_states(self) -> list[tuple[str, str]]:
        return []

    def tell(self) -> None:
        return None

    def hear(self, messages: Any) -> None:
        pass

    def close(self) -> None:
        pass


class _SingleCatalog:
    """A catalog of one behavior."""

    default = "behavior"
    names = ("behavior",)

    def __init__(self, behavior: type[Component] | Callable[[Any], object]) -> None:
        self._behavior = behavior

    def create(self, _name: str, setup: BehaviorSetup) -> DesignBehavior | _FunctionBehavior:
        if isinstance(self._behavior, type) and issubclass(self._behavior, Component):
            return DesignBehavior(self._behavior, setup)
        return _FunctionBehavior(self._behavior, setup)
