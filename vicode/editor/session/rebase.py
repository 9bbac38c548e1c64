"""Finds a thing again after others renamed, moved or removed things: selections and late gestures stay with it."""

from collections.abc import Mapping
from typing import Any

from vicode.editor.view import ItemRef, parse_transition_key, transition_key
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Decision, DecisionGroup, Design
from vicode.model.merge import find_renamed_states, find_renamed_uses, match_items


def rebase_selection(thing: ItemRef, old: Design, new: Design) -> ItemRef | None:
    """The same thing in a later design; None when it is gone."""
    if old == new:
        return thing
    match thing.kind:
        case "states":
            name = _state(thing.id, old, new)
            return ItemRef(kind="states", id=name) if name else None
        case "components":
            alias = _use(thing.id, old, new)
            return ItemRef(kind="components", id=alias) if alias else None
        case "links":
            kind, state, alias = (*thing.id.split("/"), "", "")[:3]
            found = (kind, _state(state, old, new), _use(alias, old, new))
            return ItemRef(kind="links", id="/".join(found)) if all(found) else None
        case "transitions":
            key = _decision(thing.id, old, new)
            return ItemRef(kind="transitions", id=key) if key else None
        case _:
            return thing


def rebase_gesture(payload: Mapping[str, Any], old: Design, new: Design) -> dict[str, Any] | None:
    """A gesture made on an older drawing as it is meant now; None when what it was made on is gone."""
    late = dict(payload)
    kind = {"reconnect": "transitions"}.get(str(payload.get("kind")), str(payload.get("of", "")))
    if "id" in late and kind:
        found = rebase_selection(ItemRef(kind=kind, id=str(late["id"])), old, new)
        if found is None:
            return None
        late["id"] = found.id
    if isinstance(late.get("items"), list):
        late["items"] = [each for each in (_item(item, old, new) for item in late["items"]) if each is not None]
    for name in ("source", "target", "state"):
        if isinstance(late.get(name), str) and late[name] != COMMON:
            late[name] = _state(late[name], old, new)
    return late


def _item(item: Any, old: Design, new: Design) -> Any:
    if not isinstance(item, Mapping):
        return item
    found = rebase_selection(ItemRef(kind=str(item.get("of")), id=str(item.get("id"))), old, new)
    return None if found is None else {**item, "id": found.id}


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
    """The way to a decision within a list and the groups in it; nothing when it is gone."""
    if not steps:
        return ()
    at, rest = steps[0], steps[1:]
    if not isinstance(at, int) or at >= len(before):
        return ()
    # One that was changed beyond recognition stands where it stood, if nothing came or went.
    to = match_items(before, after, is_keyed=False).get(at, at if len(before) == len(after) else -1)
    if to < 0 or not rest:
        return (to,) if to >= 0 else ()
    was, now, side = before[at], after[to], rest[0]
    if not isinstance(was, DecisionGroup) or not isinstance(now, DecisionGroup):
        return ()
    inner = (was.then, now.then) if side == "then" else (was.otherwise, now.otherwise)
    deeper = _steps(rest[1:], *inner) if len(rest) > 1 else ()
    return (to, side, *deeper) if deeper else ()
