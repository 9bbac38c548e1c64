"""Describes the paths of items in words."""

from vicode.findings import DesignPath

_KINDS = {
    "states": "state",
    "uses": "component",
    "parameters": "parameter",
    "outputs": "output",
    "variables": "variable",
    "latches": "latch",
    "layers": "layer",
    "notes": "note",
    "constants": "constant",
    "enumerations": "enumeration",
    "components": "component",
    "agents": "agent",
}
_ITEM_KINDS = {
    "transitions": "transition",
    "then": "decision",
    "else": "decision",
    "enter": "enter action",
    "actions": "action",
    "leave": "leave action",
    "interrupts": "interrupt",
}
_ATTRIBUTES = {"at": "position", "doc": "description", "label_at": "label position", "to": "target"}


def describe_path(path: DesignPath, whole: str = "the design") -> str:
    """The subject of a path, such as "description of state Kick" or "transition 2 of state Kick, when".

    `whole` are the words for the design or project itself.
    """
    if not path:
        return whole
    section, *rest = path
    if section in _KINDS and rest:
        return _within(rest[1:], f"{_KINDS[str(section)]} {rest[0]}")
    if section == "competence" and len(rest) > 1:
        return _within(rest[2:], f"step {rest[1]}")
    if section == "common":
        return _within(rest, "the common section")
    return _within(list(path), whole)


def _within(steps: list[str | int], owner: str) -> str:
    if not steps:
        return owner
    if len(steps) > 1 and isinstance(steps[1], int):
        kind = _ITEM_KINDS.get(str(steps[0]), str(steps[0]))
        inner = f"{kind} {steps[1] + 1} of {owner}"
        return ", ".join([inner, *(_attribute(step) for step in steps[2:])])
    return f"{', '.join(_attribute(step) for step in steps)} of {owner}"


def _attribute(step: str | int) -> str:
    return str(step + 1) if isinstance(step, int) else _ATTRIBUTES.get(step, step)
