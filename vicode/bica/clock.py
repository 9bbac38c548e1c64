"""Clocks: the source of the time of an iteration, in integer nanoseconds."""

import time
from typing import Protocol


class Clock(Protocol):
    """A monotonic clock."""

    def now_ns(self) -> int:
        """Return the nanoseconds since the start of the clock."""
        ...


class RealClock:
    """Real time, which starts at 0 when the clock is created."""

    def __init__(self) -> None:
        self._start_ns = time.monotonic_ns()

    def now_ns(self) -> int:
        return time.monotonic_ns() - self._start_ns


class SimulatedClock:
    """A clock that only changes when `advance` is called."""

    def __init__(self, start_ns: int = 0) -> None:
        self._now_ns = start_ns

    def now_ns(self) -> int:
        return self._now_ns

    def advance(self, ns: int) -> None:
        """Advance the clock by `ns` nanoseconds.

        Raises:
            ValueError: `ns` is negative.
        """
        if ns < 0:
            raise ValueError(f"cannot move the clock back by {-ns} ns; pass 0 or more")
        self._now_ns += ns
