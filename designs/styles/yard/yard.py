"""A yard in which obstacles come and go, and that notes how many iterations pass until the rover reacts."""

from random import Random
from statistics import mean

TICK_S = 0.02
NEAR, EMPTY = 0.5, 20.0
_EVENTS = {"bump": (0.3, 12.0), "obstacle": (1.5, 5.0)}
"""How long each lasts, and the mean time until the next one, in s."""


class Yard:
    """The inputs are drawn from the seed and do not depend on the rover, so that all styles meet the same."""

    def __init__(self, seed: int = 0) -> None:
        self._random = Random(seed)
        self._until = dict.fromkeys(_EVENTS, 0.0)
        self._next = {name: self._random.expovariate(1 / pause) for name, (_long, pause) in _EVENTS.items()}
        self._command, self._waits_for, self._waited = (0.0, 0.0), "", 0
        self._is_charging = False
        self.bumped, self.ahead, self.battery = False, 5.0, 100.0
        self.reactions: dict[str, list[int]] = {"bump": [], "obstacle": [], "battery": []}

    def advance(self, now_ns: int) -> None:
        now = now_ns / 1e9
        self._note_reaction()
        for name, (lasts, pause) in _EVENTS.items():
            if now >= self._next[name]:
                self._until[name] = now + lasts
                self._next[name] = now + lasts + self._random.expovariate(1 / pause)
        self.bumped = now < self._until["bump"]
        self.ahead = 0.3 if now < self._until["obstacle"] else 3.0
        stands = self._command == (0.0, 0.0)
        self._is_charging = stands and (self._is_charging or self.battery < EMPTY)
        self.battery += (20 if self._is_charging else -4) * TICK_S
        self._expect()
        self._command = (0.0, 0.0)

    def drive(self, *, speed: float, turn: float) -> None:
        self._command = (speed, turn)

    def _expect(self) -> None:
        """Begin to count if there is something to react to, and the rover drives ahead as if there was nothing."""
        if self.bumped and self._waits_for != "bump":
            # A bump is more urgent than what the rover was to react to.
            self._waits_for = ""
        if self._waits_for or self._command[0] <= 0:
            return
        events = {"bump": self.bumped, "battery": self.battery < EMPTY, "obstacle": self.ahead < NEAR}
        self._waits_for, self._waited = next((name for name, is_so in events.items() if is_so), ""), 0

    def _note_reaction(self) -> None:
        speed, turn = self._command
        has_reacted = {"bump": speed < 0, "battery": not speed and not turn, "obstacle": turn > 0, "": False}
        if has_reacted[self._waits_for]:
            self.reactions[self._waits_for].append(self._waited)
            self._waits_for = ""
        self._waited += 1

    def summary(self) -> dict[str, float]:
        """Mean number of iterations from an event to the command that answers it; 0 is the same iteration."""
        found = {f"{name}_mean": round(mean(all_), 2) for name, all_ in self.reactions.items() if all_}
        found |= {f"{name}_max": max(all_) for name, all_ in self.reactions.items() if all_}
        return found | {f"{name}_count": len(all_) for name, all_ in self.reactions.items()}
