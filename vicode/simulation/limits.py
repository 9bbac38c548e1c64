"""What keeps user code within bounds: time, memory, and the length of what it prints."""

from __future__ import annotations

import io
import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

MAX_LINES = 200
MAX_LINE_LENGTH = 2_000


class TimeLimitError(BaseException):
    """A step takes too long. Not an Exception, so that code that catches those does not catch it."""


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Interrupt what runs inside when it takes longer; what is deaf to that is killed from outside.

    Raises:
        TimeLimitError: It took longer.
    """
    signal.signal(signal.SIGALRM, _interrupt)
    # It comes again, should the first one be swallowed.
    signal.setitimer(signal.ITIMER_REAL, seconds, 0.1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def limit_memory(bytes_: int) -> None:
    """Make allocations beyond this fail with MemoryError, and leave no core files behind."""
    _soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    most = bytes_ if hard == resource.RLIM_INFINITY else min(bytes_, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (most, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _interrupt(_number: int, _frame: FrameType | None) -> NoReturn:
    raise TimeLimitError


class CapturedOutput(io.TextIOBase):
    """Stands for standard output: keeps the first lines since it was last emptied, and counts the rest."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: list[str] = []
        self._begun = ""
        self._left_out = 0

    def writable(self) -> bool:
        """It is."""
        return True

    def write(self, text: str) -> int:
        """Take text, whole lines or parts of them."""
        if len(self._lines) >= MAX_LINES:
            self._left_out += text.count("\n")
            return len(text)
        *lines, rest = (self._begun + text).split("\n")
        room = MAX_LINES - len(self._lines)
        self._lines += [line[:MAX_LINE_LENGTH] for line in lines[:room]]
        self._left_out += len(lines[room:])
        self._begun = rest[:MAX_LINE_LENGTH]
        return len(text)

    def drain(self) -> tuple[list[str], int]:
        """The lines since the last time, and how many more there were."""
        lines = [*self._lines, self._begun] if self._begun else self._lines
        left_out = self._left_out
        self._lines, self._begun, self._left_out = [], "", 0
        return lines, left_out
