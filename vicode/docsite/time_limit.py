"""How long a state lasts at most."""

import re

from vicode.model.design import Decision, DecisionGroup, Guard, State, Stay
from vicode.model.traversal import is_exhaustive

_ELAPSED = re.compile(r"\(?state_time >=? ([\w.]+)\)?")


def find_time_limit(state: State) -> str:
    """The time after which a state is always left, as an expression; "" if there is none or it is not evident.

    That is the first transition with only a timer, unless an earlier decision can keep the state active.
    """
    for decision in state.transitions:
        if decision.disabled:
            continue
        if _may_stay(decision, state.name):
            return ""
        time = _timer(decision.guard)
        if time and (not isinstance(decision, DecisionGroup) or any(map(is_exhaustive, decision.then))):
            return time
    return ""


def _timer(guard: Guard) -> str:
    """The time if the guard has no other condition."""
    if guard.code is not None or (guard.when and guard.after):
        return ""
    found = _ELAPSED.fullmatch(guard.when)
    return found[1] if found else "" if guard.when else guard.after


def _may_stay(decision: Decision, state: str) -> bool:
    if isinstance(decision, DecisionGroup):
        return any(_may_stay(each, state) for each in (*decision.then, *decision.otherwise))
    return isinstance(decision, Stay) or decision.to == state
