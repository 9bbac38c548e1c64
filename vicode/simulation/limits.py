"""Limits on user code: time, memory, and the amount of output."""

from __future__ import annotations

import ctypes
import io
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, NoReturn

from vicode.platform import limit_resource

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
    signals: Any = signal
    if not hasattr(signal, "setitimer"):
        with _thread_limit(seconds):
            yield
        return
    signal.signal(signals.SIGALRM, _interrupt)
    # Repeats, in case user code swallows the first interrupt.
    signals.setitimer(signals.ITIMER_REAL, seconds, 0.1)
    try:
        yield
    finally:
        signals.setitimer(signals.ITIMER_REAL, 0)


@contextmanager
def _thread_limit(seconds: float) -> Iterator[None]:
    """The same where there are no timers with signals; it interrupts no call of C code, such as `time.sleep`."""
    thread, ended, guard = ctypes.c_ulong(threading.get_ident()), threading.Event(), threading.Lock()

    def interrupt() -> None:
        wait_s = seconds
        while not ended.wait(wait_s):
            wait_s = 0.1
            with guard:
                if not ended.is_set():
                    ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(TimeLimitError))

    threading.Thread(target=interrupt, daemon=True).start()
    try:
        yield
    finally:
        with guard:
            ended.set()


def limit_memory(bytes_: int) -> None:
    """Make allocations above this limit fail with `MemoryError`, and disable core dumps; Windows has no such limit."""
    # The hard limit, too: the code must not raise it.
    limit_resource("RLIMIT_DATA", bytes_)
    limit_resource("RLIMIT_CORE", 0)


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
