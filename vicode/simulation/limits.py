"""Limits on user code: time, memory, and the amount of output."""

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
    """A step takes too long. Not an `Exception`, so that user code that catches all exceptions does not catch it."""


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Interrupt the body when it takes longer. Code that ignores the interrupt is killed by the editor.

    Raises:
        TimeLimitError: The body took longer.
    """
    signal.signal(signal.SIGALRM, _interrupt)
    # Repeats, in case user code swallows the first interrupt.
    signal.setitimer(signal.ITIMER_REAL, seconds, 0.1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def limit_memory(bytes_: int) -> None:
    """Make allocations above this limit fail with `MemoryError`, and disable core dumps."""
    _soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    most = bytes_ if hard == resource.RLIM_INFINITY else min(bytes_, hard)
    # The hard limit, too: the code must not raise it.
    resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _interrupt(_number: int, _frame: FrameType | None) -> NoReturn:
    raise TimeLimitError


class CapturedOutput(io.TextIOBase):
    """Replaces standard output: keeps the first lines since the last `drain` and counts the rest."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: list[str] = []
        self._begun = ""
        self._left_out = 0

    def writable(self) -> bool:
        return True

    def write(self, text: str) -> int:
        """Append text, which need not end at a line boundary."""
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
        """Return the lines since the last call and the number of omitted ones."""
        lines = [*self._lines, self._begun] if self._begun else self._lines
        left_out = self._left_out
        self._lines, self._begun, self._left_out = [], "", 0
        return lines, left_out
