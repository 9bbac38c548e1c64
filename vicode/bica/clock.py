"""Clocks: the source of the time of an iteration, in integer nanoseconds."""

import math
import time
from collections.abc import Callable
from typing import Protocol, runtime_checkable

from .timing import CycleTimes

_LONGEST_SLEEP_S = 0.1


class Clock(Protocol):
    """The interface of a clock: any object with this method.

    While a viewer pauses the robot, time stands still: the root subtracts what passes during the pause. A clock whose
    `now_ns` changes only between iterations must be a `StoppableClock`.
    """

    def now_ns(self) -> int:
        """Return the nanoseconds since the start of the clock."""
        ...


@runtime_checkable
class StoppableClock(Clock, Protocol):
    """A clock that does not count pauses."""

    def stop_time(self) -> None:
        """Stop the time at a pause."""
        ...

    def continue_time(self) -> None:
        """Continue the time after a pause; the next iteration is due as if there had been no pause."""
        ...


class RealClock:
    """Real time, which starts at 0 when the clock is created."""

    def __init__(self) -> None:
        self._start_ns = time.monotonic_ns()

    def now_ns(self) -> int:
        """Return the nanoseconds since the clock was created."""
        return time.monotonic_ns() - self._start_ns


class SimulatedClock:
    """A clock that only changes when `advance` is called."""

    def __init__(self, start_ns: int = 0) -> None:
        self._now_ns = start_ns

    def now_ns(self) -> int:
        """Return the time that `advance` has set."""
        return self._now_ns

    def advance(self, ns: int) -> None:
        """Advance the clock by `ns` nanoseconds.

        Raises:
            ValueError: `ns` is negative.
        """
        if ns < 0:
            raise ValueError(f"cannot move the clock back by {-ns} ns; pass 0 or more")
        self._now_ns += ns


class PacedClock:
    """Real time in ticks: the time of an iteration is the time when it was due, a multiple of the tick.

    Iterations are due at fixed times, so waiting does not add up to a drift. Times that pass during an iteration are
    skipped.

    Attributes:
        overruns: The number of iterations that were not finished when the next one was due.
    """

    def __init__(self, clock: Clock | None = None, sleep: Callable[[float], object] = time.sleep) -> None:
        self.overruns = 0
        self._clock: Clock = clock if clock is not None else RealClock()
        self._sleep = sleep
        self._now_ns = self._stopped_ns = 0
        self.start()

    def start(self) -> None:
        """Start the ticks: the first iteration is due now."""
        self._start_ns = self._clock.now_ns()

    def now_ns(self) -> int:
        """Return the time when the current iteration was due, in nanoseconds since `start`."""
        return self._now_ns

    def stop_time(self) -> None:
        """Stop the time at a pause, which then counts neither as time nor as an overrun."""
        self._stopped_ns = self._clock.now_ns()

    def continue_time(self) -> None:
        """Continue the time; the next iterations are due later by the length of the pause."""
        self._start_ns += self._clock.now_ns() - self._stopped_ns

    def wait(self, tick_ns: int, *, end_ns: float = math.inf, is_cancelled: Callable[[], bool] = lambda: False) -> None:
        """Wait until the next iteration is due, `end_ns` is reached, or `is_cancelled` returns true."""
        elapsed_ns = self._clock.now_ns() - self._start_ns
        late_ns = elapsed_ns - self._now_ns - tick_ns
        self.overruns += late_ns > 0
        self._now_ns += tick_ns * (1 + max(0, -(-late_ns // tick_ns)))
        due_ns = self._start_ns + min(self._now_ns, end_ns)
        # Python resumes a sleep after a signal, so long ones are divided.
        while (remaining_ns := due_ns - self._clock.now_ns()) > 0 and not is_cancelled():
            self._sleep(min(remaining_ns / 1e9, _LONGEST_SLEEP_S))


class PacingWorld(Protocol):
    """A world that sets the pace of a program by the cycles of a server, an interrupt, or the callback of a sensor."""

    def now_ns(self) -> int:
        """Return the time of the newest cycle in nanoseconds."""
        ...

    def next_cycle(self) -> int:
        """Send the commands of the last iteration, wait for a cycle, and take its inputs.

        Returns:
            The number of cycles that have begun since the last call: 1 if none was missed, 0 if none has begun within
            about a second, so that a signal can end the program.
        """
        ...


class WorldClock:
    """The time of a world that sets the pace, from 0 at its first cycle.

    Attributes:
        cycles: The number of cycles since the first.
        missed: The number of cycles without an iteration, except those during pauses.
        latency: The times from the start of an iteration, when its inputs have arrived, until its commands are sent.
    """

    def __init__(self, world: PacingWorld) -> None:
        self.cycles = self.missed = 0
        self.latency = CycleTimes()
        self._world = world
        self._now_ns = self._start_ns = 0
        self._begun_ns: int | None = None
        self._was_stopped = False

    def now_ns(self) -> int:
        """Return the time of the current cycle."""
        return self._now_ns

    def as_plain(self) -> dict[str, float]:
        """Return cycles and latency as JSON data, with times in milliseconds."""
        return {
            "cycles": self.cycles,
            "missed_cycles": self.missed,
            "latency_mean_ms": self.latency.mean_ns / 1e6,
            "latency_max_ms": self.latency.max_ns / 1e6,
        }

    def stop_time(self) -> None:
        """Ignore the cycles that begin from now on: they are neither time nor missed."""
        self._was_stopped = True

    def continue_time(self) -> None:
        """Do nothing: the first cycle after the pause continues the time, one cycle after the last one."""

    def wait(self) -> bool:
        """Wait for the next cycle; return false if none has begun yet."""
        if self._begun_ns is not None and not self._was_stopped:
            self.latency.add(time.perf_counter_ns() - self._begun_ns, self._now_ns)
        self._begun_ns = None
        begun = self._world.next_cycle()
        if begun <= 0:
            return False
        self._begun_ns = time.perf_counter_ns()
        clock_ns = self._world.now_ns()
        if not self.cycles:
            self._start_ns, begun = clock_ns, 1
        elif self._was_stopped:
            self._start_ns += (clock_ns - self._start_ns - self._now_ns) * (begun - 1) // begun
            begun = 1
        self._was_stopped = False
        self.cycles += begun
        self.missed += begun - 1
        self._now_ns = clock_ns - self._start_ns
        return True
