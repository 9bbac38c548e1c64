"""Says in a person's words what a path leads to, and what stands there."""

from dataclasses import fields, is_dataclass

from vicode.editor.session.presence import Presence
from vicode.editor.view import ItemRef, parse_transition_key
from vicode.findings import DesignPath

_KINDS = {
    "states": "state",
    "uses": "component",
    "parameters": "parameter",
    "outputs": "output",
    "variables": "variable",
}
_ATTRIBUTES = {"at": "place", "to": "target", "doc": "doc", "frequency": "frequency"}
_LONGEST = 400


def describe_path(path: DesignPath) -> str:
    """What a path leads to: "doc of state Kick", "transition 2 of state Kick, when"."""
    if not path:
        return "the design"
    section, *rest = path
    if section in _KINDS and rest:
        return _within(rest[1:], f"{_KINDS[str(section)]} {rest[0]}")
    if section == "common":
        return _within(rest, "the common ones")
    return _within(list(path), "the design")


def describe_presence(presence: Presence) -> str:
    """What somebody is at: the field being typed in, else what is selected; nothing if neither."""
    if presence.editing_path:
        return f"types {describe_path(presence.editing_path)}"
    if len(presence.selected) > 1:
        return f"{len(presence.selected)} things"
    return next((_words_of_thing(thing) for thing in presence.selected), "")


def describe_value(value: object) -> str:
    """A value as a short text; of a thing only what is said of it."""
    if value is None:
        return "(removed)"
    text = _text(value)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} …"


def _words_of_thing(thing: ItemRef) -> str:
    match thing.kind:
        case "states":
            return f"state {thing.id}"
        case "components":
            return f"component {thing.id}"
        case "transitions":
            return describe_path(parse_transition_key(thing.id))
        case _:
            return ""


def _within(steps: list[str | int], thing: str) -> str:
    if not steps:
        return thing
    if len(steps) > 1 and isinstance(steps[1], int):
        kind = {"transitions": "transition", "then": "decision", "else": "decision"}.get(str(steps[0]), f"{steps[0]}")
        inner = f"{kind} {steps[1] + 1} of {thing}"
        return ", ".join([inner, *(_attribute(step) for step in steps[2:])])
    return f"{', '.join(_attribute(step) for step in steps)} of {thing}"


def _attribute(step: str | int) -> str:
    return str(step + 1) if isinstance(step, int) else _ATTRIBUTES.get(step, step)


def _text(value: object) -> str:
    if is_dataclass(value) and not isinstance(value, type):
        parts = ((each.name, getattr(value, each.name)) for each in fields(value))
        said = ((name, _text(part)) for name, part in parts if part not in ("", (), None, False))
        return "\n".join(f"{name}: {text}" for name, text in said if text)
    if isinstance(value, tuple):
        if value and all(isinstance(part, int | float) for part in value):
            return ", ".join(f"{part:g}" for part in value)
        return "; ".join(_text(part).replace("\n", ", ") for part in value)
    return str(value) if value != "" else "(empty)"


def error_reason(error: OSError | ValueError) -> str:
    """Why something could not be done, in words."""
    return (error.strerror or str(error)) if isinstance(error, OSError) else str(error)
