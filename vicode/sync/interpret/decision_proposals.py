"""Proposes edits of transitions and other decisions for changes of the methods that decide."""

import ast
from collections.abc import Iterator
from dataclasses import replace
from difflib import SequenceMatcher
from itertools import product

from vicode.model.design import DecisionGroup, Design, Guard, Stay, Transition
from vicode.model.edits import remove_decisions, replace_decision, update_decisions
from vicode.model.traversal import LocatedDecision
from vicode.sync.code_items import CODE, COMMENT, DOCSTRING, CodeItem, docstring_text
from vicode.sync.interpret.edit_context import CodeChange, EditContext, Place, method_name


def propose_decisions(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose changed, added and removed decisions."""
    place = context.place_of(change.item.scope)
    if place is None or place.phase not in ("", "decisions"):
        if method_name(change.item.scope).startswith("_when_"):
            yield from _predicate_docs(context, change)
        return
    if {item.kind for item in (*change.removed, *change.added)} == {COMMENT}:
        yield from _docs(context, place, change)
    elif change.removed and change.added:
        yield from _changed_guards(context, place, change)
        yield from _changed_outcomes(context, place, change)
        yield from _added_or_removed_guards(context, place, change)
    elif change.added:
        yield from _added_decisions(context, place, change.added)
    else:
        for located in context.decisions_in(place):
            yield remove_decisions(context.design, [located.path])


def _docs(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    doc = " ".join(item.code for item in change.added)
    old = " ".join(item.code for item in change.removed)
    for located in _sorted(context.decisions_in(place), old, lambda decision: " ".join(decision.doc.split())):
        yield replace_decision(context.design, located.path, replace(located.decision, doc=doc))


def _predicate_docs(context: EditContext, change: CodeChange) -> Iterator[Design]:
    """Propose docs of decisions with code: the docstrings of their methods."""
    if {item.kind for item in (*change.removed, *change.added)} != {DOCSTRING}:
        return
    doc = "\n".join(docstring_text(item) for item in change.added)
    for source in ("@common", *(state.name for state in context.design.states)):
        for located in context.decisions_in(Place(source=source, phase="")):
            if located.decision.guard.code is not None:
                yield replace_decision(context.design, located.path, replace(located.decision, doc=doc))


def _changed_guards(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    old, new = change.removed[0], change.added[0]
    if not isinstance(old.node, ast.If) or not isinstance(new.node, ast.If) or len(change.added) > 1:
        return
    was, now = (context.reader.read_guard(item.node.test) for item in (old, new) if isinstance(item.node, ast.If))
    shown = context.reader.read(was.when) if was.when is not None else ""
    for located in _sorted(context.decisions_in(place), shown, lambda decision: decision.guard.when):
        guard = located.decision.guard
        texts = context.reader.read_change(guard.when, was.when, now.when) if now.when is not None else [""]
        for when in texts:
            changed = now.as_guard(guard, when)
            after = guard.after if now.after == was.after else changed.after
            decision = replace(located.decision, guard=replace(changed, after=after))
            yield replace_decision(context.design, located.path, decision)


def _added_or_removed_guards(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    """Propose a guard for a decision that had none, or the reverse."""
    was, now = ([item.node for item in items if isinstance(item.node, ast.If)] for items in change.sides)
    guards = [Guard()] if len(was) > len(now) else []
    if len(now) > len(was):
        read = [context.reader.read_guard(node.test) for node in now]
        guards = [
            each.as_guard(Guard(), context.reader.read(each.when) if each.when is not None else "") for each in read
        ]
    for located in context.decisions_in(place):
        for guard in guards:
            if located.decision.guard.is_empty != guard.is_empty:
                yield replace_decision(context.design, located.path, replace(located.decision, guard=guard))


def _changed_outcomes(context: EditContext, place: Place, change: CodeChange) -> Iterator[Design]:
    """Propose another target of a transition, or a transition in place of a stay."""
    old, new = _outcome_of(change.removed[0]), _outcome_of(change.added[0])
    if old is None or new is None:
        return
    for located in context.decisions_in(place):
        decision = located.decision
        if isinstance(decision, DecisionGroup) or _shown_target(decision, place) != _shown_target(old, place):
            continue
        kept = replace(new, guard=decision.guard, doc=decision.doc, id=new.id or decision.id)
        yield replace_decision(context.design, located.path, kept)


def _shown_target(decision: Transition | Stay, place: Place) -> str:
    """Return the target in generated code, where a transition to the same state is a stay."""
    to = decision.to if isinstance(decision, Transition) else ""
    return "" if to == place.source else to


def _added_decisions(context: EditContext, place: Place, added: tuple[CodeItem, ...]) -> Iterator[Design]:
    """Propose a transition for a test with a change of the state."""
    tests = [item.node for item in added if item.code.startswith("if ") and item.code != "if decide:"]
    outcome = next((found for item in added if (found := _outcome_of(item))), None)
    if outcome is None:
        return
    test = tests[0] if tests else None
    doc = " ".join(item.code for item in added if item.kind == COMMENT)
    guards = [Guard()]
    if isinstance(test, ast.If):
        read = context.reader.read_guard(test.test)
        if read.has_code:
            return
        texts = context.reader.read_change("", None, read.when) if read.when is not None else [""]
        guards = [Guard(when=text, after=read.after) for text in texts]
    for path, length in context.decision_lists_in(place):
        for index, guard in product(range(length, -1, -1), guards):
            decision = replace(outcome, guard=guard, doc=doc)
            yield update_decisions(
                context.design,
                path,
                lambda items, at=index, new=decision: (*items[:at], new, *items[at:]),  # type: ignore[misc]
            )


def _outcome_of(item: CodeItem) -> Transition | Stay | None:
    if item.kind == CODE and item.code == "self._stay()":
        return Stay()
    target = _target_of(item)
    return Transition(to=target[0], id=target[1]) if target else None


def _target_of(item: CodeItem) -> tuple[str, str] | None:
    """Return the state and the id of a transition that an item makes."""
    match item.node:
        case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr="_change_to"), args=arguments)):
            texts = [node.value for node in arguments if isinstance(node, ast.Constant) and isinstance(node.value, str)]
            return (texts[0], texts[1] if len(texts) > 1 else "") if texts else None
        case _:
            return None


def _sorted(located: list[LocatedDecision], text: str, text_of: "object") -> list[LocatedDecision]:
    """Sort decisions so that those with a similar text come first."""
    assert callable(text_of)

    def difference(each: LocatedDecision) -> float:
        return -SequenceMatcher(None, str(text_of(each.decision)), text, autojunk=False).ratio()

    return sorted(located, key=difference)
