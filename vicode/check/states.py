"""Rules about the states as a graph: the initial one, ways that lead in, ways that lead out."""

from collections import defaultdict
from collections.abc import Iterator

from vicode.check.context import Context
from vicode.findings import Finding, did_you_mean
from vicode.model.design import COMMON, Transition
from vicode.model.enabling import enabled_decision


def find_no_states(context: Context) -> Iterator[Finding]:
    """D411: a design without states."""
    if not context.design.states:
        yield context.find("D411", (), "a design needs a state", "add 'states:' with at least one")


def find_no_initial_state(context: Context) -> Iterator[Finding]:
    """D401: no initial state, or one that does not exist."""
    design = context.design
    if not design.states or design.state(design.initial):
        return
    first = design.states[0].name
    if design.initial:
        mend = did_you_mean(design.initial, _names(context), f"write initial: {first}")
        yield context.find("D401", ("initial",), f"there is no state '{design.initial}'", mend)
    else:
        yield context.find("D401", (), "the initial state is not given", f"write initial: {first}")


def find_disabled_initial_state(context: Context) -> Iterator[Finding]:
    """D418: the component cannot begin in a state that is disabled."""
    initial = context.design.initial
    if initial in context.off:
        message = f"the initial state '{initial}' is disabled"
        yield context.find("D418", ("initial",), message, "choose another initial state, or enable it")


def find_unknown_states(context: Context) -> Iterator[Finding]:
    """D402: a transition to a state that does not exist."""
    names = _names(context)
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to not in names:
            mend = did_you_mean(decision.to, names, "add the state, or choose another")
            yield context.find("D402", (*located.path, "to"), f"there is no state '{decision.to}'", mend)


def find_unreachable_states(context: Context) -> Iterator[Finding]:
    """D421: a state that no way leads to from the initial one."""
    design = context.design
    if not design.state(design.initial) or design.initial in context.off:
        return
    reachable = _reachable(context, _targets(context))
    for state in design.states:
        if state.name not in reachable and not state.disabled:
            message = f"no way leads from '{design.initial}' to '{state.name}'"
            mend = "add a transition to it, or delete it"
            yield context.find("D421", ("states", state.name), message, mend, of_key=True)


def find_traps(context: Context) -> Iterator[Finding]:
    """D422: a state that is reached, never left and not final; a design's only state is no trap."""
    design = context.design
    if len(design.states) - len(context.off) < 2:
        return
    targets = _targets(context)
    watched = _reachable(context, targets) if design.state(design.initial) else _names(context)
    for state in design.states:
        leaves = (targets[state.name] | targets[COMMON]) - {state.name}
        if not leaves and not (state.final or state.disabled) and state.name in watched:
            message = f"'{state.name}' is never left, and it is not final"
            mend = "add a transition, or mark it final: true"
            yield context.find("D422", ("states", state.name), message, mend, of_key=True)


def _names(context: Context) -> set[str]:
    return {state.name for state in context.design.states}


def _targets(context: Context) -> dict[str, set[str]]:
    """Names that the working transitions of each working state lead to, known or not."""
    targets: dict[str, set[str]] = defaultdict(set)
    for located in context.decisions:
        decision = located.decision
        works = located.source not in context.off and not any(group.disabled for group, _is_then in located.groups)
        if works and isinstance(decision, Transition) and enabled_decision(decision, context.off):
            targets[located.source].add(decision.to)
    return targets


def _reachable(context: Context, targets: dict[str, set[str]]) -> set[str]:
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
    find_traps,
)
