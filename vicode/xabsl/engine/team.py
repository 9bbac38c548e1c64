"""Cooperative states: robots enter them together or up to a capacity, by exchanging messages in every cycle."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CoopMessage:
    """Message to the other robots: numbers of the cooperative states that the robot executes or wants to enter.

    `option_executed` are the cooperative states of all options that it executes.
    """

    priority: int = 0
    executed: tuple[int, ...] = ()
    entering: tuple[int, ...] = ()
    option_executed: tuple[int, ...] = ()


@dataclass(slots=True)
class TeamSettings:
    """Settings of a robot in a team; `ticks` is the number of cycles until the others have answered."""

    priority: int = 0
    ticks: int = 0


@dataclass(slots=True)
class CoopState:
    """A cooperative state. Counts exclude this robot; `number` is the capacity or the required number of robots."""

    option: str
    state: str
    number: int
    team: TeamSettings
    messages: list[str]
    executing: int = 0
    entering: int = 0
    in_option: int = 0
    highest_priority: int = 0
    is_entering: bool = False
    waited_cycles: int = 0
    conflict: bool = False

    def begin_cycle(self) -> None:
        """Discard the messages of the other robots and count the cycles this robot has waited to enter."""
        self.executing = self.entering = self.in_option = 0
        self.waited_cycles = self.waited_cycles + 1 if self.is_entering else 0
        self.is_entering = False

    def is_full(self) -> bool:
        """Whether the other robots use the whole capacity."""
        return self.executing >= self.number


class CapacityState(CoopState):
    """A state that at most `number` robots execute."""

    __slots__ = ()

    def may_enter(self) -> bool:
        """Whether this robot may enter now. If not, it announces that it wants to enter, unless priorities conflict."""
        is_contested = self.executing + self.entering >= self.number
        if not self.is_full() and is_contested and self.highest_priority == self.team.priority:
            self.messages.append(
                f"xabsl::CapacityState::coopCheck(): Conflict detected in capacity state {self.state!r}. Multiple "
                f"agents with the same priority value {self.team.priority} are trying to execute the state."
            )
            return False
        is_free = not self.is_full() and not (is_contested and self.highest_priority > self.team.priority)
        if is_free and self.waited_cycles >= self.team.ticks:
            return True
        self.is_entering = True
        return False


class SynchronizedState(CoopState):
    """A state that at least `number` robots enter at the same time, including this one."""

    __slots__ = ()
    self_count = 1

    def may_enter(self) -> bool:
        """Whether all robots that execute the option are ready; announces that this robot is."""
        self.is_entering = True
        are_enough = self.in_option + self.self_count >= self.number
        are_ready = self.executing + self.entering == self.in_option
        return are_enough and are_ready and self.waited_cycles > self.team.ticks // 2


class StrictSynchronizedState(SynchronizedState):
    """A synchronized state of a strict engine: `number` excludes this robot."""

    __slots__ = ()
    self_count = 0
