"""Rules for decisions: transitions that are never taken, guards that always hold, transitions without effect."""

from collections.abc import Iterator

from vicode.analysis.guards import Basis, ProvedDecision, Verdict
from vicode.check.context import RuleContext
from vicode.check.identifiers_in_text import find_identifiers
from vicode.findings import DesignPath, Finding, Note
from vicode.model.design import DecisionGroup, Guard, Transition
from vicode.model.traversal import find_decision

_ALWAYS = "this decision always holds"
_MOVE = "move it before the earlier ones, or delete it"


def find_dead_decisions(context: RuleContext) -> Iterator[Finding]:
    """D423, D433, D434: decisions that are never tested or taken, and guards that always hold."""
    guards = context.machine.guards
    hidden = {name for name, listed in guards.states.items() if listed and not guards.is_possible(listed[0].reached)}
    for name in hidden:
        yield _report_hidden_state(context, name)
    for proved in guards.find_verdicts():
        if proved.path[0] != "states" or proved.path[1] not in hidden:
            yield from _report(context, proved)


def _report_hidden_state(context: RuleContext, name: str) -> Finding:
    """Common transitions precede those of the state."""
    path: DesignPath = ("states", name, "transitions")
    proved = next(context.machine.guards.judge_state(name))
    message = f"the transitions of '{name}' are never tested{_because(proved.basis)}"
    notes = _notes(context, proved.earlier, "this common transition always holds")
    return context.make_finding("D423", path, message, "add a guard to the common transition", notes=notes)


def _report(context: RuleContext, proved: ProvedDecision) -> Iterator[Finding]:
    path, because = proved.path, _because(proved.basis)
    match proved.verdict:
        case Verdict.NEVER_HOLDS:
            fix = "change the guard, or delete the decision"
            yield context.make_finding("D433", _guard_path(context, path), f"this guard never holds{because}", fix)
        case Verdict.ALWAYS_HOLDS:
            located = find_decision(context.design, path)
            if located is not None and _reads_values(located.decision.guard):
                message, fix = f"this guard always holds{because}", "change the guard, or remove it"
                yield context.make_finding("D434", _guard_path(context, path), message, fix)
        case Verdict.NEVER_TESTED if path[-1] == "else":
            yield _report_branch(context, proved)
        case Verdict.NEVER_TESTED:
            is_one = len(proved.earlier) == 1
            notes = _notes(context, proved.earlier, _ALWAYS if is_one else "one of these decisions always holds")
            fix = "add a guard to the earlier decision, or move it after this one" if is_one else _MOVE
            yield context.make_finding("D423", path, f"this decision is never tested{because}", fix, notes=notes)
        case Verdict.SHADOWED:
            which = "an earlier one" if len(proved.earlier) == 1 else "one of the earlier ones"
            message = f"this decision is never taken: whenever its guard holds, {which} does{because}"
            notes = _notes(context, proved.earlier, "this decision is taken instead")
            located = find_decision(context.design, path)
            is_group = located is not None and isinstance(located.decision, DecisionGroup)
            where = _guard_path(context, path) if is_group else path
            yield context.make_finding("D423", where, message, _MOVE, notes=notes)


def _report_branch(context: RuleContext, proved: ProvedDecision) -> Finding:
    located = find_decision(context.design, proved.path[:-1])
    is_empty = located is None or located.decision.guard.is_empty
    reason = "the group has no guard" if is_empty else f"the guard always holds{_because(proved.basis)}"
    fix = f"{'add a guard to' if is_empty else 'change the guard of'} the group, or delete its 'else'"
    return context.make_finding("D423", proved.path, f"'else' is never tested: {reason}", fix)


def _guard_path(context: RuleContext, path: DesignPath) -> DesignPath:
    """The path of the guard of a decision, or of the decision if it has none."""
    located = find_decision(context.design, path)
    guard = located.decision.guard if located else Guard()
    return (*path, "when") if guard.when else (*path, "after") if guard.after else path


def _reads_values(guard: Guard) -> bool:
    """Whether a guard that always holds is more than a literal such as True."""
    names = find_identifiers(f"{guard.when} {guard.after}")
    return bool(set(names) - {"True", "False", "true", "false", "and", "or", "not"})


def _notes(context: RuleContext, earlier: tuple[DesignPath, ...], message: str) -> list[Note]:
    return [Note(message=message, subject=context.make_subject(path)) for path in earlier]


def _because(basis: Basis) -> str:
    """What a proof rests on, as the end of a message."""
    facts = [*basis.facts, *(["no value is nan"] if basis.no_nan else [])]
    return f" ({', '.join(facts)})" if facts else ""


def find_self_transitions(context: RuleContext) -> Iterator[Finding]:
    """D430: a transition from a state to itself."""
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to == located.source:
            message = f"this transition leads from '{decision.to}' to itself and has no effect"
            yield context.make_finding(
                "D430", (*located.path, "to"), message, "replace 'to' with stay: true, or choose another target"
            )


WARNINGS = (find_dead_decisions, find_self_transitions)
