"""Rules for decisions: shadowed transitions and transitions without effect."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import DesignPath, Finding, Note
from vicode.model.design import Decision, DecisionGroup, Transition
from vicode.model.disabled import strip_disabled_decision
from vicode.model.traversal import is_exhaustive


def find_shadowed_transitions(context: RuleContext) -> Iterator[Finding]:
    """D423: decisions that are never tested because an earlier one always holds."""
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
                message="this common transition always holds",
                subject=context.make_subject(("common", "transitions", ending)),
            )
            yield context.make_finding("D423", path, message, "add a guard to the common transition", notes=[note])


def find_self_transitions(context: RuleContext) -> Iterator[Finding]:
    """D430: a transition from a state to itself."""
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to == located.source:
            message = f"this transition leads from '{decision.to}' to itself and has no effect"
            yield context.make_finding(
                "D430", (*located.path, "to"), message, "replace 'to' with stay: true, or choose another target"
            )


def _first_exhaustive(context: RuleContext, items: tuple[Decision, ...]) -> int | None:
    enabled = (strip_disabled_decision(item, context.disabled_states) for item in items)
    return next((index for index, item in enumerate(enabled) if item is not None and is_exhaustive(item)), None)


def _find_shadowed(context: RuleContext, items: tuple[Decision, ...], path: DesignPath) -> Iterator[Finding]:
    ending = _first_exhaustive(context, items)
    for index, item in enumerate(items):
        if strip_disabled_decision(item, context.disabled_states) is None:
            continue
        if ending is not None and index > ending:
            note = Note(message="this decision always holds", subject=context.make_subject((*path, ending)))
            fix = "add a guard to the earlier decision, or move it after this one"
            yield context.make_finding("D423", (*path, index), "this decision is never tested", fix, notes=[note])
        elif isinstance(item, DecisionGroup):
            yield from _find_shadowed_in_group(context, item, (*path, index))


def _find_shadowed_in_group(context: RuleContext, group: DecisionGroup, path: DesignPath) -> Iterator[Finding]:
    yield from _find_shadowed(context, group.then, (*path, "then"))
    if group.guard.is_empty and group.otherwise:
        message = "'else' is never tested: the group has no guard"
        yield context.make_finding("D423", (*path, "else"), message, "add a guard to the group, or delete its 'else'")
    else:
        yield from _find_shadowed(context, group.otherwise, (*path, "else"))


RULES = (find_shadowed_transitions, find_self_transitions)
