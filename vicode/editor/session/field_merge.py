"""Merges the text that a user types into a field with concurrent edits of the same value."""

from dataclasses import dataclass, field
from typing import Any

from vicode.model.merge import merge_characters

_MAX_SENT = 64


@dataclass(slots=True)
class FieldMerge:
    """One field in one window: the value it shows, and how the design would store that value alone."""

    shown: Any = None
    own_value: Any = field(default=None)

    def set_shown(self, value: Any) -> None:
        """Record that the field shows the value of the design."""
        self.shown = self.own_value = value

    def merge_typed(self, typed: Any, now: Any) -> Any:
        """The value to write: the typed one merged with the edits of others.

        Edits of others are in the design, but the field does not show them while its user types; each written value
        merges them again. The design may normalize a value (spaces around an operator), which is not an edit.

        Args:
            typed: The value in the field.
            now: The value in the design.
        """
        if now == self.own_value:
            return typed
        if isinstance(typed, str) and isinstance(self.shown, str) and isinstance(now, str):
            theirs = merge_characters(str(self.own_value), self.shown, now)
            return merge_characters(self.shown, typed, theirs)
        if isinstance(typed, list) and isinstance(self.shown, list) and isinstance(now, list):
            kept = [value for value in now if value in typed or value not in self.shown]
            return kept + [value for value in typed if value not in self.shown and value not in kept]
        return typed

    def record_sent(self, typed: Any, alone: Any) -> None:
        """Record that the browser shows `typed`, which the design without others' edits would store as `alone`."""
        self.shown, self.own_value = typed, alone


@dataclass(slots=True)
class SentValues:
    """The values recently sent to a field of a browser, one of which it shows.

    A typed value carries the number of the value it was typed over, which selects the base of the merge.
    """

    field_merge: FieldMerge = field(default_factory=FieldMerge)
    _sent: dict[int, FieldMerge] = field(default_factory=dict)
    _latest: int = -1

    def record_shown(self, value: Any, number: int = 0) -> None:
        """Record that a value is sent; `number` increases with each message, or repeats the latest one."""
        if number > self._latest:
            self._latest = number
            self.field_merge = self._sent[number] = FieldMerge()
            if len(self._sent) > _MAX_SENT:
                del self._sent[next(iter(self._sent))]
        self.field_merge.set_shown(value)

    def select_base(self, number: int) -> None:
        """Record that the user types over the value sent with `number`."""
        known = self._sent.get(number)
        if known is not None:
            self.field_merge, self._sent = known, {number: known}
