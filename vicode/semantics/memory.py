"""What changes while the designs of a robot run, apart from its inputs."""

from dataclasses import dataclass, field, replace

from vicode.semantics.team import TeamMemory
from vicode.semantics.values import Value

Arguments = dict[str, Value]


@dataclass(slots=True)
class ComponentMemory:
    """The memory of a component.

    Attributes:
        values: Constants, and its parameters, outputs and variables.
        state: The active state; "" without states.
        stepped_in: The iteration of its last step; None before the first one.
        restarted_in: The iteration of its last restart.
        started_ns: The time of the last restart.
        entered_ns: The time when the active state was entered.
        worked_ns: The time of the last work.
        calls: The components that the last work called, with their parameters, in order.
    """

    values: dict[str, Value]
    state: str
    stepped_in: int | None = None
    restarted_in: int | None = None
    started_ns: int = 0
    entered_ns: int = 0
    worked_ns: int = 0
    calls: list[tuple[str, Arguments]] = field(default_factory=list)

    def copy(self) -> "ComponentMemory":
        """Return an independent copy; the parameters of a call do not change."""
        return replace(self, values=dict(self.values), calls=list(self.calls))


@dataclass(slots=True)
class RobotMemory:
    """The memory of a robot.

    Attributes:
        iteration: The number of the iteration, from 1.
        now_ns: The time of the iteration.
        lag_ns: How much time is behind the clock, because the clock was set back.
        arguments: The arguments of outputs that designs with the rules of XABSL share between calls.
        had_large_ints: Whether an operation on ints had a result beyond ±2^53.
    """

    components: dict[str, ComponentMemory]
    team: TeamMemory
    iteration: int = 0
    now_ns: int = 0
    lag_ns: int = 0
    arguments: dict[tuple[str, str], Arguments] = field(default_factory=dict)
    had_large_ints: bool = False

    def begin_iteration(self, clock_ns: int) -> None:
        """Read the clock; time does not decrease, and continues from the last one if the clock was set back."""
        self.iteration += 1
        self.lag_ns += max(0, self.now_ns - self.lag_ns - clock_ns)
        self.now_ns = clock_ns + self.lag_ns

    def copy(self) -> "RobotMemory":
        """Return an independent copy."""
        return replace(
            self,
            components={name: each.copy() for name, each in self.components.items()},
            team=replace(self.team, waiting=set(self.team.waiting), waited=dict(self.team.waited)),
            arguments={key: dict(each) for key, each in self.arguments.items()},
        )
