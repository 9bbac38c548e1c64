"""Fixes of decisions that are never taken or have no effect."""

from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Design, Guard, Stay, Transition
from vicode.model.edits import remove_decisions, replace_decision, update_state
from vicode.model.traversal import find_decision


def fix_dead_decision(case: FixContext) -> list[Fix]:
    """D423 and D433 for a decision, the `else` of a group, or all decisions of a state.

    There is none for the guard of a group.
    """
    path = _decision_path(case.path)
    located = find_decision(case.design, path)
    if path != case.path and located is not None and isinstance(located.decision, DecisionGroup):
        return []
    if path[-1] == "else":
        return [Fix(label="Remove the else branch", edit=lambda old: _without_else(old, path[:-1]))]
    if path[-1] == "transitions":
        name = case.state_name()
        label = f"Remove the transitions of {name}"

        def remove_transitions(design: Design) -> Design:
            return update_state(design, name, lambda state: replace(state, transitions=()))

        return [Fix(label=label, edit=remove_transitions)]
    return [Fix(label="Remove the transition", edit=lambda old: remove_decisions(old, [path]))]


def fix_needless_guard(case: FixContext) -> list[Fix]:
    path = _decision_path(case.path)

    def remove_guard(design: Design) -> Design:
        located = find_decision(design, path)
        return replace_decision(design, path, replace(located.decision, guard=Guard())) if located else design

    return [Fix(label="Remove the guard", edit=remove_guard)]


def _decision_path(path: DesignPath) -> DesignPath:
    """The path of a decision from that of its guard."""
    return path[:-1] if path[-1] in ("when", "after") else path


def fix_no_effect(case: FixContext) -> list[Fix]:
    located = case.decision()
    if located is None or not isinstance(located.decision, Transition):
        return []
    path, old = located.path, located.decision
    stay = Stay(guard=old.guard, doc=old.doc, id=old.id)
    return [
        Fix(label="Replace it with a stay", edit=lambda design: replace_decision(design, path, stay)),
        Fix(label="Remove the transition", edit=lambda design: remove_decisions(design, [path])),
    ]


def _without_else(design: Design, path: DesignPath) -> Design:
    located = find_decision(design, path)
    if located is None or not isinstance(located.decision, DecisionGroup):
        return design
    return replace_decision(design, path, replace(located.decision, otherwise=()))


FIXERS = {"D423": fix_dead_decision, "D433": fix_dead_decision, "D430": fix_no_effect, "D434": fix_needless_guard}
