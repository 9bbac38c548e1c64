"""Latches, interrupts, competences, layers and failed states as plain states, transitions and variables.

Generators, analysis, simulator, diagrams and the live view know plain state machines only. `lower_design` adds to a
design what these constructs mean, and marks each addition with its `origin`; `lift_design` removes the additions, so
that only the constructs are saved. A design is lowered when it is read, and again after each edit. An edit of an
addition would be lost; `find_lost_edit` finds it, and it is refused.
"""

from dataclasses import replace
from itertools import zip_longest
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import (
    Action,
    Call,
    Decision,
    Declaration,
    DerivedPosition,
    Design,
    Origin,
    RunCode,
    State,
    Stay,
)
from vicode.model.lowering.competences import COMPETENCE_STATES, LATEST, lower_competence, tries_name
from vicode.model.lowering.ends import FAILED, lower_ends
from vicode.model.lowering.interrupts import (
    find_target,
    fits_pattern,
    interrupt_names,
    interrupted_states,
    is_handled_before,
    lower_interrupts,
)
from vicode.model.lowering.latches import latch_names, lower_latches
from vicode.model.lowering.layers import lower_layers, until_name

__all__ = [
    "COMPETENCE_STATES",
    "FAILED",
    "derived_variables",
    "describe_origin",
    "find_lost_edit",
    "find_origin",
    "find_target",
    "fits_pattern",
    "interrupted_states",
    "is_handled_before",
    "is_lowered",
    "lift_design",
    "lower_design",
    "lower_edit",
    "source_path",
]


def lower_design(design: Design) -> Design:
    """The design with the states, transitions and variables that its constructs mean; invalid parts are skipped."""
    if not is_lowered(design):
        return design
    design = lift_design(design)
    # A competence and layers have states for the other constructs; a latch changes before anything else is done.
    for lower in (lower_competence, lower_layers, lower_interrupts, lower_latches, lower_ends):
        design = lower(design)
    places = {each.name: each.at for each in design.positions}
    states = (replace(each, at=places.get(each.name)) if each.origin else each for each in design.states)
    return replace(design, states=tuple(states))


def lift_design(design: Design) -> Design:
    """The design as its file says it, without anything derived."""
    if not is_lowered(design):
        return design
    initial = design.state(design.initial)
    return replace(
        design,
        outputs=_written(design.outputs),
        variables=_written(design.variables),
        initial="" if initial is not None and initial.origin else design.initial,
        common=replace(
            design.common,
            actions=_written_actions(design.common.actions),
            transitions=_written_decisions(design.common.transitions),
        ),
        states=tuple(_lift_state(state) for state in design.states if not state.origin),
        positions=_positions(design),
    )


def _positions(design: Design) -> tuple[DerivedPosition, ...]:
    """The positions of derived states in their order, after those of states that are not derived yet."""
    derived = [each for each in design.states if each.origin]
    names = {each.name for each in derived}
    others = (each for each in design.positions if each.name not in names)
    return (*others, *(DerivedPosition(name=each.name, at=each.at) for each in derived if each.at))


def is_lowered(design: Design) -> bool:
    """Whether a design has anything to lower."""
    has_constructs = design.latches or design.interrupts or design.competence is not None or design.layers
    return bool(has_constructs) or any(state.failed or state.origin for state in design.states) or _has_derived(design)


def lower_edit(before: Design, after: Design) -> tuple[Design, str]:
    """Lower an edited design; if the edit changes something derived, return the design before it and the reason."""
    if _has_states_twice(after) and not _has_states_twice(before):
        items = "layers" if after.layers else "the steps of its competence"
        return before, f"the states of this design are {items}; add one in the form of the design"
    origin = find_lost_edit(after)
    design = _forget_positions(lower_design(after))
    if not origin or (design != before and _keeps_derived(before, after)):
        return design, ""
    form = f"the state '{origin[1]}'" if origin[0] == "states" else "the design"
    return before, f"this part is derived from {describe_origin(origin)}; edit it in the form of {form}"


def _has_states_twice(design: Design) -> bool:
    is_whole = design.competence is not None or bool(design.layers)
    return is_whole and not all(state.origin for state in design.states)


def _forget_positions(design: Design) -> Design:
    """Without the positions of states that are not derived any more."""
    derived = {each.name for each in design.states if each.origin}
    return replace(design, positions=tuple(each for each in design.positions if each.name in derived))


def _keeps_derived(before: Design, after: Design) -> bool:
    """Whether what is derived is the same where it was. New states may have any."""

    def derived(design: Design, names: set[str]) -> list[object]:
        states = (each for each in design.states if each.name in names)
        return _derived_parts(replace(design, states=tuple(sorted(states, key=lambda each: each.name))))

    names = {each.name for each in before.states} & {each.name for each in after.states}
    removed = (each for each in before.states if each.name not in names)
    return derived(before, names) == derived(after, names) and not any(each.origin for each in removed)


