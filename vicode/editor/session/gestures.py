"""What a gesture on the canvas does to the open design.

The payloads come from a browser: nothing in them is trusted.
"""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from vicode.diagram import Placement
from vicode.editor.session.document import Document
from vicode.editor.view import Selected, path_of_key, transition_key
from vicode.findings import Path
from vicode.model.design import COMMON, Design, Point, State, Transition
from vicode.model.edits import (
    add_state,
    add_transition,
    free_name,
    items_path,
    modulate,
    move,
    remove_decisions,
    remove_states,
    remove_uses,
    rename_state,
    rename_use,
    reorder_decision,
    replace_decision,
    require,
    unlink,
    update_state,
)
from vicode.model.enabling import disable
from vicode.model.names import is_name, is_state_name, name_like
from vicode.model.walks import decision_at, walk_decisions

Payload = Mapping[str, Any]
_FAR = 1_000_000.0
_FARTHEST_LABEL = 2_000
_HOW = {
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
class Outcome:
    """What follows a gesture: a new selection (None: as it was), words for the user if it was refused."""

    select: tuple[Selected, ...] | None = None
    refused: str = ""
    note: str = ""
    """Words about what was done."""
    rename: str = ""
    """The new state whose name the user may type at once."""


Handler = Callable[[Document, Payload], Outcome]


def apply_gesture(document: Document, payload: Payload, more: Mapping[str, Handler] | None = None) -> Outcome:
    """Do what a gesture asks for; `more` are kinds that need to know more than the document.

    A payload of another shape than expected does nothing.
    """
    handlers: dict[str, Handler] = {
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
        **(more or {}),
    }
    handler = handlers.get(str(payload.get("kind")))
    if handler is None:
        return Outcome()
    try:
        return handler(document, payload)
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError):
        # Only the payload's own shape can raise these here: an old page, or somebody else's script.
        return Outcome(refused="that gesture was not understood")


def new_state(document: Document, at: Point, source: str = "") -> str:
    """Add a state at a free name; `source` gets a transition to it. Returns its name."""
    name = free_name("State", {state.name for state in document.design.states})

    def change(design: Design) -> Design:
        grown = add_state(design, State(name=name, at=at))
        return add_transition(grown, source, name) if source else grown

    document.edit(f"add state {name}", change)
    return name


def point_of(item: Payload) -> Point:
    """The place a payload tells.

    Raises:
        ValueError: It is none on the canvas.
    """
    x, y = float(item["x"]), float(item["y"])
    if not (math.isfinite(x) and math.isfinite(y)) or max(abs(x), abs(y)) > _FAR:
        raise ValueError("no point of the canvas")
    return (round(x), round(y))


def take_places(design: Design, placement: Placement, only: Collection[str] | None) -> Design:
    """The design with the places of a layout: of everything, or of some states only."""
    if only is not None:
        return move(design, {name: point for name, point in placement.states.items() if name in only})
    has_common = design.common.transitions or design.common.actions
    return move(design, placement.states, placement.uses, placement.common if has_common else None)


def _move(document: Document, payload: Payload) -> Outcome:
    moved: dict[str, dict[str, Point]] = {"states": {}, "components": {}, "common": {}}
    for item in payload["items"]:
        moved[item["of"]][str(item["id"])] = point_of(item)
    common = next(iter(moved["common"].values()), None)
    count = sum(len(group) for group in moved.values())
    label = f"move {next(iter(moved['states']), 'component')}" if count == 1 else f"move {count} things"
    how = str(payload.get("how"))
    # Step by step one moves a thing as one types a word: it is one edit.
    typing_in = f"nudge {sorted((group, *ids) for group, ids in moved.items())}" if how == "nudge" else ""
    document.edit(
        _HOW.get(how, label),
        lambda design: move(design, moved["states"], moved["components"], common),
        typing_in=typing_in,
    )
    return Outcome()


