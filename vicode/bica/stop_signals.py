"""Signals that end a run."""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

_MESSAGE = b"stopping after this iteration; press Ctrl-C again to stop immediately\n"


class StopSignals:
    """Handles Ctrl-C, SIGTERM, SIGBREAK of Windows and, unless `nohup` ignores it, SIGHUP.

    All raise `KeyboardInterrupt`, except the first one if `is_deferred` is set: the caller asks `was_received`.
    """

    def __init__(self, *, is_silent: bool) -> None:
        self.received: int | None = None
        self.is_deferred = False
        self._is_silent = is_silent
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK"):
            number = getattr(signal, name, None)
            if number is not None and (name != "SIGHUP" or signal.getsignal(number) != signal.SIG_IGN):
                signal.signal(number, self._handle_signal)

    def was_received(self) -> bool:
        return self.received is not None

    @property
    def exit_code(self) -> int:
        return 128 + (self.received or signal.SIGINT)

    def _handle_signal(self, number: int, _frame: FrameType | None) -> None:
        is_first = self.received is None
        self.received = number
        if not (self.is_deferred and is_first):
            raise KeyboardInterrupt
        if not self._is_silent:
            # Bypasses Python's streams: the signal may interrupt a write to them.
            with suppress(OSError):
                os.write(2, _MESSAGE)
