"""Rules about decisions: what is never tested, what changes nothing."""

from collections.abc import Iterator

from vicode.check.context import Context
from vicode.findings import Finding, Note, Path
from vicode.model.design import Decision, Group, Transition
from vicode.model.enabling import enabled_decision
from vicode.model.walks import always_holds


def find_dead_decisions(context: Context) -> Iterator[Finding]:
    """D423: decisions that are never tested because one before them always ends the decision."""
    design = context.design
    yield from _find_dead(context, design.common.transitions, ("common", "transitions"))
    ending = _first_ending(context, design.common.transitions)
    for state in (state for state in design.states if not state.disabled):
        path = ("states", state.name, "transitions")
        if ending is None:
            yield from _find_dead(context, state.transitions, path)
        elif state.transitions:
            message = f"the transitions of '{state.name}' are never tested"
            note = Note(message="this common one always holds", thing=context.thing(("common", "transitions", ending)))
            yield context.find("D423", path, message, "give the common one a guard", notes=[note])


def find_no_effect(context: Context) -> Iterator[Finding]:
    """D430: a transition from a state to itself."""
    for located in context.decisions:
        decision = located.decision
        if isinstance(decision, Transition) and decision.to == located.source:
            message = f"'{decision.to}' is the state itself: this ends the decision and changes nothing"
            yield context.find("D430", (*located.path, "to"), message, "write stay: true, or choose another state")


def _first_ending(context: Context, items: tuple[Decision, ...]) -> int | None:
    working = (enabled_decision(item, context.off) for item in items)
    return next((index for index, item in enumerate(working) if item is not None and always_holds(item)), None)


def _find_dead(context: Context, items: tuple[Decision, ...], path: Path) -> Iterator[Finding]:
    ending = _first_ending(context, items)
    for index, item in enumerate(items):
        if enabled_decision(item, context.off) is None:
            continue
        if ending is not None and index > ending:
            note = Note(message="this one always holds", thing=context.thing((*path, ending)))
            mend = "give the one before it a guard, or put it after this"
            yield context.find("D423", (*path, index), "this is never tested", mend, notes=[note])
        elif isinstance(item, Group):
            yield from _find_dead_in_group(context, item, (*path, index))


def _find_dead_in_group(context: Context, group: Group, path: Path) -> Iterator[Finding]:
    yield from _find_dead(context, group.then, (*path, "then"))
    if group.guard.is_empty and group.otherwise:
        message = "'else' is never tested: the group has no guard"
        yield context.find("D423", (*path, "else"), message, "give the group a guard, or delete its 'else'")
    else:
        yield from _find_dead(context, group.otherwise, (*path, "else"))


RULES = (find_dead_decisions, find_no_effect)
