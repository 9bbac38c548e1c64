"""Applies gestures on the canvas to the open design.

The payloads come from a browser and are untrusted.
"""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from vicode.diagram.layered_layout import NodeLayout
from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.view import ItemRef, parse_transition_key, transition_key
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Design, Point, State, Transition
from vicode.model.disabled import set_disabled
from vicode.model.edits import (
    add_modulation,
    add_requirement,
    add_state,
    add_transition,
    decisions_path,
    move_nodes,
    remove_decisions,
    remove_link,
    remove_states,
    remove_uses,
    rename_state,
    rename_use,
    reorder_decision,
    replace_decision,
    unique_name,
    update_state,
)
from vicode.model.names import is_valid_name, is_valid_state_name
from vicode.model.traversal import find_decision, iter_decisions

Payload = Mapping[str, Any]
_MAX_COORDINATE = 1_000_000.0
_MAX_LABEL_OFFSET = 2_000


@dataclass(frozen=True, slots=True, kw_only=True)
class EditResult:
    """The result of a gesture; `error` and `note` are messages for the user."""

    new_selection: tuple[ItemRef, ...] | None = None
    """None keeps the selection."""
    error: str = ""
    note: str = ""
    state_to_rename: str = ""
    """The new state whose name field gets the focus."""


GestureHandler = Callable[[DocumentSession, Payload], EditResult]


def apply_gesture(
    document: DocumentSession, payload: Payload, extra_handlers: Mapping[str, GestureHandler] | None = None
) -> EditResult:
    """Apply a gesture; a malformed payload changes nothing.

    Args:
        document: The open design.
        payload: The gesture as sent by the browser.
        extra_handlers: Handlers, by kind, that depend on more than the document.
    """
    handlers: dict[str, GestureHandler] = {
        "move": _move,
        "connect": _connect,
        "reconnect": _reconnect,
        "create": _create,
        "rename": _rename,
        "delete": _delete,
        "disable": _disable,
        "link": _link,
        "undo": _undo,
        "redo": _redo,
        "reorder": _reorder,
        "label": _label,
        "mark": _mark,
        **(extra_handlers or {}),
    }
    handler = handlers.get(str(payload.get("kind")))
    if handler is None:
        return EditResult()
    try:
        return handler(document, payload)
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError):
        # Only a malformed payload raises these: from an outdated page or another script.
        return EditResult(error=texts.INVALID_REQUEST)


def create_state(document: DocumentSession, at: Point, source: str = "") -> str:
    """Add a state with a free name, and a transition from `source` to it if given; returns the name."""
    name = unique_name("State", {state.name for state in document.design.states})

    def change(design: Design) -> Design:
        grown = add_state(design, State(name=name, at=at))
        return add_transition(grown, source, name) if source else grown

    document.edit(texts.add_state(name), change)
    return name


def parse_point(item: Payload) -> Point:
    """The position in a payload, rounded to whole pixels.

    Raises:
        ValueError: The position is not on the canvas.
    """
    x, y = float(item["x"]), float(item["y"])
    if not (math.isfinite(x) and math.isfinite(y)) or max(abs(x), abs(y)) > _MAX_COORDINATE:
        raise ValueError("position outside the canvas")
    return (round(x), round(y))


def apply_layout(design: Design, layout: NodeLayout, only: Collection[str] | None) -> Design:
    """Move all nodes, or `only` some states, to the positions of a layout."""
    if only is not None:
        return move_nodes(design, {name: point for name, point in layout.states.items() if name in only})
    has_common = design.common.transitions or design.common.actions
    return move_nodes(design, layout.states, layout.uses, layout.common if has_common else None)


def _move(document: DocumentSession, payload: Payload) -> EditResult:
    moved: dict[str, dict[str, Point]] = {"states": {}, "components": {}, "common": {}}
    for item in payload["items"]:
        moved[item["of"]][str(item["id"])] = parse_point(item)
    common = next(iter(moved["common"].values()), None)
    count = sum(len(group) for group in moved.values())
    label = texts.move_items(count, next(iter(moved["states"]), "component"))
    how = str(payload.get("how"))
    # Successive nudges of the same items are one edit, like the letters of a word.
    coalesce_key = f"nudge {sorted((group, *ids) for group, ids in moved.items())}" if how == "nudge" else ""
    document.edit(
        texts.ALIGNMENTS.get(how, label),
        lambda design: move_nodes(design, moved["states"], moved["components"], common),
        coalesce_key=coalesce_key,
    )
    return EditResult()


