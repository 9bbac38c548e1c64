"""Rules about the states as a graph: the initial one, ways that lead in, ways that lead out."""

from collections import defaultdict
from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import Finding, did_you_mean
from vicode.model.design import COMMON, Transition
from vicode.model.disabled import strip_disabled_decision


def find_no_states(context: RuleContext) -> Iterator[Finding]:
    """D411: a design without states."""
    if not context.design.states:
        yield context.make_finding("D411", (), "a design needs a state", "add 'states:' with at least one")


def find_no_initial_state(context: RuleContext) -> Iterator[Finding]:
    """D401: no initial state, or one that does not exist."""
    design = context.design
    if not design.states or design.state(design.initial):
        return
    first = design.states[0].name
    if design.initial:
        mend = did_you_mean(design.initial, _state_names(context), f"write initial: {first}")
        yield context.make_finding("D401", ("initial",), f"there is no state '{design.initial}'", mend)
    else:
        yield context.make_finding("D401", (), "the initial state is not given", f"write initial: {first}")


def find_disabled_initial_state(context: RuleContext) -> Iterator[Finding]:
    """D418: the component cannot begin in a state that is disabled."""
    initial = context.design.initial
    if initial in context.disabled_states:
        message = f"the initial state '{initial}' is disabled"
        yield context.make_finding("D418", ("initial",), message, "choose another initial state, or enable it")


def find_unknown_states(context: RuleContext) -> Iterator[Finding]:
    """D402: a transition to a state that does not exist."""
    names = _state_names(context)
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to not in names:
            mend = did_you_mean(decision.to, names, "add the state, or choose another")
            yield context.make_finding("D402", (*located.path, "to"), f"there is no state '{decision.to}'", mend)


def find_unreachable_states(context: RuleContext) -> Iterator[Finding]:
    """D421: a state that no way leads to from the initial one."""
    design = context.design
    if not design.state(design.initial) or design.initial in context.disabled_states:
        return
    reachable = _reachable_states(context, _targets(context))
    for state in design.states:
        if state.name not in reachable and not state.disabled:
            message = f"no way leads from '{design.initial}' to '{state.name}'"
            mend = "add a transition to it, or delete it"
            yield context.make_finding("D421", ("states", state.name), message, mend, is_key=True)


def find_dead_ends(context: RuleContext) -> Iterator[Finding]:
    """D422: a state that is reached, never left and not final; a design's only state is no trap."""
    design = context.design
    if len(design.states) - len(context.disabled_states) < 2:
        return
    targets = _targets(context)
    watched = _reachable_states(context, targets) if design.state(design.initial) else _state_names(context)
    for state in design.states:
        leaves = (targets[state.name] | targets[COMMON]) - {state.name}
        if not leaves and not (state.final or state.disabled) and state.name in watched:
            message = f"'{state.name}' is never left, and it is not final"
            mend = "add a transition, or mark it final: true"
            yield context.make_finding("D422", ("states", state.name), message, mend, is_key=True)


def _state_names(context: RuleContext) -> set[str]:
    return {state.name for state in context.design.states}


def _targets(context: RuleContext) -> dict[str, set[str]]:
    """Names that the working transitions of each working state lead to, known or not."""
    targets: dict[str, set[str]] = defaultdict(set)
    for located in context.decisions:
        decision = located.decision
        works = located.source not in context.disabled_states and not any(
            group.disabled for group, _is_then in located.groups
        )
        if works and isinstance(decision, Transition) and strip_disabled_decision(decision, context.disabled_states):
            targets[located.source].add(decision.to)
    return targets


def _reachable_states(context: RuleContext, targets: dict[str, set[str]]) -> set[str]:
    """States that may become active, the initial one with all that common transitions lead to."""
    waiting = [context.design.initial, *targets[COMMON]]
    reachable: set[str] = set()
    while waiting:
        name = waiting.pop()
        if name not in reachable:
            reachable.add(name)
            waiting += targets[name]
    return reachable


RULES = (
    find_no_states,
    find_no_initial_state,
    find_disabled_initial_state,
    find_unknown_states,
    find_unreachable_states,
    find_dead_ends,
)
