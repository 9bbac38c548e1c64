"""Describes values and presences in words."""

from dataclasses import fields, is_dataclass

from vicode.editor.session.presence import Presence
from vicode.editor.view import ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.paths import describe_path

_MAX_VALUE_LENGTH = 400


def describe_presence(presence: Presence) -> str:
    """The field a user edits, else the selection; empty if neither."""
    if presence.editing_path:
        return f"edits {describe_path(presence.editing_path)}"
    if len(presence.selected) > 1:
        return f"{len(presence.selected)} items"
    return next((_describe_item(item) for item in presence.selected), "")


def describe_value(value: object) -> str:
    """A value as a short text; records list only their non-default fields."""
    if value is None:
        return "(removed)"
    text = _text(value)
    return text if len(text) <= _MAX_VALUE_LENGTH else f"{text[:_MAX_VALUE_LENGTH]} …"


def _describe_item(item: ItemRef) -> str:
    match item.kind:
        case "states":
            return f"state {item.id}"
        case "components":
            return f"component {item.id}"
        case "transitions":
            return describe_path(parse_transition_key(item.id))
        case _:
            return ""


def _text(value: object) -> str:
    if is_dataclass(value) and not isinstance(value, type):
        parts = ((field.name, getattr(value, field.name)) for field in fields(value))
        texts = ((name, _text(part)) for name, part in parts if part not in ("", (), None, False))
        return "\n".join(f"{name}: {text}" for name, text in texts if text)
    if isinstance(value, tuple):
        if value and all(isinstance(part, int | float) for part in value):
            return ", ".join(f"{part:g}" for part in value)
        return "; ".join(_text(part).replace("\n", ", ") for part in value)
    return str(value) if value != "" else "(empty)"


def error_reason(error: OSError | ValueError) -> str:
    """The reason of an error, without the file that an OSError appends."""
    return (error.strerror or str(error)) if isinstance(error, OSError) else str(error)
