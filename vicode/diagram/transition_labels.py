"""Labels of transitions: the guard in one line, and its kind."""

import re
from enum import StrEnum

from vicode.model.design import Guard
from vicode.model.traversal import LocatedDecision


class GuardKind(StrEnum):
    """The kind of a guard, shown as an icon on the label."""

    ALWAYS = "always"
    GUARD = "guard"
    TIMER = "timer"
    CODE = "code"
    TREE = "tree"


_MAX_DOC_LABEL = 30
_MEMBER = re.compile(r"\b((?:[^\W\d]\w*\.)+)([^\W\d]\w*)")


def short_transition_label(located: LocatedDecision, unit: str = "") -> str:
    """The documentation text if it is short enough for a label, else the guard."""
    doc = located.decision.doc
    return doc if is_short(doc) else transition_label(located, unit)


def is_short(doc: str) -> bool:
    """Whether a description can be the label."""
    return 0 < len(doc) <= _MAX_DOC_LABEL


def without_aliases(label: str) -> str:
    """A label with the names of outputs only; unchanged if that would make two of them equal."""
    members = {match[0]: match[2] for match in _MEMBER.finditer(label)}
    return _MEMBER.sub(r"\2", label) if len(set(members.values())) == len(members) else label


def transition_label(located: LocatedDecision, unit: str = "", *, spell_out: bool = False) -> str:
    """The guard, preceded by the guards of the enclosing groups.

    `unit` is the unit of times, "" for seconds. `spell_out` writes timers as "after 5 s", for places without a clock
    icon.
    """
    parts = [
        guard_label(group.guard, unit, spell_out=spell_out) if is_then else "else" for group, is_then in located.groups
    ]
    parts.append(guard_label(located.decision.guard, unit, spell_out=spell_out))
    return " › ".join(part for part in parts if part)


def guard_label(guard: Guard, unit: str = "", *, spell_out: bool = False) -> str:
    """The guard in one line: the expression, the timer as "5 s", a placeholder for code."""
    parts = [" ".join(guard.when.split())] if guard.when else []
    if guard.after:
        parts.append(f"{'after ' if spell_out else ''}{guard.after} {unit or 's'}")
    if guard.code is not None:
        parts.append("{ code }")
    return " and ".join(parts)


def guard_kind(located: LocatedDecision) -> GuardKind:
    """The kind of the guard; inside a group it is a branch of a decision tree."""
    if located.groups:
        return GuardKind.TREE
    guard = located.decision.guard
    if guard.is_empty:
        return GuardKind.ALWAYS
    if guard.code is not None:
        return GuardKind.CODE
    return GuardKind.GUARD if guard.when else GuardKind.TIMER
