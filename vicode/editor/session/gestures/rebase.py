"""Rebases selections and gestures onto a newer design in which others renamed, moved or removed items."""

from dataclasses import fields, replace
from functools import cache
from typing import Annotated, Any, TypeVar, cast, get_args, get_origin, get_type_hints

from vicode.editor.session.gestures.canvas_gestures import NodePosition
from vicode.editor.session.gestures.item_paths import rebase_path, renamed_frame, renamed_state, renamed_use
from vicode.editor.view import ItemKind, ItemRef
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import COMMON, Design

_G = TypeVar("_G")


def rebase_selection(item: ItemRef, old: Design, new: Design) -> ItemRef | None:
    """The same item in a newer design; None if it no longer exists.

    The browser draws a state that it creates before it has the design with it: that is a state of the newer design.
    """
    if old == new:
        return item
    match item.kind:
        case "states":
            is_created = old.state(item.id) is None and new.state(item.id) is not None
            name = item.id if is_created else renamed_state(item.id, old, new)
            return ItemRef(kind="states", id=name) if name else None
        case "components":
            alias = renamed_use(item.id, old, new)
            return ItemRef(kind="components", id=alias) if alias else None
        case "frames":
            title = renamed_frame(item.id, old, new)
            return ItemRef(kind="frames", id=title) if title else None
        case "links":
            kind, state, alias = (*item.id.split("/"), "", "")[:3]
            parts = (kind, renamed_state(state, old, new), renamed_use(alias, old, new))
            return ItemRef(kind="links", id="/".join(parts)) if all(parts) else None
        case "transitions":
            path = rebase_path(parse_transition_key(item.id), old, new)
            is_decision = path is not None and isinstance(path[-1], int)
            return ItemRef(kind="transitions", id=transition_key(path)) if path and is_decision else None
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
