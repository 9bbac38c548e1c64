"""Watchdog: holds the robot when an iteration takes too long, because its last commands stay in effect until then."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Self

from .errors import print_error

if TYPE_CHECKING:
    from .base_root import BaseRoot

_CHECKS_PER_LIMIT = 4


class Watchdog:
    """Calls `hold` of a root from a thread, once for each iteration that takes too long; a context manager.

    A pause by a viewer does not count. Without a limit, or if the world has no `hold`, no thread is started.

    Args:
        root: The root.
        limit_s: How long an iteration may take.
        now_s: The time, in seconds.
    """

    def __init__(self, root: BaseRoot, limit_s: float, now_s: Callable[[], float] = time.monotonic) -> None:
        self._root, self._limit_s, self._now_s = root, limit_s, now_s
        self._begun_s: float | None = None
        self._handled_s: float | None = None
        """The begin of the last iteration that needs no further check; only the thread changes it."""
        self._is_closed = threading.Event()
        is_needed = limit_s > 0 and callable(getattr(root.world, "hold", None))
        self._thread = threading.Thread(target=self._run, name="vicode-hold", daemon=True) if is_needed else None

    def __enter__(self) -> Self:
        if self._thread is not None:
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_closed.set()
        if self._thread is not None:
            self._thread.join(self._limit_s)

    def begin(self) -> None:
        """Begin an iteration."""
        self._begun_s = self._now_s()

    def end(self) -> None:
        """End an iteration."""
        self._begun_s = None

    def check(self) -> None:
        """Hold the robot if the iteration takes too long; called by the thread."""
        begun_s, root = self._begun_s, self._root
        if begun_s is None or begun_s == self._handled_s:
            return
        if root._is_time_stopped:
            # A viewer pauses the robot, which is held already.
            self._handled_s = begun_s
        elif self._now_s() - begun_s > self._limit_s:
            self._handled_s = begun_s
            print_error(
                f"iteration {root.iteration} takes longer than {self._limit_s:g} s; the robot was held", kind="warning"
            )
            root.hold()

    def _run(self) -> None:
        while not self._is_closed.wait(self._limit_s / _CHECKS_PER_LIMIT):
            self.check()
