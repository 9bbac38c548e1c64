"""Says in a person's words what a path leads to, and what stands there."""

from dataclasses import fields, is_dataclass

from vicode.findings import Path

_KINDS = {
    "states": "state",
    "uses": "component",
    "parameters": "parameter",
    "outputs": "output",
    "variables": "variable",
}
_ATTRIBUTES = {"at": "place", "to": "target", "doc": "doc", "frequency": "frequency"}
_LONGEST = 400


def words_of_path(path: Path) -> str:
    """What a path leads to: "doc of state Kick", "transition 2 of state Kick, when"."""
    if not path:
        return "the design"
    section, *rest = path
    if section in _KINDS and rest:
        return _within(rest[1:], f"{_KINDS[str(section)]} {rest[0]}")
    if section == "common":
        return _within(rest, "the common ones")
    return _within(list(path), "the design")


def words_of_value(value: object) -> str:
    """A value as a short text; of a thing only what is said of it."""
    if value is None:
        return "(removed)"
    text = _text(value)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} …"


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
        said = ((each.name, getattr(value, each.name)) for each in fields(value))
        return "\n".join(f"{name}: {_text(part)}" for name, part in said if part not in ("", (), None, False))
    if isinstance(value, tuple):
        if value and all(isinstance(part, int | float) for part in value):
            return ", ".join(f"{part:g}" for part in value)
        return "; ".join(_text(part).replace("\n", ", ") for part in value)
    return str(value) if value != "" else "(empty)"
