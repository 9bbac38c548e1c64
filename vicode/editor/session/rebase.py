"""Rebases selections and gestures onto a newer design in which others renamed, moved or removed items."""

from dataclasses import fields, replace
from functools import cache
from typing import Annotated, Any, TypeVar, cast, get_args, get_origin, get_type_hints

from vicode.editor.session.gestures import NodePosition
from vicode.editor.view import ItemKind, ItemRef, parse_transition_key, transition_key
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Decision, DecisionGroup, Design
from vicode.model.merge import find_renamed_states, find_renamed_uses, match_items

_G = TypeVar("_G")


def rebase_selection(item: ItemRef, old: Design, new: Design) -> ItemRef | None:
    """The same item in a newer design; None if it no longer exists."""
    if old == new:
        return item
    match item.kind:
        case "states":
            name = _state(item.id, old, new)
            return ItemRef(kind="states", id=name) if name else None
        case "components":
            alias = _use(item.id, old, new)
            return ItemRef(kind="components", id=alias) if alias else None
        case "links":
            kind, state, alias = (*item.id.split("/"), "", "")[:3]
            parts = (kind, _state(state, old, new), _use(alias, old, new))
            return ItemRef(kind="links", id="/".join(parts)) if all(parts) else None
        case "transitions":
            key = _decision(item.id, old, new)
            return ItemRef(kind="transitions", id=key) if key else None
        case _:
            return item


def rebase_gesture(gesture: _G, old: Design, new: Design) -> _G | None:
    """A gesture made on an older design, adapted to a newer one; None if its item no longer exists.

    Missing items of a tuple are left out.
    """
    changes: dict[str, Any] = {}
    gesture_type: Any = type(gesture)
    for name, kind in _item_kinds(gesture_type).items():
        before = getattr(gesture, name)
        changes[name] = _rebase_value(before, kind, old, new)
        if changes[name] is None and before is not None:
            return None
    rebased: _G = replace(cast("Any", gesture), **changes)
    return rebased


@cache
def _item_kinds(gesture_type: type) -> dict[str, ItemKind | None]:
    """The fields of a gesture, and the kinds of the items whose ids they contain (see `edits.StateName`)."""
    hints = get_type_hints(gesture_type, include_extras=True)
    kinds: dict[str, ItemKind | None] = {}
    for field in fields(gesture_type):
        annotated = (hints[field.name], *get_args(hints[field.name]))
        kinds[field.name] = next((hint.__metadata__[0] for hint in annotated if get_origin(hint) is Annotated), None)
    return kinds


def _rebase_value(value: Any, kind: ItemKind | None, old: Design, new: Design) -> Any:
    if isinstance(value, tuple):
        return tuple(item for item in (_rebase_value(each, kind, old, new) for each in value) if item is not None)
    if isinstance(value, ItemRef | NodePosition):
        found = rebase_selection(ItemRef(kind=value.kind, id=value.id), old, new)
        return None if found is None else replace(value, id=found.id)
    if kind is None or value in (None, COMMON):
        return value
    found = rebase_selection(ItemRef(kind=kind, id=value), old, new)
    return None if found is None else found.id


def _state(name: str, old: Design, new: Design) -> str:
    if new.state(name) is not None:
        return name
    return find_renamed_states(old, new).get(name, "")


def _use(alias: str, old: Design, new: Design) -> str:
    if new.use(alias) is not None:
        return alias
    return find_renamed_uses(old, new).get(alias, "")


def _decision(key: str, old: Design, new: Design) -> str:
    path = parse_transition_key(key)
    if path[0] == "common":
        start: DesignPath = ("common", "transitions")
        before, after = old.common.transitions, new.common.transitions
    else:
        name = str(path[1])
        was, now = old.state(name), new.state(_state(name, old, new))
        if was is None or now is None:
            return ""
        start, before, after = ("states", now.name, "transitions"), was.transitions, now.transitions
    steps = _steps(path[len(start) :], before, after)
    return transition_key((*start, *steps)) if steps else ""


def _steps(steps: DesignPath, before: tuple[Decision, ...], after: tuple[Decision, ...]) -> DesignPath:
    """The relative path of a decision in a list with nested groups; empty if it no longer exists."""
    if not steps:
        return ()
    at, rest = steps[0], steps[1:]
    if not isinstance(at, int) or at >= len(before):
        return ()
    # An unrecognizable decision keeps its index if the length of the list is unchanged.
    to = match_items(before, after, is_keyed=False).get(at, at if len(before) == len(after) else -1)
    if to < 0 or not rest:
        return (to,) if to >= 0 else ()
    was, now, side = before[at], after[to], rest[0]
    if not isinstance(was, DecisionGroup) or not isinstance(now, DecisionGroup):
        return ()
    inner = (was.then, now.then) if side == "then" else (was.otherwise, now.otherwise)
    deeper = _steps(rest[1:], *inner) if len(rest) > 1 else ()
    return (to, side, *deeper) if deeper else ()
