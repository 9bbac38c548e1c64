"""Rules for the state graph: initial state, unreachable states, dead ends."""

from collections import defaultdict
from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, did_you_mean
from vicode.model.design import COMMON, STATE_KEYS, Transition
from vicode.model.disabled import strip_disabled_decision


def find_no_states(context: RuleContext) -> Iterator[Finding]:
    """D411: a design without states."""
    if not context.design.states:
        yield context.make_finding("D411", (), "the design has no states", "add 'states:' with at least one state")


def find_no_initial_state(context: RuleContext) -> Iterator[Finding]:
    """D401: no initial state, or one that does not exist."""
    design = context.design
    if not design.states or design.state(design.initial):
        return
    first = design.states[0].name
    if design.initial:
        fix = did_you_mean(design.initial, _state_names(context), f"add initial: {first}")
        yield context.make_finding("D401", ("initial",), f"unknown state '{design.initial}'", fix)
    else:
        yield context.make_finding("D401", (), "the initial state is missing", f"add initial: {first}")


def find_disabled_initial_state(context: RuleContext) -> Iterator[Finding]:
    """D418: a disabled initial state."""
    initial = context.design.initial
    if initial in context.disabled_states:
        message = f"the initial state '{initial}' is disabled"
        yield context.make_finding("D418", ("initial",), message, "enable it, or choose another initial state")


def find_unknown_states(context: RuleContext) -> Iterator[Finding]:
    """D402: a transition to a state that does not exist."""
    names = _state_names(context)
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to not in names:
            fix = did_you_mean(decision.to, names, "add the state, or choose another target")
            yield context.make_finding("D402", (*located.path, "to"), f"unknown state '{decision.to}'", fix)


def find_bad_frames(context: RuleContext) -> Iterator[Finding]:
    """D431: a frame without states, or around a state that does not exist."""
    names = _state_names(context)
    for frame in context.design.frames:
        path: DesignPath = ("frames", frame.name)
        if not frame.states:
            message, fix = f"the frame '{frame.name}' has no states", "add states to it, or delete it"
            yield context.make_finding("D431", path, message, fix, is_key=True)
        for index, name in enumerate(frame.states):
            if name not in names:
                fix = did_you_mean(name, names, "remove it from the frame, or add the state")
                yield context.make_finding("D431", (*path, "states", index), f"unknown state '{name}'", fix)


def find_bad_properties(context: RuleContext) -> Iterator[Finding]:
    """D440: a property of a state that does not exist."""
    names = _state_names(context)
    for index, promised in enumerate(context.design.properties):
        for key in STATE_KEYS:
            name = getattr(promised, key, "")
            if name and name not in names:
                fix = did_you_mean(name, names, "add the state, or delete the property")
                yield context.make_finding("D440", ("properties", index, key), f"unknown state '{name}'", fix)


def find_unreachable_states(context: RuleContext) -> Iterator[Finding]:
    """D421: a state that is unreachable from the initial state."""
    design = context.design
    if not design.state(design.initial) or design.initial in context.disabled_states:
        return
    targets = _targets(context)
    drawn = _reachable_states(context, targets)
    for state in design.states:
        if state.name not in context.machine.reachable and not state.disabled:
            message = f"'{state.name}' is unreachable from the initial state '{design.initial}'"
            if state.name in drawn:
                message = f"{message}: no transition on the way to it can be taken"
            fix = "add a transition to it, or delete it"
            yield context.make_finding("D421", ("states", state.name), message, fix, is_key=True)


def find_dead_ends(context: RuleContext) -> Iterator[Finding]:
    """D422: a reachable state without exit that is not final. The only state of a design is exempt."""
    design = context.design
    if len(design.states) - len(context.disabled_states) < 2:
        return
    machine = context.machine
    candidates = machine.reachable if design.state(design.initial) else _state_names(context)
    targets = _targets(context)
    for state in design.states:
        if machine.live.get(state.name) or state.final or state.disabled or state.name not in candidates:
            continue
        has_exits = bool((targets[state.name] | targets[COMMON]) - {state.name})
        reason = "none of its transitions can be taken" if has_exits else "it has no transition to another state"
        message = f"'{state.name}' is a dead end: {reason} and {'it ' if has_exits else ''}is not final"
        fix = "add a transition, or set final: true"
        yield context.make_finding("D422", ("states", state.name), message, fix, is_key=True)


def _state_names(context: RuleContext) -> set[str]:
    return {state.name for state in context.design.states}


def _targets(context: RuleContext) -> dict[str, set[str]]:
    """Return the targets of the enabled transitions of each enabled state, including unknown names."""
    targets: dict[str, set[str]] = defaultdict(set)
    for located in context.decisions:
        decision = located.decision
        is_enabled = located.source not in context.disabled_states and not any(
            group.disabled for group, _is_then in located.groups
        )
        if (
            is_enabled
            and isinstance(decision, Transition)
            and strip_disabled_decision(decision, context.disabled_states)
        ):
            targets[located.source].add(decision.to)
    return targets


def _reachable_states(context: RuleContext, targets: dict[str, set[str]]) -> set[str]:
    """Return the states reachable from the initial state and from targets of common transitions."""
    pending = [context.design.initial, *targets[COMMON]]
    reachable: set[str] = set()
    while pending:
        name = pending.pop()
        if name not in reachable:
            reachable.add(name)
            pending += targets[name]
    return reachable


RULES = (
    find_no_states,
    find_no_initial_state,
    find_disabled_initial_state,
    find_unknown_states,
    find_bad_properties,
)
WARNINGS = (find_bad_frames, find_unreachable_states, find_dead_ends)
