"""States that robots enter together, or only so many at once, by what they tell each other in every cycle."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CoopMessage:
    """What a robot tells the others: numbers of cooperative states that it executes, enters, and is near of."""

    priority: int = 0
    executed: tuple[int, ...] = ()
    entering: tuple[int, ...] = ()
    option_executed: tuple[int, ...] = ()


@dataclass(slots=True)
class TeamSettings:
    """What a robot is among the others: ticks are the cycles until an answer of the others has come."""

    priority: int = 0
    ticks: int = 0


@dataclass(slots=True)
class CoopState:
    """A cooperative state; counts are of other robots. `number` is its capacity, or how many must enter at once."""

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
        """Forget what the others told; count the cycles since this robot wants to enter."""
        self.executing = self.entering = self.in_option = 0
        self.waited_cycles = self.waited_cycles + 1 if self.is_entering else 0
        self.is_entering = False

    def is_full(self) -> bool:
        """Whether as many others are in it as may be."""
        return self.executing >= self.number


class CapacityState(CoopState):
    """A state for at most `number` robots."""

    __slots__ = ()

    def may_enter(self) -> bool:
        """Whether this robot may enter now; else the others are told that it wants to, unless it gives way."""
        wanted = self.executing + self.entering >= self.number
        if not self.is_full() and wanted and self.highest_priority == self.team.priority:
            self.messages.append(
                f"xabsl::CapacityState::coopCheck(): Conflict detected in capacity state {self.state!r}. Multiple "
                f"agents with the same priority value {self.team.priority} are trying to execute the state."
            )
            return False
        is_free = not self.is_full() and not (wanted and self.highest_priority > self.team.priority)
        if is_free and self.waited_cycles >= self.team.ticks:
            return True
        self.is_entering = True
        return False


class SynchronizedState(CoopState):
    """A state that at least `number` robots enter at once; `strict` engines do not count this one."""

    __slots__ = ()
    self_count = 1

    def may_enter(self) -> bool:
        """Whether all who are near are ready; the others are told that this robot is."""
        self.is_entering = True
        are_enough = self.in_option + self.self_count >= self.number
        are_ready = self.executing + self.entering == self.in_option
        return are_enough and are_ready and self.waited_cycles > self.team.ticks // 2


class StrictSynchronizedState(SynchronizedState):
    """The same where only others count."""

    __slots__ = ()
    self_count = 0