def _connect(document: Document, payload: Payload) -> Outcome:
    source = _source(document, str(payload["source"]))
    target = payload.get("target")
    if target is None:
        name = new_state(document, point_of(payload), source)
        return Outcome(select=(Selected(of="states", id=name),), rename=name)
    target = _known_state(document, str(target))
    document.edit(f"connect {source.lstrip('@')} to {target}", lambda design: add_transition(design, source, target))
    return Outcome(select=(Selected(of="transitions", id=_last_key(document.design, source)),))


def _reconnect(document: Document, payload: Payload) -> Outcome:
    key, state = str(payload["id"]), _known_state(document, str(payload["state"]))
    located = decision_at(document.design, path_of_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return Outcome(refused="that transition is gone")
    transition, path = located.decision, located.path
    if payload["end"] == "target":
        document.edit(
            f"lead to {state}",
            lambda design: replace_decision(design, path, _with_target(transition, state)),
        )
        return Outcome()
    if located.groups:
        return Outcome(refused="a branch of a decision tree starts where its tree starts")
    document.edit(f"start from {state}", lambda design: _with_source(design, path, transition, state))
    return Outcome(select=(Selected(of="transitions", id=_last_key(document.design, state)),))


def _create(document: Document, payload: Payload) -> Outcome:
    name = new_state(document, point_of(payload))
    return Outcome(select=(Selected(of="states", id=name),), rename=name)


def _rename(document: Document, payload: Payload) -> Outcome:
    if payload.get("of") == "components":
        return _rename_use(document, str(payload["id"]), str(payload["name"]).strip())
    old, new = _known_state(document, str(payload["id"])), str(payload["name"]).strip()
    if old == new:
        return Outcome()
    if not is_state_name(new):
        mend = "it is longer than 80 characters" if len(new) > 80 else "use letters, digits and underscores"
        if len(new) <= 80 and name_like(new):
            mend += f", such as {name_like(new)}"
        return Outcome(refused=f"'{new[:40]}' is no name: {mend}")
    if document.design.state(new) is not None:
        return Outcome(refused=f"there is already a state '{new}'")
    document.edit(f"rename {old} to {new}", lambda design: rename_state(design, old, new))
    return Outcome(select=(Selected(of="states", id=new),))


def _rename_use(document: Document, old: str, new: str) -> Outcome:
    if old == new:
        return Outcome()
    if not is_name(new):
        return Outcome(refused=f"'{new[:40]}' is no name: begin with a letter, then letters, digits and underscores")
    if document.design.use(new) is not None:
        return Outcome(refused=f"there is already a component used as '{new}'")
    document.edit(f"rename {old} to {new}", lambda design: rename_use(design, old, new))
    return Outcome(select=(Selected(of="components", id=new),))


def _delete(document: Document, payload: Payload) -> Outcome:
    named: dict[str, list[str]] = {"states": [], "transitions": [], "components": [], "links": [], "common": []}
    for item in payload["items"]:
        named[item["of"]].append(str(item["id"]))
    paths = [path_of_key(key) for key in named["transitions"]]
    count = sum(len(ids) for ids in named.values())

    def change(design: Design) -> Design:
        smaller = remove_decisions(design, paths)
        for link in named["links"]:
            kind, state, alias = link.split("/")
            smaller = unlink(smaller, state, alias, modulates=kind == "modulates")
        return remove_states(remove_uses(smaller, named["components"]), named["states"])

    document.edit("delete" if count == 1 else f"delete {count} things", change)
    return Outcome(select=())


def _disable(document: Document, payload: Payload) -> Outcome:
    """Disable the states and transitions that are named, or enable them when all of them are disabled."""
    design, items = document.design, payload["items"]
    states = [state for state in design.states if _names(items, "states", state.name)]
    located = [decision_at(design, path_of_key(str(item["id"]))) for item in items if item["of"] == "transitions"]
    decisions = [each for each in located if each is not None]
    if not states and not decisions:
        return Outcome(refused="select states or transitions to disable them")
    flag = not all([*(state.disabled for state in states), *(each.decision.disabled for each in decisions)])
    names, paths = [state.name for state in states], [each.path for each in decisions]
    what = names[0] if len(states) == 1 and not paths else "transition" if len(paths) == 1 and not names else "things"
    document.edit(f"{'disable' if flag else 'enable'} {what}", lambda design: disable(design, names, paths, flag=flag))
    return Outcome()


def _names(items: Iterable[Payload], of: str, identity: str) -> bool:
    return any(item["of"] == of and str(item["id"]) == identity for item in items)


def _link(document: Document, payload: Payload) -> Outcome:
    state, alias = _known_state(document, str(payload["state"])), str(payload["component"])
    if document.design.use(alias) is None:
        return Outcome(refused=f"'{alias}' is not used here any more")
    if payload["kind_of_link"] == "requires":
        document.edit(f"{state} requires {alias}", lambda design: require(design, state, alias))
    else:
        document.edit(f"{state} modulates {alias}", lambda design: modulate(design, state, alias))
    return Outcome()


def _reorder(document: Document, payload: Payload) -> Outcome:
    """Have a transition tested a place earlier or later, or where another of its list is tested."""
    path = path_of_key(str(payload["id"]))
    if decision_at(document.design, path) is None:
        return Outcome(refused="that transition is gone")
    index = int(path[-1]) + (1 if payload.get("by", 0) > 0 else -1)
    if payload.get("onto") is not None:
        onto = path_of_key(str(payload["onto"]))
        if onto[:-1] != path[:-1]:
            return Outcome(refused="a branch of a decision tree is ordered within its branch")
        index = int(onto[-1])
    last = max(int(each.path[-1]) for each in walk_decisions(document.design) if each.path[:-1] == path[:-1])
    index = max(0, min(index, last))
    document.edit("change the order", lambda design: reorder_decision(design, path, index))
    return Outcome(select=(Selected(of="transitions", id=transition_key((*path[:-1], index))),))


def _label(document: Document, payload: Payload) -> Outcome:
    """Put a label on a part of its arrow and so many pixels beside it, or back to where there is room."""
    key = str(payload["id"])
    located = decision_at(document.design, path_of_key(key))
    if located is None or not isinstance(located.decision, Transition):
        return Outcome(refused="that transition is gone")
    label_at: Point | None = None
    if payload["at"] is not None:
        part, beside = (float(value) for value in payload["at"])
        if not (math.isfinite(part) and math.isfinite(beside)):
            raise ValueError("no place of a label")
        label_at = (round(max(0.0, min(part, 1.0)), 3), round(max(-_FARTHEST_LABEL, min(beside, _FARTHEST_LABEL))))
    moved = replace(located.decision, label_at=label_at)
    document.edit(
        "move a label",
        lambda design: replace_decision(design, located.path, moved),
        typing_in=f"label {key}" if payload.get("by") == "nudge" else "",
    )
    return Outcome()


def _mark(document: Document, payload: Payload) -> Outcome:
    """Make a state the initial one, or final, or no longer final."""
    name = _known_state(document, str(payload["id"]))
    if payload["mark"] == "initial":
        document.edit(f"start in {name}", lambda design: replace(design, initial=name))
    else:
        document.edit(
            f"{name} is final or not",
            lambda design: update_state(design, name, lambda state: replace(state, final=not state.final)),
        )
    return Outcome()


def _undo(document: Document, _payload: Payload) -> Outcome:
    return Outcome(refused=document.undo())


def _redo(document: Document, _payload: Payload) -> Outcome:
    return Outcome(refused=document.redo())


def _with_target(transition: Transition, state: str) -> Transition:
    return replace(transition, to=state)


def _with_source(design: Design, path: Path, transition: Transition, state: str) -> Design:
    smaller = remove_decisions(design, [path])
    moved = add_transition(smaller, state, transition.to, transition.guard)
    key = path_of_key(_last_key(moved, state))
    return replace_decision(moved, key, transition)


def _last_key(design: Design, source: str) -> str:
    where = items_path(design, source)
    return transition_key(max((at.path for at in walk_decisions(design) if at.path[:-1] == where), default=(*where, 0)))


def _source(document: Document, name: str) -> str:
    return COMMON if name == COMMON else _known_state(document, name)


def _known_state(document: Document, name: str) -> str:
    if document.design.state(name) is None:
        raise KeyError(name)
    return name
