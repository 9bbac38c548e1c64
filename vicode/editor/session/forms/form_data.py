"""The forms of all items of a design, and what changes in them: what the browser needs to draw any of them at once."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from vicode.editor.session.forms.action_form import adders, parameter_hints
from vicode.editor.session.forms.construct_form import (
    construct_adders,
    construct_parts,
    derived_decision_form,
    derived_state_form,
    interrupt_ends,
)
from vicode.editor.session.forms.decision_form import decision_form
from vicode.editor.session.forms.declaration_form import declaration_adders
from vicode.editor.session.forms.design_form import design_form
from vicode.editor.session.forms.diagram_form import frame_form, note_form
from vicode.editor.session.forms.fields import FROM_VALUE
from vicode.editor.session.forms.form_paths import item_path
from vicode.editor.session.forms.interface_form import use_form
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import Node, form_json
from vicode.editor.session.forms.project_form import project_adders, project_parts
from vicode.editor.session.forms.state_form import common_form, state_form, uses_xabsl
from vicode.editor.session.gestures.item_paths import item_at
from vicode.editor.session.project.interface_edits import type_names
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import COMMON, CommonSection, Decision, Design, DiagramFrame, DiagramNote, State, Use
from vicode.model.project import Project
from vicode.model.traversal import LocatedDecision, find_decision, iter_decisions

_Owner = Design | State | CommonSection | DiagramFrame | DiagramNote | Use
Forms = dict[str, str]
"""The JSON of the form of each item, by "transitions/Kick/0"."""
FormLists = dict[str, Any]
"""What the forms of a design share: options of choices by `nodes.OptionList`, "parameters" and "adders"."""


@dataclass(eq=False)
class FormWriter:
    """Writes the forms of one design; forms of items that have not changed are kept."""

    _inputs: tuple[object, ...] = ()
    _decisions: dict[str, tuple[Decision, str]] = field(default_factory=dict)
    _owners: dict[str, tuple[tuple[object, ...], str]] = field(default_factory=dict)
    _design: tuple[object, str] | None = None
    _project: tuple[object, Forms] | None = None
    _lists: tuple[tuple[object, ...], FormLists] = ((), {})
    _written: tuple[Project, Design, Forms] | None = None

    def write(self, project: Project, design: Design, ids: ListIds) -> Forms:
        """The forms of all items, cached for all windows."""
        if self._written is None or self._written[0] is not project or self._written[1] is not design:
            self._written = (project, design, self._write(project, design, ids))
        return self._written[2]

    def _write(self, project: Project, design: Design, ids: ListIds) -> Forms:
        # All that forms depend on besides their item.
        inputs = (project.languages, design.time_unit, uses_xabsl(project, design))
        if inputs != self._inputs:
            self._inputs, self._decisions, self._owners, self._design = inputs, {}, {}, None
        return {
            **self._write_project(project, ids),
            **self._write_design(project, design, ids),
            **{key: form_json(nodes) for key, nodes in construct_parts(project, design, ids).items()},
            **self._write_owners(project, design, ids),
            **self._write_decisions(project, design, ids),
        }

    def _write_project(self, project: Project, ids: ListIds) -> Forms:
        project_ids = ids.of_project(project)
        inputs = (replace(project, designs=()), project_ids.snapshot())
        if self._project is None or self._project[0] != inputs:
            parts = project_parts(project, project_ids)
            self._project = (inputs, {key: form_json(nodes) for key, nodes in parts.items()})
        return self._project[1]

    def _write_design(self, project: Project, design: Design, ids: ListIds) -> Forms:
        counts = (len(design.common.transitions), len(design.common.actions))
        shown = replace(design, states=(), frames=(), notes=(), common=CommonSection())
        owners = ((), ("competence",), *(("outputs", at) for at in range(len(design.outputs))))
        lists = [ids.of_owner(path) for path in owners]
        interfaces = [project.interface(use.component) for use in design.uses]
        inputs = (shown, counts, lists, interfaces, self._project and self._project[0])
        if self._design is None or self._design[0] != inputs:
            self._design = (inputs, form_json(design_form(project, design, ids)))
        return {"design/": self._design[1]}

    def lists(self, project: Project, design: Design) -> FormLists:
        """What the forms share; the same object while nothing of it changes."""
        names = [state.name for state in design.states]
        known, lists = self._lists
        constructs = (design.interrupts, design.initial, design.competence, design.layers)
        inputs = (project, design.uses, design.variables, design.outputs, names, constructs)
        if not known or known[0] is not project or known[1:] != inputs[1:]:
            now = form_lists(project, design)
            lists = lists if now == lists else now
            self._lists = (inputs, lists)
        return lists

    def _write_owners(self, project: Project, design: Design, ids: ListIds) -> Forms:
        known, self._owners = self._owners, {}
        items: list[tuple[str, str, _Owner, DesignPath]] = [("common", COMMON, design.common, ("common",))]
        items += [("states", state.name, state, ("states", state.name)) for state in design.states]
        items += [("frames", frame.name, frame, ("frames", frame.name)) for frame in design.frames]
        items += [("components", use.alias, use, ("uses", use.alias)) for use in design.uses]
        items += [("notes", note.name, note, ("notes", note.name)) for note in design.notes]
        for kind, name, owner, path in items:
            key = f"{kind}/{name}"
            interface = project.interface(owner.component) if isinstance(owner, Use) else None
            inputs = (owner, kind == "states" and name == design.initial, ids.of_owner(path), interface)
            before = known.get(key)
            if before is None or before[0][0] is not owner or before[0][1:] != inputs[1:]:
                form = _owner_form(project, design, owner, ids)
                before = (inputs, form_json(form))
            self._owners[key] = before
        return {key: text for key, (_inputs, text) in self._owners.items()}

    def _write_decisions(self, project: Project, design: Design, ids: ListIds) -> Forms:
        known, self._decisions = self._decisions, {}
        for located in iter_decisions(design):
            key, decision = f"transitions/{transition_key(located.path)}", located.decision
            before = known.get(key)
            if before is not None and before[0] is decision:
                self._decisions[key] = before
            else:
                form = _decision_form(project, design, located, ids)
                self._decisions[key] = (decision, form_json(form))
        return {key: text for key, (_decision, text) in self._decisions.items()}


def item_form(project: Project, design: Design, item: ItemRef, ids: ListIds) -> tuple[Node, ...]:
    """The form of one item; empty if it has none."""
    match item:
        case ItemRef(kind="transitions", id=key):
            located = find_decision(design, parse_transition_key(key))
            return _decision_form(project, design, located, ids) if located else ()
        case _:
            path = item_path(item)
            owner = item_at(design, path) if path is not None else None
            return () if owner is None else _owner_form(project, design, owner, ids)


def _decision_form(project: Project, design: Design, located: LocatedDecision, ids: ListIds) -> tuple[Node, ...]:
    source, decision = located.source, located.decision
    return derived_decision_form(design, ids, source, decision) or decision_form(project, design, source, decision)


def _owner_form(project: Project, design: Design, owner: _Owner, ids: ListIds) -> tuple[Node, ...]:
    match owner:
        case Design():
            return design_form(project, owner, ids)
        case State():
            return derived_state_form(design, ids, owner) or state_form(project, design, owner, ids)
        case CommonSection():
            return common_form(project, design, ids)
        case Use():
            return use_form(project, owner, ids.of_project(project))
        case DiagramFrame():
            return frame_form(owner)
        case DiagramNote():
            return note_form(owner)


def has_form(design: Design, item: ItemRef) -> bool:
    """Whether the browser draws the form of an item."""
    if item.kind == "transitions":
        return find_decision(design, parse_transition_key(item.id)) is not None
    path = item_path(item)
    return path is not None and item_at(design, path) is not None


def form_lists(project: Project, design: Design) -> FormLists:
    """What the forms of a design share."""
    return {
        "states": [state.name for state in design.states],
        "ends": interrupt_ends(design),
        "uses": [use.alias for use in design.uses],
        "types": [FROM_VALUE, *type_names(project)],
        "arithmetic": ["xabsl"],
        "time_units": ["s", "ms"],
        "components": sorted(project.interfaces()),
        "unused": _unused_components(project, design),
        "parameters": parameter_hints(project, design),
        "adders": {
            **adders(project, design),
            **declaration_adders(),
            **project_adders(project),
            **construct_adders(project, design),
        },
    }


def _unused_components(project: Project, design: Design) -> list[str]:
    used = {use.component for use in design.uses} | {design.component}
    return sorted(name for name in project.interfaces() if name not in used)


def diff_forms(old: Mapping[str, Any], new: Mapping[str, Any]) -> dict[str, Any]:
    """The entries that changed; None for those that are gone."""
    changed: dict[str, Any] = {key: value for key, value in new.items() if old.get(key) != value}
    return {**changed, **dict.fromkeys(key for key in old if key not in new)}
