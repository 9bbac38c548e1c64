"""Disabled states and decisions. Transitions to disabled states are disabled as well."""

from collections.abc import Collection, Iterable
from dataclasses import replace

from vicode.model.design import Decision, DecisionGroup, Design, Transition
from vicode.model.traversal import LocatedDecision


def disabled_states(design: Design) -> frozenset[str]:
    return frozenset(state.name for state in design.states if state.disabled)


def strip_disabled(design: Design) -> Design:
    """Remove disabled states and decisions, and transitions to disabled states."""
    disabled = disabled_states(design)
    states = (state for state in design.states if not state.disabled)
    return replace(
        design,
        common=replace(design.common, transitions=_strip_disabled_items(design.common.transitions, disabled)),
        states=tuple(
            replace(state, transitions=_strip_disabled_items(state.transitions, disabled)) for state in states
        ),
    )


def strip_disabled_decision(decision: Decision, disabled: Collection[str]) -> Decision | None:
    """Remove the disabled parts of a decision. Return None if it is disabled, or a group that becomes empty.

    Args:
        decision: The decision.
        disabled: The names of disabled states.
    """
    if decision.disabled or (isinstance(decision, Transition) and decision.to in disabled):
        return None
    if not isinstance(decision, DecisionGroup):
        return decision
    then, otherwise = (
        _strip_disabled_items(decision.then, disabled),
        _strip_disabled_items(decision.otherwise, disabled),
    )
    if (then, otherwise) == (decision.then, decision.otherwise):
        return decision
    return replace(decision, then=then, otherwise=otherwise) if then or otherwise else None


def is_enabled(located: LocatedDecision, disabled: Collection[str]) -> bool:
    """Return whether neither a decision nor its source, enclosing groups or target are disabled."""
    is_inside = any(group.disabled for group, _is_then in located.groups)
    return (
        not is_inside
        and located.source not in disabled
        and strip_disabled_decision(located.decision, disabled) is not None
    )


def _strip_disabled_items(items: Iterable[Decision], disabled: Collection[str]) -> tuple[Decision, ...]:
    enabled = (strip_disabled_decision(item, disabled) for item in items)
    return tuple(item for item in enabled if item is not None)
