"""Rules about decisions: what is never tested, what changes nothing."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, Note
from vicode.model.design import Decision, DecisionGroup, Transition
from vicode.model.disabled import strip_disabled_decision
from vicode.model.traversal import is_exhaustive


def find_shadowed_transitions(context: RuleContext) -> Iterator[Finding]:
    """D423: decisions that are never tested because one before them always ends the decision."""
    design = context.design
    yield from _find_shadowed(context, design.common.transitions, ("common", "transitions"))
    ending = _first_exhaustive(context, design.common.transitions)
    for state in (state for state in design.states if not state.disabled):
        path = ("states", state.name, "transitions")
        if ending is None:
            yield from _find_shadowed(context, state.transitions, path)
        elif state.transitions:
            message = f"the transitions of '{state.name}' are never tested"
            note = Note(
                message="this common one always holds", subject=context.make_subject(("common", "transitions", ending))
            )
            yield context.make_finding("D423", path, message, "give the common one a guard", notes=[note])


def find_self_transitions(context: RuleContext) -> Iterator[Finding]:
    """D430: a transition from a state to itself."""
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to == located.source:
            message = f"'{decision.to}' is the state itself: this ends the decision and changes nothing"
            yield context.make_finding(
                "D430", (*located.path, "to"), message, "write stay: true, or choose another state"
            )


def _first_exhaustive(context: RuleContext, items: tuple[Decision, ...]) -> int | None:
    working = (strip_disabled_decision(item, context.disabled_states) for item in items)
    return next((index for index, item in enumerate(working) if item is not None and is_exhaustive(item)), None)


def _find_shadowed(context: RuleContext, items: tuple[Decision, ...], path: DesignPath) -> Iterator[Finding]:
    ending = _first_exhaustive(context, items)
    for index, item in enumerate(items):
        if strip_disabled_decision(item, context.disabled_states) is None:
            continue
        if ending is not None and index > ending:
            note = Note(message="this one always holds", subject=context.make_subject((*path, ending)))
            mend = "give the one before it a guard, or put it after this"
            yield context.make_finding("D423", (*path, index), "this is never tested", mend, notes=[note])
        elif isinstance(item, DecisionGroup):
            yield from _find_shadowed_in_group(context, item, (*path, index))


def _find_shadowed_in_group(context: RuleContext, group: DecisionGroup, path: DesignPath) -> Iterator[Finding]:
    yield from _find_shadowed(context, group.then, (*path, "then"))
    if group.guard.is_empty and group.otherwise:
        message = "'else' is never tested: the group has no guard"
        yield context.make_finding("D423", (*path, "else"), message, "give the group a guard, or delete its 'else'")
    else:
        yield from _find_shadowed(context, group.otherwise, (*path, "else"))


RULES = (find_shadowed_transitions, find_self_transitions)
