"""What stands on an arrow: a transition's guard in one line, and which kind of guard it is."""

from enum import StrEnum

from vicode.model.design import Guard
from vicode.model.walks import Located


class Kind(StrEnum):
    """What decides about a transition, told by a small sign on its label."""

    ALWAYS = "always"
    GUARD = "guard"
    TIMER = "timer"
    CODE = "code"
    TREE = "tree"


_LABEL_FITS = 16


def short_label(located: Located, unit: str = "") -> str:
    """The guard where it fits on an arrow; a long one gives way to a short doc."""
    label, doc = label_of(located, unit), located.decision.doc
    return doc if len(label) > _LABEL_FITS and 0 < len(doc) <= _LABEL_FITS + 14 else label


def label_of(located: Located, unit: str = "", *, spelled: bool = False) -> str:
    """The guard as it stands on the arrow, with the guards of the groups around it in front.

    `unit` is the unit of the design's times, "" for seconds. `spelled` is for where no sign of a clock stands beside
    it: "after 5 s".
    """
    parts = [
        guard_label(group.guard, unit, spelled=spelled) if is_then else "else" for group, is_then in located.groups
    ]
    parts.append(guard_label(located.decision.guard, unit, spelled=spelled))
    return " › ".join(part for part in parts if part)


def guard_label(guard: Guard, unit: str = "", *, spelled: bool = False) -> str:
    """A guard in a line: the expression, the timer as "5 s", code as a sign for it."""
    parts = [" ".join(guard.when.split())] if guard.when else []
    if guard.after:
        parts.append(f"{'after ' if spelled else ''}{guard.after} {unit or 's'}")
    if guard.code is not None:
        parts.append("{ code }")
    return " and ".join(parts)


def kind_of(located: Located) -> Kind:
    """The kind of the guard; below a group it is a branch of a decision tree."""
    if located.groups:
        return Kind.TREE
    guard = located.decision.guard
    if guard.is_empty:
        return Kind.ALWAYS
    if guard.code is not None:
        return Kind.CODE
    return Kind.GUARD if guard.when else Kind.TIMER
