"""The events that the table in the browser reports."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from vicode.editor.session.gestures.edits import RequestedEdit
from vicode.editor.session.gestures.table_edits import TABLE_EDITS


@dataclass(frozen=True, slots=True, kw_only=True)
class SelectRow:
    """The user went to a row."""

    kind: ClassVar = "select"
    row: str


TableEvent = SelectRow | RequestedEdit
_EVENTS: tuple[type[TableEvent], ...] = (SelectRow, *TABLE_EDITS)
TABLE_EVENTS: Mapping[str, type[TableEvent]] = {event.kind: event for event in _EVENTS}
"""The events by kind."""
