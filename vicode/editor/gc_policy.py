"""Garbage collection of the server: avoids long pauses, and releases memory after windows close.

A window consists of about ten thousand objects with cyclic references. With fifty windows, a full collection stops the
server for about a second, every few seconds. Objects that survive a slow collection are therefore frozen until windows
close.
"""

import contextlib
import ctypes
import gc
import time
from collections.abc import Callable, Mapping

from nicegui import App, core

# A longer collection is noticeable.
_SLOW_S = 0.05
# Windows that close within this time are released together.
_RELEASE_DELAY_S = 5.0


class GcPolicy:
    """Freezes and releases objects of a server. Call `freeze_gc` after all imports; the rest is automatic."""

    def __init__(self, app: App) -> None:
        self._scheduled: set[Callable[[], None]] = set()
        self._started_s = 0.0
        app.on_delete(lambda: self._schedule(_RELEASE_DELAY_S, self.release_memory))
        gc.callbacks.append(self._on_collection)

    def freeze_gc(self) -> None:
        """Exclude all current objects from collections: imported modules and open windows."""
        gc.collect(1)
        gc.freeze()

    def release_memory(self) -> None:
        """Free the objects of closed windows, and return their pages to the system."""
        gc.unfreeze()
        gc.collect()
        gc.freeze()
        with contextlib.suppress(OSError, AttributeError):
            # glibc keeps freed pages until malloc_trim is called.
            ctypes.CDLL(None).malloc_trim(0)

    def _on_collection(self, phase: str, info: Mapping[str, int]) -> None:
        if phase == "start":
            self._started_s = time.perf_counter()
        elif info["generation"] == 2 and time.perf_counter() - self._started_s > _SLOW_S and core.loop is not None:
            with contextlib.suppress(RuntimeError):
                # The event loop may be closed already.
                core.loop.call_soon_threadsafe(gc.freeze)

    def _schedule(self, delay_s: float, action: Callable[[], None]) -> None:
        if action in self._scheduled or core.loop is None:
            return
        self._scheduled.add(action)

        def run() -> None:
            self._scheduled.discard(action)
            action()

        core.loop.call_later(delay_s, run)
