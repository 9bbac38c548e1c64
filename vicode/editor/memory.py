"""Keeps the garbage collector out of people's way, and gives memory back once they are gone.

A window is some ten thousand objects that refer to each other. With fifty of them, a full collection stops the server
for about a second, every few seconds. So what belongs to an open window is set aside, and looked at again only after
windows were closed.
"""

import contextlib
import ctypes
import gc
from collections.abc import Callable

from nicegui import App, core

# Panels are built a moment after their window came.
_BUILT_S = 3.0
# Windows that are closed one after the other go together.
_GONE_S = 5.0


class Memory:
    """Looks after the memory of a server: `begin` when all is imported, then by itself."""

    def __init__(self, app: App) -> None:
        """Hear of windows that come and go."""
        self._is_due: set[Callable[[], None]] = set()
        app.on_connect(lambda: self._later(_BUILT_S, self.set_aside))
        app.on_delete(lambda: self._later(_GONE_S, self.give_back))

    def set_aside(self) -> None:
        """Leave all that is there now out of collections: it is imported, or belongs to an open window."""
        gc.collect(1)
        gc.freeze()

    def give_back(self) -> None:
        """Free what belonged to closed windows, and return its pages to the system."""
        gc.unfreeze()
        gc.collect()
        gc.freeze()
        with contextlib.suppress(OSError, AttributeError):
            # Only glibc keeps freed pages until it is asked.
            ctypes.CDLL(None).malloc_trim(0)

    def _later(self, pause_s: float, act: Callable[[], None]) -> None:
        if act in self._is_due or core.loop is None:
            return
        self._is_due.add(act)

        def do() -> None:
            self._is_due.discard(act)
            act()

        core.loop.call_later(pause_s, do)
