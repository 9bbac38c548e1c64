"""The guards of a state as rows to read: what is tested, whether it holds, and which values say so."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from vicode.diagram.transition_labels import guard_label
from vicode.editor.view.selection import transition_key
from vicode.model.design import COMMON, Decision, DecisionGroup, Design, Guard, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.traversal import LocatedDecision, iter_decisions


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardRow:
    """One decision. `holds` is "true", "false" or "unknown"; `depth` counts the groups around it."""

    key: str
    depth: int
    outcome: str
    text: str
    holds: str
    reads: str
    is_common: bool
    can_have_breakpoint: bool


def list_guard_rows(design: Design, state: str, guards: Mapping[str, Any]) -> tuple[GuardRow, ...]:
    """The decisions that are tested in a state, in their order: the common ones first.

    Args:
        design: As it is run.
        state: The active one.
        guards: What the running process says of them, by decision; nothing is "unknown".
    """
    tested = (located for located in iter_decisions(design) if located.source in (COMMON, state))
    off = disabled_states(design)
    return tuple(_row(located, guards, design.time_unit) for located in tested if is_enabled(located, off))


def _row(located: LocatedDecision, guards: Mapping[str, Any], unit: str) -> GuardRow:
    decision, key = located.decision, transition_key(located.path)
    told = guards.get(key)
    held = told if isinstance(told, dict) else {}
    holds = True if decision.guard.is_empty else held.get("holds")
    return GuardRow(
        key=key,
        depth=len(located.groups),
        outcome=_outcome(decision),
        text=_branch(located) + (guard_label(decision.guard, unit) or "always"),
        holds="unknown" if holds is None else format_value(bool(holds)),
        reads=_reads(decision.guard, held),
        is_common=located.source == COMMON,
        can_have_breakpoint=isinstance(decision, Transition),
    )


def _outcome(decision: Decision) -> str:
    match decision:
        case Transition(to=to):
            return f"→ {to}"
        case DecisionGroup():
            return "group"
        case _:
            return "stay"


def _branch(located: LocatedDecision) -> str:
    """Whether it stands on the other side of the group around it."""
    return "" if not located.groups or located.groups[-1][1] else "else: "


def _reads(guard: Guard, held: Mapping[str, Any]) -> str:
    pairs = [f"{name} = {format_value(value)}" for name, value in (held.get("reads") or {}).items()]
    if guard.code is not None:
        parts = held.get("parts") or [None]
        returned = parts[-1]
        pairs.append("code was not tested" if returned is None else f"code returned {format_value(returned)}")
    return ", ".join(pairs)


def format_value(value: Any) -> str:
    """A value of a running component in few characters."""
    if value is None:
        return "unknown"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:.4g}"
    return str(value)[:60]


def find_read_outputs(rows: Iterable[GuardRow], guards: Mapping[str, Any]) -> frozenset[str]:
    """The names, as `alias.output`, that the guards of these rows read."""
    told = (guards.get(row.key) for row in rows)
    return frozenset(name for each in told if isinstance(each, dict) for name in each.get("reads") or {})
