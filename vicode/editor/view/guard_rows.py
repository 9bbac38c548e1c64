"""The guards of a state as rows: the condition, whether it holds, and the values it reads."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from vicode.diagram.transition_labels import guard_label
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Decision, DecisionGroup, Design, Guard, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.traversal import LocatedDecision, iter_decisions
from vicode.runs.guard_values import format_value


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
    """The enabled decisions of a state in the order of evaluation, the common ones first.

    Args:
        design: The design that runs.
        state: The active state.
        guards: The evaluated guards from the process, by decision; missing ones are "unknown".
    """
    tested = (located for located in iter_decisions(design) if located.source in (COMMON, state))
    off = disabled_states(design)
    return tuple(_row(located, guards, design.time_unit) for located in tested if is_enabled(located, off))


def _row(located: LocatedDecision, guards: Mapping[str, Any], unit: str) -> GuardRow:
    decision, key = located.decision, transition_key(located.path)
    record = guards.get(key)
    result = record if isinstance(record, dict) else {}
    holds = True if decision.guard.is_empty else result.get("holds")
    return GuardRow(
        key=key,
        depth=len(located.groups),
        outcome=_outcome(decision),
        text=_branch(located) + (guard_label(decision.guard, unit) or "always"),
        holds="unknown" if holds is None else format_value(bool(holds)),
        reads=_reads(decision.guard, result),
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

    return "" if not located.groups or located.groups[-1][1] else "else: "


def _reads(guard: Guard, result: Mapping[str, Any]) -> str:
    pairs = [f"{name} = {format_value(value)}" for name, value in (result.get("reads") or {}).items()]
    if guard.code is not None:
        parts = result.get("parts") or [None]
        returned = parts[-1]
        pairs.append("code was not evaluated" if returned is None else f"code returned {format_value(returned)}")
    return ", ".join(pairs)


def find_read_outputs(rows: Iterable[GuardRow], guards: Mapping[str, Any]) -> frozenset[str]:
    """The names, as `alias.output`, that the guards of these rows read."""
    results = (guards.get(row.key) for row in rows)
    return frozenset(name for result in results if isinstance(result, dict) for name in result.get("reads") or {})
