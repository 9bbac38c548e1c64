"""What of a design works: all but the disabled states and decisions, and the transitions that lead to such states."""

from collections.abc import Collection, Iterable
from dataclasses import replace

from vicode.findings import Path
from vicode.model.design import Decision, Design, Group, Transition
from vicode.model.edits import replace_decision
from vicode.model.walks import Located, decision_at


def disabled_states(design: Design) -> frozenset[str]:
    """The names of the states that are kept without working."""
    return frozenset(state.name for state in design.states if state.disabled)


def enabled_part(design: Design) -> Design:
    """The design as it works: what is disabled, and what leads there, is not in it."""
    off = disabled_states(design)
    states = (state for state in design.states if not state.disabled)
    return replace(
        design,
        common=replace(design.common, transitions=_enabled(design.common.transitions, off)),
        states=tuple(replace(state, transitions=_enabled(state.transitions, off)) for state in states),
    )


def enabled_decision(decision: Decision, off: Collection[str]) -> Decision | None:
    """A decision as it works, None when it does not; `off` are the disabled states.

    A group that is left with nothing decides nothing, so it goes too.
    """
    if decision.disabled or (isinstance(decision, Transition) and decision.to in off):
        return None
    if not isinstance(decision, Group):
        return decision
    then, otherwise = _enabled(decision.then, off), _enabled(decision.otherwise, off)
    if (then, otherwise) == (decision.then, decision.otherwise):
        return decision
    return replace(decision, then=then, otherwise=otherwise) if then or otherwise else None


def is_working(located: Located, off: Collection[str]) -> bool:
    """Whether a decision at its place can ever be taken, as far as disabling goes."""
    is_inside = any(group.disabled for group, _is_then in located.groups)
    return not is_inside and located.source not in off and enabled_decision(located.decision, off) is not None


def disable(design: Design, states: Collection[str], paths: Collection[Path], *, flag: bool) -> Design:
    """Disable states and decisions (`flag`), or enable them again."""
    kept = tuple(replace(state, disabled=flag) if state.name in states else state for state in design.states)
    changed = replace(design, states=kept)
    for path in paths:
        located = decision_at(changed, path)
        if located is not None:
            changed = replace_decision(changed, path, replace(located.decision, disabled=flag))
    return changed


def _enabled(items: Iterable[Decision], off: Collection[str]) -> tuple[Decision, ...]:
    enabled = (enabled_decision(item, off) for item in items)
    return tuple(item for item in enabled if item is not None)