def _connect(document: DocumentSession, payload: Payload) -> EditResult:
    source = _source(document, str(payload["source"]))
    target = payload.get("target")
    if target is None:
        name = create_state(document, parse_point(payload), source)
        return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)
    target = _require_state(document, str(target))
    document.edit(texts.connect(source, target), lambda design: add_transition(design, source, target))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=_last_transition_key(document.design, source)),))


def _reconnect(document: DocumentSession, payload: Payload) -> EditResult:
    key, state = str(payload["id"]), _require_state(document, str(payload["state"]))
    located = find_decision(document.design, parse_transition_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return EditResult(error=texts.TRANSITION_GONE)
    transition, path = located.decision, located.path
    if payload["end"] == "target":
        changed = replace(transition, to=state)
        document.edit(texts.change_target(state), lambda design: replace_decision(design, path, changed))
        return EditResult()
    if located.groups:
        return EditResult(error=texts.TREE_SOURCE)
    document.edit(texts.change_source(state), lambda design: _with_source(design, path, transition, state))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=_last_transition_key(document.design, state)),))


def _create(document: DocumentSession, payload: Payload) -> EditResult:
    name = create_state(document, parse_point(payload))
    return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)


def _rename(document: DocumentSession, payload: Payload) -> EditResult:
    if payload.get("of") == "components":
        return _rename_use(document, str(payload["id"]), str(payload["name"]).strip())
    old, new = _require_state(document, str(payload["id"])), str(payload["name"]).strip()
    if old == new:
        return EditResult()
    if not is_valid_state_name(new):
        return EditResult(error=texts.invalid_state_name(new))
    if document.design.state(new) is not None:
        return EditResult(error=texts.name_exists("state", new))
    document.edit(texts.rename(old, new), lambda design: rename_state(design, old, new))
    return EditResult(new_selection=(ItemRef(kind="states", id=new),))


def _rename_use(document: DocumentSession, old: str, new: str) -> EditResult:
    if old == new:
        return EditResult()
    if not is_valid_name(new):
        return EditResult(error=texts.invalid_alias(new))
    if document.design.use(new) is not None:
        return EditResult(error=texts.alias_exists(new))
    document.edit(texts.rename(old, new), lambda design: rename_use(design, old, new))
    return EditResult(new_selection=(ItemRef(kind="components", id=new),))


def _delete(document: DocumentSession, payload: Payload) -> EditResult:
    named: dict[str, list[str]] = {"states": [], "transitions": [], "components": [], "links": [], "common": []}
    for item in payload["items"]:
        named[item["of"]].append(str(item["id"]))
    paths = [parse_transition_key(key) for key in named["transitions"]]
    count = sum(len(ids) for ids in named.values())

    def change(design: Design) -> Design:
        smaller = remove_decisions(design, paths)
        for link in named["links"]:
            kind, state, alias = link.split("/")
            smaller = remove_link(smaller, state, alias, modulates=kind == "modulates")
        return remove_states(remove_uses(smaller, named["components"]), named["states"])

    document.edit(texts.delete_items(count), change)
    return EditResult(new_selection=())


def _disable(document: DocumentSession, payload: Payload) -> EditResult:
    """Disable the given states and transitions, or enable them if all are disabled."""
    design, items = document.design, payload["items"]
    states = [state for state in design.states if _names(items, "states", state.name)]
    located = [
        find_decision(design, parse_transition_key(str(item["id"]))) for item in items if item["of"] == "transitions"
    ]
    decisions = [decision for decision in located if decision is not None]
    if not states and not decisions:
        return EditResult(error=texts.SELECT_TO_DISABLE)
    are_disabled = [*(state.disabled for state in states), *(decision.decision.disabled for decision in decisions)]
    disabled = not all(are_disabled)
    names, paths = [state.name for state in states], [decision.path for decision in decisions]
    label = texts.set_disabled(names, len(paths), disabled=disabled)
    document.edit(label, lambda design: set_disabled(design, names, paths, disabled=disabled))
    return EditResult()


