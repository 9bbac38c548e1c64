"""Clocks: the source of the time of an iteration, in integer nanoseconds."""

import math
import time
from collections.abc import Callable
from typing import Protocol

_LONGEST_SLEEP_S = 0.1


class Clock(Protocol):
    """The interface of a clock: any object with this method."""

    def now_ns(self) -> int:
        """Return the nanoseconds since the start of the clock."""
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
        self._now_ns = 0
        self.start()

    def start(self) -> None:
        """Start the ticks: the first iteration is due now."""
        self._start_ns = self._clock.now_ns()

    def now_ns(self) -> int:
        """Return the time when the current iteration was due, in nanoseconds since `start`."""
        return self._now_ns

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
