"""Takes each event of a browser once; see `delivery.js`, which sends unanswered ones again after a lost connection."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass

_CONFIRM_DELAY_S = 0.5


@dataclass(eq=False)
class Inbox:
    """The events of one window; `confirm` tells its browser the number of the last one, a while after it came."""

    confirm: Callable[[int], None]
    _last: int = 0
    _is_waiting: bool = False

    def take(self, payload: object) -> bool:
        """Remove the number from an event; return whether to handle it: not if it came before."""
        number = payload.pop("delivery", None) if isinstance(payload, dict) else None
        if not isinstance(number, int):
            return True
        is_new = number > self._last
        self._last = max(self._last, number)
        if not self._is_waiting:
            self._is_waiting = True
            asyncio.get_running_loop().call_later(_CONFIRM_DELAY_S, self._confirm)
        return is_new

    def _confirm(self) -> None:
        self._is_waiting = False
        self.confirm(self._last)
