"""Fixes of decisions that are shadowed or have no effect."""

from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import DecisionGroup, Design, Stay, Transition
from vicode.model.edits import remove_decisions, replace_decision, update_state
from vicode.model.traversal import find_decision


def fix_shadowed_decision(case: FixContext) -> list[Fix]:
    """D423 for a decision, the `else` branch of a group, or all decisions of a state."""
    path = case.path
    if path[-1] == "else":
        return [Fix(label="Remove the else branch", edit=lambda old: _without_else(old, path[:-1]))]
    if path[-1] == "transitions":
        name = case.state_name()
        label = f"Remove the transitions of {name}"

        def remove_transitions(design: Design) -> Design:
            return update_state(design, name, lambda state: replace(state, transitions=()))

        return [Fix(label=label, edit=remove_transitions)]
    return [Fix(label="Remove the shadowed transition", edit=lambda old: remove_decisions(old, [path]))]


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


FIXERS = {"D423": fix_shadowed_decision, "D430": fix_no_effect}