def find_lost_edit(design: Design) -> Origin:
    """The construct that an edit of something derived belongs to, which lowering again would undo; empty if none."""
    again = lower_design(design)
    if again == design:
        return ()
    for now, then in zip_longest(_derived_parts(design), _derived_parts(again)):
        if now != then:
            return _origin(then or now)
    initial = again.state(again.initial)
    return initial.origin if initial is not None and design.initial != again.initial else ()


def derived_variables(design: Design) -> tuple[tuple[str, Origin], ...]:
    """The names of the variables that the constructs need, each with its construct."""
    found: list[tuple[str, Origin]] = []
    for latch in design.latches:
        found += [(name, ("latches", latch.name)) for name in latch_names(latch)]
    found += [(name, ("interrupts", number)) for name, number in interrupt_names(design)]
    if design.competence is not None:
        limited = [step for step in design.competence.steps if step.retries is not None]
        found += [(LATEST, ("competence",))] if limited else []
        found += [(tries_name(step), ("competence", "steps", step.name)) for step in limited]
    found += [(until_name(layer), ("layers", layer.name)) for layer in design.layers[1:] if layer.hold and layer.when]
    return tuple(found)


def describe_origin(origin: Origin) -> str:
    """A construct as messages name it: "'near' in 'latches'", "'interrupts' (number 2)", "'competence'"."""
    match origin:
        case ("states", name, _key):
            return f"'failed' of the state '{name}'"
        case (section, int(index)):
            return f"'{section}' (number {index + 1})"
        case (section, *_keys, name):
            return f"'{name}' in '{section}'"
        case _:
            return f"'{origin[0]}'"


def find_origin(design: Design, path: DesignPath) -> Origin:
    """What the part of a lowered design at a path is derived from; empty if it is written in the file."""
    match path:
        case ("states", str(name), *rest):
            state = design.state(name)
            return () if state is None else state.origin or _origin_of_item(state, tuple(rest))
        case ("common", *rest):
            return _origin_of_item(design.common, tuple(rest))
        case ("variables" | "outputs" as section, str(name), *_):
            return next((each.origin for each in getattr(design, section) if each.name == name), ())
        case _:
            return ()


def source_path(design: Design, path: DesignPath) -> DesignPath:
    """The path in the file of a path in a lowered design; what is derived is at its construct."""
    origin = find_origin(design, path)
    match path:
        case ("states", str(), *rest) if origin and rest[:1] in (["requires"], ["modulates"]):
            return (*origin, *rest)
        case _ if origin:
            return origin
        case ("states", str(name), key, int(index), *rest):
            state = design.state(name)
            return path if state is None else ("states", name, key, index - _count_derived(state, key, index), *rest)
        case ("common", str(key), int(index), *rest):
            return ("common", key, index - _count_derived(design.common, key, index), *rest)
        case _:
            return path


def _origin_of_item(owner: object, rest: DesignPath) -> Origin:
    match rest:
        case ("actions" | "enter" | "leave" | "transitions" as key, int(index), *_):
            items: tuple[Action | Decision, ...] = getattr(owner, key)
            return _origin(items[index]) if index < len(items) else ()
        case _:
            return ()


def _count_derived(owner: object, key: object, index: int) -> int:
    """How many items before an index are derived."""
    if key not in ("actions", "enter", "leave", "transitions"):
        return 0
    items: tuple[Action | Decision, ...] = getattr(owner, str(key))
    return sum(1 for each in items[:index] if _origin(each))


def _origin(item: Action | Decision | Declaration | State) -> Origin:
    return () if isinstance(item, Call | RunCode | Stay) else item.origin


def _written(declarations: tuple[Declaration, ...]) -> tuple[Declaration, ...]:
    return tuple(each for each in declarations if not each.origin)


def _written_actions(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    return tuple(each for each in actions if not _origin(each))


def _written_decisions(decisions: tuple[Decision, ...]) -> tuple[Decision, ...]:
    return tuple(each for each in decisions if not _origin(each))


def _lift_state(state: State) -> State:
    return replace(
        state,
        enter=_written_actions(state.enter),
        actions=_written_actions(state.actions),
        leave=_written_actions(state.leave),
        transitions=_written_decisions(state.transitions),
    )


def _has_derived(design: Design) -> bool:
    return any(_origin(each) for each in _derived_parts(design))


def _derived_parts(design: Design) -> list[Any]:
    common = design.common
    parts: list[Action | Decision | Declaration | State] = [*design.outputs, *design.variables]
    parts += [*common.actions, *common.transitions]
    for state in design.states:
        parts += [state] if state.origin else []
        parts += [*state.enter, *state.actions, *state.leave, *state.transitions]
    return [each for each in parts if _origin(each)]
