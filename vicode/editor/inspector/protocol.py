"""The events that the forms in the browser report, besides edits (`vicode.editor.session.forms.edits`)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from vicode.editor.view import ItemRef


@dataclass(frozen=True, slots=True, kw_only=True)
class FocusField:
    """The user entered a field, or left it (`path` is None)."""

    kind: ClassVar = "focus"
    item: ItemRef
    path: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class SelectItem:
    """The user followed a link to an item."""

    kind: ClassVar = "select"
    item: ItemRef


@dataclass(frozen=True, slots=True, kw_only=True)
class CompleteText:
    """Request completions of the text of a field at a character offset; `number` is that of the answer."""

    kind: ClassVar = "complete"
    number: int
    rev: int
    item: ItemRef
    path: str
    text: str
    offset: int


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenCode:
    """Open the text of a field in the user's own editor."""

    kind: ClassVar = "open-code"
    rev: int
    item: ItemRef
    path: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ListFixes:
    """Request the quick fixes of a finding, by its number in the marks."""

    kind: ClassVar = "fixes"
    finding: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ApplyFix:
    """Apply a quick fix; `label` is what the user saw."""

    kind: ClassVar = "fix"
    finding: int
    index: int
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ShowLanguage:
    """The user chose the tab of a language."""

    kind: ClassVar = "language"
    language: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ToggleSection:
    """The user opened or closed a section; it stays so for all items."""

    kind: ClassVar = "section"
    key: Literal["enter-leave", "more", "xabsl", "code", "project"]
    is_open: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class LostText:
    """A text that was typed before the server was started again, for which the item has no field any more."""

    kind: ClassVar = "lost-text"
    item: ItemRef
    text: str


FormEvent = (
    FocusField | SelectItem | CompleteText | OpenCode | ListFixes | ApplyFix | ShowLanguage | ToggleSection | LostText
)
_EVENTS: tuple[type[FormEvent], ...] = (
    FocusField,
    SelectItem,
    CompleteText,
    OpenCode,
    ListFixes,
    ApplyFix,
    ShowLanguage,
    ToggleSection,
    LostText,
)
FORM_EVENTS: Mapping[str, type[FormEvent]] = {event.kind: event for event in _EVENTS}
"""The events by kind."""
