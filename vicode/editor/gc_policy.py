"""Keeps the garbage collector out of people's way, and gives memory back once they are gone.

A window is some ten thousand objects that refer to each other. With fifty of them, a full collection stops the server
for about a second, every few seconds. So what a slow collection found alive is set aside, and looked at again only
after windows were closed.
"""

import contextlib
import ctypes
import gc
import time
from collections.abc import Callable, Mapping

from nicegui import App, core

# A collection that takes longer is felt by who is at work.
_SLOW_S = 0.05
# Windows that are closed one after the other go together.
_RELEASE_DELAY_S = 5.0


class GcPolicy:
    """Looks after the memory of a server: `freeze_gc` when all is imported, then by itself."""

    def __init__(self, app: App) -> None:
        """Hear of windows that go, and of collections."""
        self._scheduled: set[Callable[[], None]] = set()
        self._begun_s = 0.0
        app.on_delete(lambda: self._schedule(_RELEASE_DELAY_S, self.release_memory))
        gc.callbacks.append(self._on_collection)

    def freeze_gc(self) -> None:
        """Leave all that is there now out of collections: it is imported, or belongs to an open window."""
        gc.collect(1)
        gc.freeze()

    def release_memory(self) -> None:
        """Free what belonged to closed windows, and return its pages to the system."""
        gc.unfreeze()
        gc.collect()
        gc.freeze()
        with contextlib.suppress(OSError, AttributeError):
            # Only glibc keeps freed pages until it is asked.
            ctypes.CDLL(None).malloc_trim(0)

    def _on_collection(self, phase: str, info: Mapping[str, int]) -> None:
        """Hear that a collection begins or ends, in whatever thread."""
        if phase == "start":
            self._begun_s = time.perf_counter()
        elif info["generation"] == 2 and time.perf_counter() - self._begun_s > _SLOW_S and core.loop is not None:
            with contextlib.suppress(RuntimeError):
                # A loop that was closed takes nothing any more, and needs nothing.
                core.loop.call_soon_threadsafe(gc.freeze)

    def _schedule(self, pause_s: float, act: Callable[[], None]) -> None:
        if act in self._scheduled or core.loop is None:
            return
        self._scheduled.add(act)

        def do() -> None:
            self._scheduled.discard(act)
            act()

        core.loop.call_later(pause_s, do)
