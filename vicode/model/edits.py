"""Pure functions that edit designs. An edit of a missing item returns the design unchanged."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from vicode.findings import DesignPath
from vicode.model.construct_states import remove_from_constructs, rename_in_constructs
from vicode.model.decisions import drop_targets, retarget
from vicode.model.design import (
    STATE_KEYS,
    Action,
    Call,
    CompetenceStep,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    Guard,
    Layer,
    Point,
    Property,
    State,
    Transition,
    Use,
)
from vicode.model.lowering import lower_design
from vicode.model.names import snake_case
from vicode.model.rename import rename_alias
from vicode.model.traversal import find_decision, has_code, iter_decisions

_Linked = TypeVar("_Linked", State, CompetenceStep, Layer)


def unique_name(wanted: str, taken: Collection[str]) -> str:
    """Return `wanted`, or the first of `wanted2`, `wanted3`, … that is not taken."""
    number = 2
    name = wanted
    while name in taken:
        name, number = f"{wanted}{number}", number + 1
    return name


def add_state(design: Design, state: State) -> Design:
    """Append a state. The first state of a design becomes the initial state."""
    initial = design.initial or state.name
    return replace(design, states=(*design.states, state), initial=initial)


def update_state(design: Design, name: str, change: Callable[[State], State]) -> Design:
    """Apply `change`, which must keep the name, to a state."""
    states = tuple(change(state) if state.name == name else state for state in design.states)
    return replace(design, states=states)


def rename_state(design: Design, old: str, new: str) -> Design:
    """Rename a state and update transitions to it. A state with code gets an id to keep its region marks valid."""
    if old == new or design.state(old) is None or design.state(new) is not None:
        return design
    states = tuple(
        replace(
            state,
            name=new if state.name == old else state.name,
            id=old if state.name == old and not state.id and has_code(state) else state.id,
            transitions=retarget(state.transitions, old, new),
        )
        for state in design.states
    )
    common = replace(design.common, transitions=retarget(design.common.transitions, old, new))
    frames = tuple(
        replace(frame, states=tuple(new if name == old else name for name in frame.states)) for frame in design.frames
    )
    initial = new if design.initial == old else design.initial
    properties = tuple(rename_states_of(each, {old: new}) for each in design.properties)
    design = replace(design, states=states, common=common, frames=frames, initial=initial, properties=properties)
    return lower_design(rename_in_constructs(design, old, new))


def rename_states_of(promised: Property, names: Mapping[str, str]) -> Property:
    """The property with other names of its states; states that are not in `names` keep theirs."""
    keys = [key for key in STATE_KEYS if getattr(promised, key, None) in names]
    changes: dict[str, Any] = {key: names[getattr(promised, key)] for key in keys}
    return replace(promised, **changes)


def remove_states(design: Design, names: Collection[str]) -> Design:
    """Remove states, the transitions to them, properties of them, and the frames that have no other states."""
    states = tuple(
        replace(state, transitions=drop_targets(state.transitions, names))
        for state in design.states
        if state.name not in names
    )
    common = replace(design.common, transitions=drop_targets(design.common.transitions, names))
    initial = design.initial
    if initial in names:
        initial = states[0].name if states else ""
    reduced = (
        replace(frame, states=tuple(name for name in frame.states if name not in names)) for frame in design.frames
    )
    frames = tuple(new for new, old in zip(reduced, design.frames, strict=True) if new.states or not old.states)
    properties = tuple(
        each for each in design.properties if not any(getattr(each, key, None) in names for key in STATE_KEYS)
    )
    design = replace(design, states=states, common=common, frames=frames, initial=initial, properties=properties)
    return lower_design(remove_from_constructs(design, names))


def replace_in_frames(
    frames: tuple[DiagramFrame, ...], names: Mapping[str, tuple[str, ...]]
) -> tuple[DiagramFrame, ...]:
    """Replace states by others in all frames."""
    states = ((name for old in frame.states for name in names.get(old, (old,))) for frame in frames)
    return tuple(replace(frame, states=tuple(dict.fromkeys(new))) for frame, new in zip(frames, states, strict=True))


def reorder_state(design: Design, name: str, to_index: int) -> Design:
    """Move a state in the list of states, which determines the order in the file and the table."""
    state = design.state(name)
    if state is None:
        return design
    rest = [other for other in design.states if other is not state]
    rest.insert(max(0, min(to_index, len(rest))), state)
    return replace(design, states=tuple(rest))


def move_nodes(
    design: Design, states: Mapping[str, Point], uses: Mapping[str, Point] | None = None, common: Point | None = None
) -> Design:
    """Set the centers of states, used components and the badge of common transitions."""
    placed = tuple(replace(state, at=states.get(state.name, state.at)) for state in design.states)
    used = tuple(replace(use, at=(uses or {}).get(use.alias, use.at)) for use in design.uses)
    badge = replace(design.common, at=common) if common else design.common
    return replace(design, states=placed, uses=used, common=badge)


def add_transition(design: Design, source: str, to: str, guard: Guard | None = None) -> Design:
    """Append a transition to a state, or to the common transitions if `source` is COMMON."""
    transition = Transition(to=to, guard=guard or Guard())
    return update_decisions(design, decisions_path(design, source), lambda items: (*items, transition))


def assign_id(design: Design, path: DesignPath) -> Design:
    """Give a decision an id, so that its region marks stay valid after other edits."""
    located = next((decision for decision in iter_decisions(design) if decision.path == path), None)
    if located is None or located.decision.id:
        return design
    to = located.decision.to if isinstance(located.decision, Transition) else "decision"
    id_ = unique_name(snake_case(f"{located.source.lstrip('@')}_to_{to}"), _ids(design))
    return replace_decision(design, path, replace(located.decision, id=id_))


def decisions_path(design: Design, source: str) -> DesignPath:
    return ("states", source, "transitions") if design.state(source) else ("common", "transitions")


def replace_decision(design: Design, path: DesignPath, decision: Decision) -> Design:
    index = path[-1]
    return update_decisions(
        design, path[:-1], lambda items: tuple(decision if at == index else item for at, item in enumerate(items))
    )


def remove_decisions(design: Design, paths: Collection[DesignPath]) -> Design:
    """Remove decisions, including the content of groups."""
    existing = {located.path for located in iter_decisions(design)}
    # In reverse order, so that the remaining paths stay valid.
    for path in sorted(existing.intersection(paths), key=_path_sort_key, reverse=True):
        design = _remove_decision(design, path)
    return design


def _path_sort_key(path: DesignPath) -> tuple[tuple[int, str], ...]:
    return tuple((part, "") if isinstance(part, int) else (-1, part) for part in path)


def _remove_decision(design: Design, path: DesignPath) -> Design:
    index = path[-1]
    return update_decisions(
        design, path[:-1], lambda items: tuple(item for at, item in enumerate(items) if at != index)
    )


def reorder_decision(design: Design, path: DesignPath, to_index: int) -> Design:
    index = path[-1]

    def moved(items: tuple[Decision, ...]) -> tuple[Decision, ...]:
        if not isinstance(index, int) or not 0 <= index < len(items):
            return items
        rest = [item for at, item in enumerate(items) if at != index]
        rest.insert(max(0, min(to_index, len(rest))), items[index])
        return tuple(rest)

    return update_decisions(design, path[:-1], moved)


def update_decisions(
    design: Design, path: DesignPath, change: Callable[[tuple[Decision, ...]], tuple[Decision, ...]]
) -> Design:
    if path[:2] == ("common", "transitions"):
        items = _update_nested(design.common.transitions, path[2:], change)
        return replace(design, common=replace(design.common, transitions=items))
    name = str(path[1])
    return update_state(
        design,
        name,
        lambda state: replace(state, transitions=_update_nested(state.transitions, path[3:], change)),
    )


def _update_nested(
    items: tuple[Decision, ...], path: DesignPath, change: Callable[[tuple[Decision, ...]], tuple[Decision, ...]]
) -> tuple[Decision, ...]:
    if not path:
        return change(items)
    index, side, rest = path[0], path[1], path[2:]

    def inside(item: Decision) -> Decision:
        if not isinstance(item, DecisionGroup):
            return item
        if side == "then":
            return replace(item, then=_update_nested(item.then, rest, change))
        return replace(item, otherwise=_update_nested(item.otherwise, rest, change))

    return tuple(inside(item) if at == index else item for at, item in enumerate(items))


def set_disabled(design: Design, states: Collection[str], paths: Collection[DesignPath], *, disabled: bool) -> Design:
    """Disable states and decisions (`disabled`), or enable them again."""
    updated_states = tuple(
        replace(state, disabled=disabled) if state.name in states else state for state in design.states
    )
    changed = replace(design, states=updated_states)
    for path in paths:
        located = find_decision(changed, path)
        if located is not None:
            changed = replace_decision(changed, path, replace(located.decision, disabled=disabled))
    return changed


def update_actions(
    design: Design, path: DesignPath, change: Callable[[tuple[Action, ...]], tuple[Action, ...]]
) -> Design:
    """Apply `change` to actions: ("common", "actions") or ("states", name, "enter" | "actions" | "leave")."""
    if path[0] == "common":
        return replace(design, common=replace(design.common, actions=change(design.common.actions)))
    phase = str(path[2])

    def changed(state: State) -> State:
        match phase:
            case "enter":
                return replace(state, enter=change(state.enter))
            case "leave":
                return replace(state, leave=change(state.leave))
            case _:
                return replace(state, actions=change(state.actions))

    return update_state(design, str(path[1]), changed)


def replace_action(design: Design, path: DesignPath, *actions: Action) -> Design:
    """Replace the action at a path by any number of actions."""
    index = path[-1]

    def change(old: tuple[Action, ...]) -> tuple[Action, ...]:
        return tuple(item for at, action in enumerate(old) for item in (actions if at == index else (action,)))

    return update_actions(design, path[:-1], change)


def add_use(design: Design, component: str, at: Point | None = None) -> Design:
    """Add a component to `uses` with a unique alias derived from its name."""
    alias = unique_name(snake_case(component), {use.alias for use in design.uses})
    return replace(design, uses=(*design.uses, Use(alias=alias, component=component, at=at)))


def remove_uses(design: Design, aliases: Collection[str]) -> Design:
    """Remove used components with their requirements, modulations and calls. Expressions are not changed."""

    def without_calls(actions: tuple[Action, ...]) -> tuple[Action, ...]:
        return tuple(action for action in actions if not (isinstance(action, Call) and action.alias in aliases))

    def without_links(owner: _Linked) -> _Linked:
        changes: dict[str, Any] = {
            "requires": tuple(alias for alias in owner.requires if alias not in aliases),
            "modulates": tuple(call for call in owner.modulates if call.alias not in aliases),
        }
        return replace(owner, **changes)

    states = tuple(replace(without_links(each), actions=without_calls(each.actions)) for each in design.states)
    competence = design.competence
    if competence is not None:
        requires = tuple(alias for alias in competence.requires if alias not in aliases)
        competence = replace(competence, requires=requires, steps=tuple(map(without_links, competence.steps)))
    reduced = replace(
        design,
        uses=tuple(use for use in design.uses if use.alias not in aliases),
        states=states,
        common=replace(design.common, actions=without_calls(design.common.actions)),
        competence=competence,
        layers=tuple(map(without_links, design.layers)),
    )
    return lower_design(reduced)


def set_declarations(design: Design, section: str, declarations: tuple[Declaration, ...]) -> Design:
    match section:
        case "parameters":
            return replace(design, parameters=declarations)
        case "outputs":
            return replace(design, outputs=declarations)
        case _:
            return replace(design, variables=declarations)


def rename_use(design: Design, old: str, new: str) -> Design:
    """Rename the alias of a used component in links, calls, expressions and Python code (`self.alias`)."""
    if old == new or design.use(old) is None or design.use(new) is not None:
        return design
    uses = tuple(replace(use, alias=new) if use.alias == old else use for use in design.uses)
    return rename_alias(replace(design, uses=uses), old, new)


def add_requirement(design: Design, state: str, alias: str) -> Design:
    return update_state(
        design,
        state,
        lambda old: old if alias in old.requires else replace(old, requires=(*old.requires, alias)),
    )


def add_modulation(design: Design, state: str, alias: str) -> Design:
    def with_call(old: State) -> State:
        known = {call.alias for call in old.modulates}
        return old if alias in known else replace(old, modulates=(*old.modulates, Call(alias=alias)))

    return update_state(design, state, with_call)


def remove_link(design: Design, state: str, alias: str, *, modulates: bool) -> Design:
    """Remove the link from a state to a component: its requirement, or its modulations and calls."""

    def without(old: State) -> State:
        if not modulates:
            return replace(old, requires=tuple(name for name in old.requires if name != alias))
        actions = tuple(action for action in old.actions if not (isinstance(action, Call) and action.alias == alias))
        return replace(old, actions=actions, modulates=tuple(call for call in old.modulates if call.alias != alias))

    return update_state(design, state, without)


def _ids(design: Design) -> set[str]:
    return {located.decision.id for located in iter_decisions(design)} | {state.id for state in design.states}
