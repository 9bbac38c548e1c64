"""What one person types meets what others changed in the same value meanwhile."""

from dataclasses import dataclass, field, replace
from typing import Any

from vicode.model.merge import merge_characters

_MAX_SENT = 64


@dataclass(slots=True)
class FieldMerge:
    """One field in one window: the value it shows, and what the design would hold if that alone had been written."""

    shown: Any = None
    own_value: Any = field(default=None)

    def set_shown(self, value: Any) -> None:
        """The design's value is shown."""
        self.shown = self.own_value = value

    def merge_typed(self, typed: Any, now: Any) -> Any:
        """The value to write: what was typed since, together with what others made of the design's value.

        What others typed is in the design from the first time on, but is not shown as long as one types: it is brought
        in with every value that is written. The design may spell a value in a way of its own (blanks around a sign):
        that is nobody's change.
        """
        if now == self.own_value:
            return typed
        if isinstance(typed, str) and isinstance(self.shown, str) and isinstance(now, str):
            theirs = merge_characters(str(self.own_value), self.shown, now)
            return merge_characters(self.shown, typed, theirs)
        if isinstance(typed, list) and isinstance(self.shown, list) and isinstance(now, list):
            kept = [each for each in now if each in typed or each not in self.shown]
            return kept + [each for each in typed if each not in self.shown and each not in kept]
        return typed

    def record_sent(self, typed: Any, alone: Any) -> None:
        """The browser shows what was typed; `own_value` is how the design spells that, without what others made of it."""
        self.shown, self.own_value = typed, alone


@dataclass(slots=True)
class SentValues:
    """What a browser shows in a field, as far as is known: one of the values that were sent to it lately.

    What somebody types tells which one it was. Those sent since are not shown.
    """

    field_merge: FieldMerge = field(default_factory=FieldMerge)
    _sent: dict[int, FieldMerge] = field(default_factory=dict)
    _latest: int = -1

    def record_shown(self, value: Any, number: int = 0) -> None:
        """A value of the design is sent with a number, a greater one than any before, or is what was sent last."""
        if number > self._latest:
            self._latest = number
            self.field_merge = self._sent[number] = FieldMerge()
            if len(self._sent) > _MAX_SENT:
                del self._sent[next(iter(self._sent))]
        self.field_merge.set_shown(value)

    def select_base(self, number: int) -> None:
        """Something is typed on what was sent with a number."""
        known = self._sent.get(number)
        if known is not None:
            self.field_merge, self._sent = known, {number: known}

    def transfer_input_from(self, other: "SentValues") -> None:
        """Whatever of it is shown, what is typed goes on from what the other one showed."""
        self.field_merge = replace(other.field_merge)
        self._sent = dict.fromkeys(self._sent, self.field_merge)
