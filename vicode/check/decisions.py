"""Rules for decisions: shadowed transitions and transitions without effect."""

from collections.abc import Iterator
from dataclasses import replace

from vicode.check.context import RuleContext
from vicode.check.typed_expressions import analyze_expression
from vicode.findings import DesignPath, Finding, Note
from vicode.model.design import Decision, DecisionGroup, Guard, Transition
from vicode.model.disabled import strip_disabled_decision
from vicode.model.expressions import BOOL, FLOAT, Value, evaluate
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
    return next(
        (
            index
            for index, item in enumerate(enabled)
            if item is not None and is_exhaustive(_strip_true_guards(context, item))
        ),
        None,
    )


def _strip_true_guards(context: RuleContext, item: Decision) -> Decision:
    """Remove the guards that always hold, such as `after: 0`."""
    if isinstance(item, DecisionGroup):
        then, otherwise = (
            tuple(_strip_true_guards(context, each) for each in items) for items in (item.then, item.otherwise)
        )
        item = replace(item, then=then, otherwise=otherwise)
    return replace(item, guard=Guard()) if _always_holds(context, item.guard) else item


def _always_holds(context: RuleContext, guard: Guard) -> bool:
    """Whether a guard holds whatever the values are. Constants count as unknown: viewers of a robot can change them."""
    is_when_true = not guard.when or _evaluate(context, guard.when, BOOL) is True
    is_after_zero = not guard.after or _evaluate(context, guard.after, FLOAT) == 0
    return guard.code is None and is_when_true and is_after_zero


def _evaluate(context: RuleContext, text: str, type_: str) -> Value | None:
    parsed = analyze_expression(text, context.scope, type_)
    return None if parsed.tree is None or parsed.diagnostics else evaluate(parsed.tree, {})


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
    if _always_holds(context, group.guard) and group.otherwise:
        is_empty = group.guard.is_empty
        message = f"'else' is never tested: {'the group has no guard' if is_empty else 'the guard always holds'}"
        fix = f"{'add a guard to' if is_empty else 'change the guard of'} the group, or delete its 'else'"
        yield context.make_finding("D423", (*path, "else"), message, fix)
    else:
        yield from _find_shadowed(context, group.otherwise, (*path, "else"))


RULES = (find_shadowed_transitions, find_self_transitions)
