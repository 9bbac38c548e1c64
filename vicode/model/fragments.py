"""Extraction of part of a design as a separate design, and insertion into another design."""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.decisions import drop_targets, retarget_all
from vicode.model.design import (
    Action,
    CommonSection,
    Decision,
    DecisionGroup,
    Design,
    DiagramFrame,
    DiagramNote,
    Point,
    RunCode,
    State,
    Transition,
    Use,
)
from vicode.model.edits import add_state, rename_use, unique_name, update_decisions
from vicode.model.rename import ReferenceKind, ReferenceRename, rename_alias, rename_in_design
from vicode.model.traversal import find_decision, iter_actions, iter_decisions, iter_transitions

_SECTIONS = ("parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class FragmentSelection:
    """The part of a design to extract: names of states, frames and notes, decision paths, aliases, and the common
    section.
    """

    states: Collection[str] = ()
    decisions: Collection[DesignPath] = ()
    aliases: Collection[str] = ()
    frames: Collection[str] = ()
    notes: Collection[str] = ()
    common: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertResult:
    """A design with an inserted fragment, the new names of its states, frames and notes, and unavailable components.

    `added` are the declarations and components that the fragment needs: their kind and name, such as "variable tries".
    """

    design: Design
    states: tuple[str, ...] = ()
    frames: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    added: tuple[str, ...] = ()


def extract_fragment(design: Design, selection: FragmentSelection) -> Design:
    """Extract states with the components and declarations that they refer to, frames around these states, and notes.

    Without states, the selected decisions are extracted as common transitions.
    """
    states = tuple(state for state in design.states if state.name in selection.states)
    common = design.common if selection.common else CommonSection()
    if not states and not selection.common:
        located = (find_decision(design, path) for path in selection.decisions)
        common = CommonSection(transitions=tuple(item.decision for item in located if item is not None))
    part = Design(component=design.component, common=common, states=states)
    uses = tuple(use for use in design.uses if use.alias in selection.aliases or references_alias(part, use.alias))
    frames = _frames_around([frame for frame in design.frames if frame.name in selection.frames], states)
    notes = tuple(note for note in design.notes if note.name in selection.notes)
    return _with_declarations(design, replace(part, uses=uses, frames=frames, notes=notes))


def insert_fragment(
    design: Design, fragment: Design, *, available: Collection[str], offset: Point = (0, 0)
) -> InsertResult:
    """Insert a fragment into a design. Names are made unique, and transitions to missing states are dropped.

    Args:
        design: The target design.
        fragment: The result of `extract_fragment`, from any design.
        available: The components that the design can use. References to other components are kept.
        offset: The displacement of all positions in pixels.
    """
    before = design
    design, fragment, missing = _insert_uses(design, fragment, available, offset)
    design = _insert_declarations(design, fragment)
    fragment = _with_unique_names(design, fragment)
    lost = _dangling_targets(design, fragment)
    taken = _used_ids(design)
    for state in fragment.states:
        kept = replace(state, at=_translated(state.at, offset), transitions=drop_targets(state.transitions, lost))
        design = add_state(design, _with_unique_ids(kept, taken))
    common = drop_targets(fragment.common.transitions, lost)
    new = tuple(item for item in _decisions_with_unique_ids(common, taken) if item not in design.common.transitions)
    design = update_decisions(design, ("common", "transitions"), lambda items: (*items, *new))
    actions = (
        *design.common.actions,
        *(action for action in fragment.common.actions if action not in design.common.actions),
    )
    design = replace(design, common=replace(design.common, actions=actions, at=design.common.at or fragment.common.at))
    frames, notes = _unique_frames(design, fragment), _unique_notes(design, fragment, offset)
    return InsertResult(
        design=replace(design, frames=(*design.frames, *frames), notes=(*design.notes, *notes)),
        states=tuple(state.name for state in fragment.states),
        frames=tuple(frame.name for frame in frames),
        notes=tuple(note.name for note in notes),
        missing=missing,
        added=_added(before, design),
    )


def append_decisions(
    design: Design, fragment: Design, state_names: Iterable[str], *, available: Collection[str]
) -> InsertResult:
    """Append the common transitions of a fragment to states."""
    before = design
    design, fragment, missing = _insert_uses(design, fragment, available, (0, 0))
    design = _insert_declarations(design, fragment)
    lost = _dangling_targets(design, fragment)
    taken = _used_ids(design)
    for name in state_names:
        items = _decisions_with_unique_ids(drop_targets(fragment.common.transitions, lost), taken)
        where: DesignPath = ("states", name, "transitions")
        design = update_decisions(design, where, lambda old, items=items: (*old, *items))  # type: ignore[misc]
    return InsertResult(design=design, missing=missing, added=_added(before, design))


def duplicate_decision(design: Design, path: DesignPath) -> Design:
    """Insert a copy of a decision after it."""
    located = find_decision(design, path)
    if located is None:
        return design
    index = int(path[-1])
    (twin,) = _decisions_with_unique_ids((located.decision,), _used_ids(design))
    return update_decisions(design, path[:-1], lambda items: (*items[: index + 1], twin, *items[index + 1 :]))


def references_alias(part: Design, alias: str) -> bool:
    return rename_alias(part, alias, f"{alias}_") != part


def references_name(part: Design, name: str) -> bool:
    rename = ReferenceRename(kind=ReferenceKind.OWN, old=name, new=f"{name}_")
    return rename_in_design(part, rename) != part


def _with_declarations(design: Design, part: Design) -> Design:
    """The part with the declarations that it refers to, and those to which these refer."""
    needed = [each for _section, each in design.declarations() if references_name(part, each.name)]
    found: dict[str, Any] = {
        name: tuple(each for each in getattr(design, name) if each in needed) for name in _SECTIONS
    }
    grown = replace(part, **found)
    return part if grown == part else _with_declarations(design, grown)


def _insert_declarations(design: Design, part: Design) -> Design:
    """Add the declarations of the part; a name that the design has keeps its meaning."""
    known = {each.name for _section, each in design.declarations()} | {use.alias for use in design.uses}
    grown: dict[str, Any] = {
        name: (*getattr(design, name), *(each for each in getattr(part, name) if each.name not in known))
        for name in _SECTIONS
    }
    return replace(design, **grown)


def _added(before: Design, after: Design) -> tuple[str, ...]:
    uses = [f"component {use.alias}" for use in after.uses if use not in before.uses]
    known = list(before.declarations())
    names = [
        f"{section.removesuffix('s')} {each.name}"
        for section, each in after.declarations()
        if (section, each) not in known
    ]
    return (*uses, *names)


def _insert_uses(
    design: Design, part: Design, available: Collection[str], offset: Point
) -> tuple[Design, Design, tuple[str, ...]]:
    missing = []
    for use in part.uses:
        existing = design.use(use.alias)
        if existing is not None and existing.component == use.component:
            continue
        alias = unique_name(use.alias, {other.alias for other in (*design.uses, *part.uses)} if existing else ())
        part = rename_use(part, use.alias, alias)
        if use.component in available:
            new = Use(alias=alias, component=use.component, at=_translated(use.at, offset))
            design = replace(design, uses=(*design.uses, new))
        else:
            missing.append(use.component)
    return design, part, tuple(missing)


def _frames_around(frames: Iterable[DiagramFrame], states: Iterable[State]) -> tuple[DiagramFrame, ...]:
    """The frames without other states than these; none that would be empty."""
    known = {state.name for state in states}
    parts = (replace(frame, states=tuple(name for name in frame.states if name in known)) for frame in frames)
    return tuple(part for part in parts if part.states)


def _unique_frames(design: Design, part: Design) -> list[DiagramFrame]:
    taken = {frame.name for frame in design.frames}
    frames = []
    for frame in _frames_around(part.frames, part.states):
        frames.append(replace(frame, name=unique_name(frame.name, taken)))
        taken.add(frames[-1].name)
    return frames


def _unique_notes(design: Design, part: Design, offset: Point) -> list[DiagramNote]:
    taken = {note.name for note in design.notes}
    notes = []
    for note in part.notes:
        notes.append(replace(note, name=unique_name(note.name, taken), at=_translated(note.at, offset)))
        taken.add(notes[-1].name)
    return notes


def _with_unique_names(design: Design, part: Design) -> Design:
    """Rename states whose names are taken. A number at the end of a name is incremented."""
    taken = {state.name for state in design.states} | {state.id for state in design.states}
    unavailable = taken | {state.name for state in part.states}
    names: dict[str, str] = {}
    for state in part.states:
        if state.name in taken:
            stem = re.sub(r"\d+\Z", "", state.name) or state.name
            names[state.name] = _numbered_name(stem, unavailable)
            unavailable.add(names[state.name])
    states = (
        replace(state, name=names.get(state.name, state.name), transitions=retarget_all(state.transitions, names))
        for state in part.states
    )
    common = replace(part.common, transitions=retarget_all(part.common.transitions, names))
    frames = tuple(
        replace(frame, states=tuple(names.get(name, name) for name in frame.states)) for frame in part.frames
    )
    return replace(part, states=tuple(states), common=common, frames=frames)


def _numbered_name(stem: str, taken: Collection[str]) -> str:
    number = 2
    while f"{stem}{number}" in taken:
        number += 1
    return f"{stem}{number}"


def _dangling_targets(design: Design, part: Design) -> set[str]:
    """Return the targets of transitions in the fragment that do not exist."""
    existing = {state.name for state in (*design.states, *part.states)}
    targets = {at.decision.to for at in iter_transitions(part) if isinstance(at.decision, Transition)}
    return targets - existing


def _used_ids(design: Design) -> set[str]:
    """Return all ids and names that identify code."""
    decisions = {located.decision.id for located in iter_decisions(design)}
    actions = {placed.action.id for placed in iter_actions(design) if isinstance(placed.action, RunCode)}
    states = {name for state in design.states for name in (state.id, state.name)}
    return (decisions | actions | states) - {""}


def _with_unique_ids(state: State, taken: set[str]) -> State:
    """Make the ids of a state unique and add them to `taken`."""
    own = "" if state.id in taken else state.id
    taken.update({own, state.name} - {""})
    return replace(
        state,
        id=own,
        enter=_actions_with_unique_ids(state.enter, taken),
        actions=_actions_with_unique_ids(state.actions, taken),
        leave=_actions_with_unique_ids(state.leave, taken),
        transitions=_decisions_with_unique_ids(state.transitions, taken),
    )


def _actions_with_unique_ids(actions: tuple[Action, ...], taken: set[str]) -> tuple[Action, ...]:
    def with_unique_id(action: Action) -> Action:
        return replace(action, id=_unique_id(action.id, taken)) if isinstance(action, RunCode) else action

    return tuple(with_unique_id(action) for action in actions)


def _decisions_with_unique_ids(items: tuple[Decision, ...], taken: set[str]) -> tuple[Decision, ...]:
    def with_unique_id(item: Decision) -> Decision:
        fresh = replace(item, id=_unique_id(item.id, taken))
        if isinstance(fresh, DecisionGroup):
            then, otherwise = (
                _decisions_with_unique_ids(fresh.then, taken),
                _decisions_with_unique_ids(fresh.otherwise, taken),
            )
            return replace(fresh, then=then, otherwise=otherwise)
        return fresh

    return tuple(with_unique_id(item) for item in items)


def _unique_id(wanted: str, taken: set[str]) -> str:
    if not wanted:
        return ""
    id_ = unique_name(wanted, taken)
    taken.add(id_)
    return id_


def _translated(at: Point | None, offset: Point) -> Point | None:
    return None if at is None else (at[0] + offset[0], at[1] + offset[1])