def _names(items: Iterable[Payload], of: str, identity: str) -> bool:
    return any(item["of"] == of and str(item["id"]) == identity for item in items)


def _link(document: DocumentSession, payload: Payload) -> EditResult:
    state, alias = _require_state(document, str(payload["state"])), str(payload["component"])
    if document.design.use(alias) is None:
        return EditResult(error=texts.unused_alias(alias))
    if payload["kind_of_link"] == "requires":
        document.edit(texts.add_link(state, "requires", alias), lambda design: add_requirement(design, state, alias))
    else:
        document.edit(texts.add_link(state, "modulates", alias), lambda design: add_modulation(design, state, alias))
    return EditResult()


def _reorder(document: DocumentSession, payload: Payload) -> EditResult:
    """Move a transition up or down by one in the order of priority, or to the position of another."""
    path = parse_transition_key(str(payload["id"]))
    if find_decision(document.design, path) is None:
        return EditResult(error=texts.TRANSITION_GONE)
    index = int(path[-1]) + (1 if payload.get("by", 0) > 0 else -1)
    if payload.get("onto") is not None:
        onto = parse_transition_key(str(payload["onto"]))
        if onto[:-1] != path[:-1]:
            return EditResult(error=texts.TREE_ORDER)
        index = int(onto[-1])
    last = max(int(located.path[-1]) for located in iter_decisions(document.design) if located.path[:-1] == path[:-1])
    index = max(0, min(index, last))
    document.edit(texts.REORDER_TRANSITIONS, lambda design: reorder_decision(design, path, index))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*path[:-1], index))),))


def _label(document: DocumentSession, payload: Payload) -> EditResult:
    """Place a label at a fraction of its edge and a distance from it in pixels, or automatically."""
    key = str(payload["id"])
    located = find_decision(document.design, parse_transition_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return EditResult(error=texts.TRANSITION_GONE)
    label_at: Point | None = None
    if payload["at"] is not None:
        fraction, offset = (float(value) for value in payload["at"])
        if not (math.isfinite(fraction) and math.isfinite(offset)):
            raise ValueError("position of a label is not finite")
        fraction, offset = max(0.0, min(fraction, 1.0)), max(-_MAX_LABEL_OFFSET, min(offset, _MAX_LABEL_OFFSET))
        label_at = (round(fraction, 3), round(offset))
    moved = replace(located.decision, label_at=label_at)
    document.edit(
        texts.MOVE_LABEL,
        lambda design: replace_decision(design, located.path, moved),
        coalesce_key=f"label {key}" if payload.get("by") == "nudge" else "",
    )
    return EditResult()


def _mark(document: DocumentSession, payload: Payload) -> EditResult:
    """Make a state the initial one, or toggle whether it is final."""
    name = _require_state(document, str(payload["id"]))
    if payload["mark"] == "initial":
        document.edit(texts.set_initial(name), lambda design: replace(design, initial=name))
    else:
        state = document.design.state(name)
        final = state is not None and not state.final
        document.edit(
            texts.set_final(name, final=final),
            lambda design: update_state(design, name, lambda old: replace(old, final=final)),
        )
    return EditResult()


def _undo(document: DocumentSession, _payload: Payload) -> EditResult:
    return EditResult(error=document.undo())


def _redo(document: DocumentSession, _payload: Payload) -> EditResult:
    return EditResult(error=document.redo())


def _with_source(design: Design, path: DesignPath, transition: Transition, state: str) -> Design:
    smaller = remove_decisions(design, [path])
    moved = add_transition(smaller, state, transition.to, transition.guard)
    key = parse_transition_key(_last_transition_key(moved, state))
    return replace_decision(moved, key, transition)


def _last_transition_key(design: Design, source: str) -> str:
    parent = decisions_path(design, source)
    paths = (located.path for located in iter_decisions(design) if located.path[:-1] == parent)
    return transition_key(max(paths, default=(*parent, 0)))


def _source(document: DocumentSession, name: str) -> str:
    return COMMON if name == COMMON else _require_state(document, name)


def _require_state(document: DocumentSession, name: str) -> str:
    if document.design.state(name) is None:
        raise KeyError(name)
    return name
