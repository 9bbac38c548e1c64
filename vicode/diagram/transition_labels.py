"""What stands on an arrow: a transition's guard in one line, and which kind of guard it is."""

from enum import StrEnum

from vicode.model.design import Guard
from vicode.model.traversal import LocatedDecision


class GuardKind(StrEnum):
    """What decides about a transition, told by a small sign on its label."""

    ALWAYS = "always"
    GUARD = "guard"
    TIMER = "timer"
    CODE = "code"
    TREE = "tree"


_MAX_SHORT_LABEL = 16


def short_transition_label(located: LocatedDecision, unit: str = "") -> str:
    """The guard where it fits on an arrow; a long one gives way to a short doc."""
    label, doc = transition_label(located, unit), located.decision.doc
    return doc if len(label) > _MAX_SHORT_LABEL and 0 < len(doc) <= _MAX_SHORT_LABEL + 14 else label


def transition_label(located: LocatedDecision, unit: str = "", *, spell_out: bool = False) -> str:
    """The guard as it stands on the arrow, with the guards of the groups around it in front.

    `unit` is the unit of the design's times, "" for seconds. `spell_out` is for where no sign of a clock stands beside
    it: "after 5 s".
    """
    parts = [
        guard_label(group.guard, unit, spell_out=spell_out) if is_then else "else" for group, is_then in located.groups
    ]
    parts.append(guard_label(located.decision.guard, unit, spell_out=spell_out))
    return " › ".join(part for part in parts if part)


def guard_label(guard: Guard, unit: str = "", *, spell_out: bool = False) -> str:
    """A guard in a line: the expression, the timer as "5 s", code as a sign for it."""
    parts = [" ".join(guard.when.split())] if guard.when else []
    if guard.after:
        parts.append(f"{'after ' if spell_out else ''}{guard.after} {unit or 's'}")
    if guard.code is not None:
        parts.append("{ code }")
    return " and ".join(parts)


def guard_kind(located: LocatedDecision) -> GuardKind:
    """The kind of the guard; below a group it is a branch of a decision tree."""
    if located.groups:
        return GuardKind.TREE
    guard = located.decision.guard
    if guard.is_empty:
        return GuardKind.ALWAYS
    if guard.code is not None:
        return GuardKind.CODE
    return GuardKind.GUARD if guard.when else GuardKind.TIMER
