"""What a gesture on the canvas does to the open design.

The payloads come from a browser: nothing in them is trusted.
"""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from vicode.diagram import NodeLayout
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
from vicode.model.names import is_valid_name, is_valid_state_name, name_from_text
from vicode.model.traversal import find_decision, iter_decisions

Payload = Mapping[str, Any]
_MAX_COORDINATE = 1_000_000.0
_MAX_LABEL_OFFSET = 2_000
_ARRANGE_LABELS = {
    "align-left": "align left sides",
    "align-centre": "align centres",
    "align-right": "align right sides",
    "align-top": "align tops",
    "align-middle": "align middles",
    "align-bottom": "align bottoms",
    "distribute-across": "equal gaps across",
    "distribute-down": "equal gaps downwards",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class EditResult:
    """What follows a gesture: a new selection (None: as it was), words for the user if it was refused."""

    new_selection: tuple[ItemRef, ...] | None = None
    error: str = ""
    note: str = ""
    """Words about what was done."""
    state_to_rename: str = ""
    """The new state whose name the user may type at once."""


GestureHandler = Callable[[DocumentSession, Payload], EditResult]


def apply_gesture(
    document: DocumentSession, payload: Payload, extra_handlers: Mapping[str, GestureHandler] | None = None
) -> EditResult:
    """Do what a gesture asks for; `extra_handlers` are kinds that need to know more than the document.

    A payload of another shape than expected does nothing.
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
        # Only the payload's own shape can raise these here: an old page, or somebody else's script.
        return EditResult(error="that gesture was not understood")


def create_state(document: DocumentSession, at: Point, source: str = "") -> str:
    """Add a state at a free name; `source` gets a transition to it. Returns its name."""
    name = unique_name("State", {state.name for state in document.design.states})

    def change(design: Design) -> Design:
        grown = add_state(design, State(name=name, at=at))
        return add_transition(grown, source, name) if source else grown

    document.edit(f"add state {name}", change)
    return name


def parse_point(item: Payload) -> Point:
    """The place a payload tells.

    Raises:
        ValueError: It is none on the canvas.
    """
    x, y = float(item["x"]), float(item["y"])
    if not (math.isfinite(x) and math.isfinite(y)) or max(abs(x), abs(y)) > _MAX_COORDINATE:
        raise ValueError("no point of the canvas")
    return (round(x), round(y))


def apply_layout(design: Design, placement: NodeLayout, only: Collection[str] | None) -> Design:
    """The design with the places of a layout: of everything, or of some states only."""
    if only is not None:
        return move_nodes(design, {name: point for name, point in placement.states.items() if name in only})
    has_common = design.common.transitions or design.common.actions
    return move_nodes(design, placement.states, placement.uses, placement.common if has_common else None)


def _move(document: DocumentSession, payload: Payload) -> EditResult:
    moved: dict[str, dict[str, Point]] = {"states": {}, "components": {}, "common": {}}
    for item in payload["items"]:
        moved[item["of"]][str(item["id"])] = parse_point(item)
    common = next(iter(moved["common"].values()), None)
    count = sum(len(group) for group in moved.values())
    label = f"move {next(iter(moved['states']), 'component')}" if count == 1 else f"move {count} things"
    how = str(payload.get("how"))
    # Step by step one moves a thing as one types a word: it is one edit.
    typing_in = f"nudge {sorted((group, *ids) for group, ids in moved.items())}" if how == "nudge" else ""
    document.edit(
        _ARRANGE_LABELS.get(how, label),
        lambda design: move_nodes(design, moved["states"], moved["components"], common),
        coalesce_key=typing_in,
    )
    return EditResult()


def _connect(document: DocumentSession, payload: Payload) -> EditResult:
    source = _source(document, str(payload["source"]))
    target = payload.get("target")
    if target is None:
        name = create_state(document, parse_point(payload), source)
        return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)
    target = _require_state(document, str(target))
    document.edit(f"connect {source.lstrip('@')} to {target}", lambda design: add_transition(design, source, target))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=_last_transition_key(document.design, source)),))


def _reconnect(document: DocumentSession, payload: Payload) -> EditResult:
    key, state = str(payload["id"]), _require_state(document, str(payload["state"]))
    located = find_decision(document.design, parse_transition_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return EditResult(error="that transition is gone")
    transition, path = located.decision, located.path
    if payload["end"] == "target":
        document.edit(
            f"lead to {state}",
            lambda design: replace_decision(design, path, _with_target(transition, state)),
        )
        return EditResult()
    if located.groups:
        return EditResult(error="a branch of a decision tree starts where its tree starts")
    document.edit(f"start from {state}", lambda design: _with_source(design, path, transition, state))
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
        mend = "it is longer than 80 characters" if len(new) > 80 else "use letters, digits and underscores"
        if len(new) <= 80 and name_from_text(new):
            mend += f", such as {name_from_text(new)}"
        return EditResult(error=f"'{new[:40]}' is no name: {mend}")
    if document.design.state(new) is not None:
        return EditResult(error=f"there is already a state '{new}'")
    document.edit(f"rename {old} to {new}", lambda design: rename_state(design, old, new))
    return EditResult(new_selection=(ItemRef(kind="states", id=new),))


def _rename_use(document: DocumentSession, old: str, new: str) -> EditResult:
    if old == new:
        return EditResult()
    if not is_valid_name(new):
        return EditResult(error=f"'{new[:40]}' is no name: begin with a letter, then letters, digits and underscores")
    if document.design.use(new) is not None:
        return EditResult(error=f"there is already a component used as '{new}'")
    document.edit(f"rename {old} to {new}", lambda design: rename_use(design, old, new))
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

    document.edit("delete" if count == 1 else f"delete {count} things", change)
    return EditResult(new_selection=())


def _disable(document: DocumentSession, payload: Payload) -> EditResult:
    """Disable the states and transitions that are named, or enable them when all of them are disabled."""
    design, items = document.design, payload["items"]
    states = [state for state in design.states if _names(items, "states", state.name)]
    located = [
        find_decision(design, parse_transition_key(str(item["id"]))) for item in items if item["of"] == "transitions"
    ]
    decisions = [each for each in located if each is not None]
    if not states and not decisions:
        return EditResult(error="select states or transitions to disable them")
    flag = not all([*(state.disabled for state in states), *(each.decision.disabled for each in decisions)])
    names, paths = [state.name for state in states], [each.path for each in decisions]
    what = names[0] if len(states) == 1 and not paths else "transition" if len(paths) == 1 and not names else "things"
    document.edit(
        f"{'disable' if flag else 'enable'} {what}", lambda design: set_disabled(design, names, paths, disabled=flag)
    )
    return EditResult()


def _names(items: Iterable[Payload], of: str, identity: str) -> bool:
    return any(item["of"] == of and str(item["id"]) == identity for item in items)


def _link(document: DocumentSession, payload: Payload) -> EditResult:
    state, alias = _require_state(document, str(payload["state"])), str(payload["component"])
    if document.design.use(alias) is None:
        return EditResult(error=f"'{alias}' is not used here any more")
    if payload["kind_of_link"] == "requires":
        document.edit(f"{state} requires {alias}", lambda design: add_requirement(design, state, alias))
    else:
        document.edit(f"{state} modulates {alias}", lambda design: add_modulation(design, state, alias))
    return EditResult()


def _reorder(document: DocumentSession, payload: Payload) -> EditResult:
    """Have a transition tested a place earlier or later, or where another of its list is tested."""
    path = parse_transition_key(str(payload["id"]))
    if find_decision(document.design, path) is None:
        return EditResult(error="that transition is gone")
    index = int(path[-1]) + (1 if payload.get("by", 0) > 0 else -1)
    if payload.get("onto") is not None:
        onto = parse_transition_key(str(payload["onto"]))
        if onto[:-1] != path[:-1]:
            return EditResult(error="a branch of a decision tree is ordered within its branch")
        index = int(onto[-1])
    last = max(int(each.path[-1]) for each in iter_decisions(document.design) if each.path[:-1] == path[:-1])
    index = max(0, min(index, last))
    document.edit("change the order", lambda design: reorder_decision(design, path, index))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*path[:-1], index))),))


def _label(document: DocumentSession, payload: Payload) -> EditResult:
    """Put a label on a part of its arrow and so many pixels beside it, or back to where there is room."""
    key = str(payload["id"])
    located = find_decision(document.design, parse_transition_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return EditResult(error="that transition is gone")
    label_at: Point | None = None
    if payload["at"] is not None:
        part, beside = (float(value) for value in payload["at"])
        if not (math.isfinite(part) and math.isfinite(beside)):
            raise ValueError("no place of a label")
        label_at = (round(max(0.0, min(part, 1.0)), 3), round(max(-_MAX_LABEL_OFFSET, min(beside, _MAX_LABEL_OFFSET))))
    moved = replace(located.decision, label_at=label_at)
    document.edit(
        "move a label",
        lambda design: replace_decision(design, located.path, moved),
        coalesce_key=f"label {key}" if payload.get("by") == "nudge" else "",
    )
    return EditResult()


def _mark(document: DocumentSession, payload: Payload) -> EditResult:
    """Make a state the initial one, or final, or no longer final."""
    name = _require_state(document, str(payload["id"]))
    if payload["mark"] == "initial":
        document.edit(f"start in {name}", lambda design: replace(design, initial=name))
    else:
        document.edit(
            f"{name} is final or not",
            lambda design: update_state(design, name, lambda state: replace(state, final=not state.final)),
        )
    return EditResult()


def _undo(document: DocumentSession, _payload: Payload) -> EditResult:
    return EditResult(error=document.undo())


def _redo(document: DocumentSession, _payload: Payload) -> EditResult:
    return EditResult(error=document.redo())


def _with_target(transition: Transition, state: str) -> Transition:
    return replace(transition, to=state)


def _with_source(design: Design, path: DesignPath, transition: Transition, state: str) -> Design:
    smaller = remove_decisions(design, [path])
    moved = add_transition(smaller, state, transition.to, transition.guard)
    key = parse_transition_key(_last_transition_key(moved, state))
    return replace_decision(moved, key, transition)


def _last_transition_key(design: Design, source: str) -> str:
    where = decisions_path(design, source)
    return transition_key(max((at.path for at in iter_decisions(design) if at.path[:-1] == where), default=(*where, 0)))


def _source(document: DocumentSession, name: str) -> str:
    return COMMON if name == COMMON else _require_state(document, name)


def _require_state(document: DocumentSession, name: str) -> str:
    if document.design.state(name) is None:
        raise KeyError(name)
    return name
