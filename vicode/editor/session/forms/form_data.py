"""The forms of all items of a design, and what changes in them: what the browser needs to draw any of them at once."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from vicode.editor.session.forms.decision_form import decision_form
from vicode.editor.session.forms.nodes import Node, form_json
from vicode.editor.view import ItemRef
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import Decision, Design
from vicode.model.project import Project
from vicode.model.traversal import find_decision, iter_decisions

Forms = dict[str, str]
"""The JSON of the form of each item, by "transitions/Kick/0"."""


@dataclass(eq=False)
class FormWriter:
    """Writes the forms of one design; forms of items that have not changed are kept."""

    _inputs: tuple[object, ...] = ()
    _decisions: dict[str, tuple[Decision, str]] = field(default_factory=dict)

    def write(self, project: Project, design: Design) -> Forms:
        # All that forms depend on besides their item.
        inputs = (project.languages, design.time_unit)
        if inputs != self._inputs:
            self._inputs, self._decisions = inputs, {}
        known, self._decisions = self._decisions, {}
        for located in iter_decisions(design):
            key, decision = f"transitions/{transition_key(located.path)}", located.decision
            before = known.get(key)
            if before is not None and before[0] is decision:
                self._decisions[key] = before
            else:
                form = decision_form(project, design, located.source, decision)
                self._decisions[key] = (decision, form_json(form))
        return {key: text for key, (_decision, text) in self._decisions.items()}


def item_form(project: Project, design: Design, item: ItemRef) -> tuple[Node, ...]:
    """The form of one item; empty if it has none."""
    if item.kind == "transitions":
        located = find_decision(design, parse_transition_key(item.id))
        return decision_form(project, design, located.source, located.decision) if located else ()
    return ()


def has_form(design: Design, item: ItemRef) -> bool:
    """Whether the browser draws the form of an item."""
    return item.kind == "transitions" and find_decision(design, parse_transition_key(item.id)) is not None


def option_lists(design: Design) -> dict[str, list[str]]:
    """The options of the choices, by their names (see `nodes.OptionList`)."""
    return {"states": [state.name for state in design.states], "uses": [use.alias for use in design.uses]}


def diff_forms(old: Mapping[str, Any], new: Mapping[str, Any]) -> dict[str, Any]:
    """The entries that changed; None for those that are gone."""
    changed: dict[str, Any] = {key: value for key, value in new.items() if old.get(key) != value}
    return {**changed, **dict.fromkeys(key for key in old if key not in new)}
