"""A part of a design as a design of its own, and such a part put into another design."""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from vicode.findings import Path
from vicode.model.decisions import drop_targets, retarget_all
from vicode.model.design import Action, Common, Decision, Design, Group, Point, RunCode, State, Transition, Use
from vicode.model.edits import add_state, free_name, rename_use, update_items
from vicode.model.renaming import rename_alias
from vicode.model.walks import decision_at, walk_actions, walk_decisions, walk_transitions


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """What is to be taken out of a design: names of states, paths of decisions, aliases, the common part."""

    states: Collection[str] = ()
    decisions: Collection[Path] = ()
    aliases: Collection[str] = ()
    common: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Joined:
    """A design with a part put in: the names its states got, and the components that are not to be had here."""

    design: Design
    states: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()


def part_of(design: Design, wanted: Wanted) -> Design:
    """The wanted states with all they do and all the components they speak of.

    Decisions count where no state is wanted; having left their state, they stand among the common ones.
    """
    states = tuple(state for state in design.states if state.name in wanted.states)
    common = design.common if wanted.common else Common()
    if not states and not wanted.common:
        found = (decision_at(design, path) for path in wanted.decisions)
        common = Common(transitions=tuple(each.decision for each in found if each is not None))
    part = Design(component=design.component, common=common, states=states)
    uses = tuple(use for use in design.uses if use.alias in wanted.aliases or _mentions(part, use.alias))
    return replace(part, uses=uses)


def put_in(design: Design, part: Design, *, known: Collection[str], by: Point = (0, 0)) -> Joined:
    """Put a part into a design: names are made free, what leads to no state is left out.

    Args:
        design: where it goes.
        part: what `part_of` made, of this design or of another.
        known: the components that may be used here; what uses others keeps speaking of them.
        by: how far the part goes from its own places.
    """
    design, part, missing = _with_uses(design, part, known, by)
    part = _with_free_names(design, part)
    lost = _lost_targets(design, part)
    taken = _ids(design)
    for state in part.states:
        kept = replace(state, at=_shifted(state.at, by), transitions=drop_targets(state.transitions, lost))
        design = add_state(design, _with_free_ids(kept, taken))
    common = drop_targets(part.common.transitions, lost)
    new = tuple(each for each in _free_decisions(common, taken) if each not in design.common.transitions)
    design = update_items(design, ("common", "transitions"), lambda items: (*items, *new))
    actions = (*design.common.actions, *(each for each in part.common.actions if each not in design.common.actions))
    design = replace(design, common=replace(design.common, actions=actions, at=design.common.at or part.common.at))
    return Joined(design=design, states=tuple(state.name for state in part.states), missing=missing)


def append_decisions(design: Design, part: Design, names: Iterable[str], *, known: Collection[str]) -> Joined:
    """Give the states of these names the common transitions of a part, as their last ones."""
    design, part, missing = _with_uses(design, part, known, (0, 0))
    lost = _lost_targets(design, part)
    taken = _ids(design)
    for name in names:
        items = _free_decisions(drop_targets(part.common.transitions, lost), taken)
        where: Path = ("states", name, "transitions")
        design = update_items(design, where, lambda old, items=items: (*old, *items))  # type: ignore[misc]
    return Joined(design=design, missing=missing)


def repeat_decision(design: Design, path: Path) -> Design:
    """Put the same decision once more, right behind itself."""
    located = decision_at(design, path)
    if located is None:
        return design
    index = int(path[-1])
    (twin,) = _free_decisions((located.decision,), _ids(design))
    return update_items(design, path[:-1], lambda items: (*items[: index + 1], twin, *items[index + 1 :]))


def _mentions(part: Design, alias: str) -> bool:
    """Whether anything would change if the component had another alias."""
    return rename_alias(part, alias, f"{alias}_") != part


def _with_uses(
    design: Design, part: Design, known: Collection[str], by: Point
) -> tuple[Design, Design, tuple[str, ...]]:
    missing = []
    for use in part.uses:
        there = design.use(use.alias)
        if there is not None and there.component == use.component:
            continue
        alias = free_name(use.alias, {each.alias for each in (*design.uses, *part.uses)} if there else ())
        part = rename_use(part, use.alias, alias)
        if use.component in known:
            new = Use(alias=alias, component=use.component, at=_shifted(use.at, by))
            design = replace(design, uses=(*design.uses, new))
        else:
            missing.append(use.component)
    return design, part, tuple(missing)


def _with_free_names(design: Design, part: Design) -> Design:
    """The part with new names for those states whose names are taken; a number at the end is counted on."""
    taken = {state.name for state in design.states} | {state.id for state in design.states}
    busy = taken | {state.name for state in part.states}
    names: dict[str, str] = {}
    for state in part.states:
        if state.name in taken:
            stem = re.sub(r"\d+\Z", "", state.name) or state.name
            names[state.name] = _numbered(stem, busy)
            busy.add(names[state.name])
    states = (
        replace(state, name=names.get(state.name, state.name), transitions=retarget_all(state.transitions, names))
        for state in part.states
    )
    common = replace(part.common, transitions=retarget_all(part.common.transitions, names))
    return replace(part, states=tuple(states), common=common)


def _numbered(stem: str, taken: Collection[str]) -> str:
    number = 2
    while f"{stem}{number}" in taken:
        number += 1
    return f"{stem}{number}"


def _lost_targets(design: Design, part: Design) -> set[str]:
    """The names that transitions of the part lead to and nothing has."""
    there = {state.name for state in (*design.states, *part.states)}
    targets = {at.decision.to for at in walk_transitions(part) if isinstance(at.decision, Transition)}
    return targets - there


def _ids(design: Design) -> set[str]:
    """Everything that names code: no two pieces may share it."""
    decisions = {located.decision.id for located in walk_decisions(design)}
    actions = {placed.action.id for placed in walk_actions(design) if isinstance(placed.action, RunCode)}
    states = {name for state in design.states for name in (state.id, state.name)}
    return (decisions | actions | states) - {""}


def _with_free_ids(state: State, taken: set[str]) -> State:
    """A state whose ids nobody has; those it has are `taken` afterwards."""
    own = "" if state.id in taken else state.id
    taken.update({own, state.name} - {""})
    return replace(
        state,
        id=own,
        enter=_free_actions(state.enter, taken),
        actions=_free_actions(state.actions, taken),
        leave=_free_actions(state.leave, taken),
        transitions=_free_decisions(state.transitions, taken),
    )


def _free_actions(actions: tuple[Action, ...], taken: set[str]) -> tuple[Action, ...]:
    def free(action: Action) -> Action:
        return replace(action, id=_free_id(action.id, taken)) if isinstance(action, RunCode) else action

    return tuple(free(action) for action in actions)


def _free_decisions(items: tuple[Decision, ...], taken: set[str]) -> tuple[Decision, ...]:
    def free(item: Decision) -> Decision:
        fresh = replace(item, id=_free_id(item.id, taken))
        if isinstance(fresh, Group):
            then, otherwise = _free_decisions(fresh.then, taken), _free_decisions(fresh.otherwise, taken)
            return replace(fresh, then=then, otherwise=otherwise)
        return fresh

    return tuple(free(item) for item in items)


def _free_id(wanted: str, taken: set[str]) -> str:
    if not wanted:
        return ""
    id_ = free_name(wanted, taken)
    taken.add(id_)
    return id_


def _shifted(at: Point | None, by: Point) -> Point | None:
    return None if at is None else (at[0] + by[0], at[1] + by[1])
