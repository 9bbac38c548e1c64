"""Clocks: where a root reads the time of an iteration, in integer nanoseconds."""

import time
from typing import Protocol


class Clock(Protocol):
    """Anything that tells the nanoseconds since its own start and never goes back."""

    def now_ns(self) -> int:
        """Return the nanoseconds since the clock was started."""
        ...


class RealClock:
    """The time that really passes, from 0 when the clock is made."""

    def __init__(self) -> None:
        self._start_ns = time.monotonic_ns()

    def now_ns(self) -> int:
        """Return the nanoseconds since the clock was made."""
        return time.monotonic_ns() - self._start_ns


class SimulatedClock:
    """A clock that passes only when it is told to."""

    def __init__(self, start_ns: int = 0) -> None:
        self._now_ns = start_ns

    def now_ns(self) -> int:
        """Return the simulated nanoseconds."""
        return self._now_ns

    def advance(self, ns: int) -> None:
        """Let `ns` nanoseconds pass.

        Raises:
            ValueError: `ns` is negative.
        """
        if ns < 0:
            raise ValueError(f"a clock cannot go back: {ns} ns")
        self._now_ns += ns
