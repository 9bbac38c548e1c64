"""What one person types meets what others changed in the same value meanwhile."""

from dataclasses import dataclass, field
from typing import Any

from vicode.model.merging import merge_typing


@dataclass(slots=True)
class Keystrokes:
    """One field in one window: the value it shows, and what the design would hold if that alone had been written."""

    shown: Any = None
    alone: Any = field(default=None)

    def show(self, value: Any) -> None:
        """The design's value is shown."""
        self.shown = self.alone = value

    def bring_in(self, typed: Any, now: Any) -> Any:
        """The value to write: what was typed since, together with what others made of the design's value.

        What others typed is in the design from the first time on, but is not shown as long as one types: it is brought
        in with every value that is written. The design may spell a value in a way of its own (blanks around a sign):
        that is nobody's change.
        """
        if now == self.alone:
            return typed
        if isinstance(typed, str) and isinstance(self.shown, str) and isinstance(now, str):
            theirs = merge_typing(str(self.alone), self.shown, now)
            return merge_typing(self.shown, typed, theirs)
        if isinstance(typed, list) and isinstance(self.shown, list) and isinstance(now, list):
            kept = [each for each in now if each in typed or each not in self.shown]
            return kept + [each for each in typed if each not in self.shown and each not in kept]
        return typed

    def sent(self, typed: Any, alone: Any) -> None:
        """The browser shows what was typed; `alone` is how the design spells that, without what others made of it."""
        self.shown, self.alone = typed, alone
