"""What a person does in the table: a cell gets another value, rows come, go and change their order.

The payloads come from a browser: nothing in them is trusted.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures import EditResult, apply_gesture
from vicode.editor.view import ItemRef, make_table, parse_row_id, parse_transition_key, transition_key
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Call, Decision, Design, State, Transition
from vicode.model.disabled import set_disabled
from vicode.model.edits import (
    add_state,
    add_transition,
    decisions_path,
    remove_decisions,
    remove_states,
    reorder_decision,
    reorder_state,
    replace_decision,
    unique_name,
    update_state,
)
from vicode.model.traversal import find_decision

Payload = Mapping[str, Any]
MAX_CELL_LENGTH = 20_000
_TEXTS = frozenset({"name", "when", "after", "requires", "modulates", "doc"})


class TableEditError(Exception):
    """A value that cannot be taken over; the message says why, for the person."""


def apply_table_edit(document: DocumentSession, payload: Payload) -> EditResult:
    """Do what the table asks for. A payload of another shape than expected does nothing."""
    jobs: dict[str, Callable[[DocumentSession, Payload], EditResult]] = {
        "set": _set,
        "toggle": _toggle,
        "add-state": _add_state,
        "add-transition": _add_transition,
        "remove": _remove,
        "move": _move,
    }
    job = jobs.get(str(payload.get("kind")))
    if job is None:
        return EditResult()
    try:
        return job(document, payload)
    except TableEditError as error:
        return EditResult(error=str(error))
    except (KeyError, TypeError, ValueError, AttributeError):
        # Only the payload's own shape can raise these here: an old page, or somebody else's script.
        return EditResult(error="that was not understood")


def _set(document: DocumentSession, payload: Payload) -> EditResult:
    column, value, base = (str(payload[name]) for name in ("column", "value", "base"))
    thing = parse_row_id(str(payload["row"]))
    now = _cell(document, thing, column)
    if column not in _TEXTS or len(value) > MAX_CELL_LENGTH:
        raise TableEditError("that is too long for a cell" if column in _TEXTS else "that cannot be changed here")
    if value == now:
        return EditResult()
    if now != base:
        raise TableEditError(f"it became '{now[:60]}' meanwhile: press Enter again to write yours over it")
    if thing.kind == "states":
        return _set_in_state(document, thing.id, column, value)
    if thing.kind == "common":
        raise TableEditError("this is edited in the inspector")
    return _set_in_decision(document, thing.id, column, value)


def _cell(document: DocumentSession, thing: ItemRef, column: str) -> str:
    """What a cell holds now.

    Raises:
        RefusedError: There is no such cell.
    """
    rows = make_table(document.design, ())["rows"]
    cells = next((row["cells"] for row in rows if parse_row_id(row["id"]) == thing), None)
    if cells is None:
        raise TableEditError("that row is gone")
    if column not in cells:
        raise TableEditError("that cannot be changed here")
    return str(cells[column])


def _set_in_state(document: DocumentSession, name: str, column: str, value: str) -> EditResult:
    if column == "name":
        return apply_gesture(document, {"kind": "rename", "of": "states", "id": name, "name": value})
    if column == "doc":
        document.edit("edit Doc", lambda design: update_state(design, name, lambda state: replace(state, doc=value)))
        return EditResult()
    aliases = _aliases(document.design, value)

    def change(state: State) -> State:
        if column == "requires":
            return replace(state, requires=aliases)
        known = {call.alias: call for call in state.modulates}
        return replace(state, modulates=tuple(known.get(alias, Call(alias=alias)) for alias in aliases))

    document.edit(f"edit {column.capitalize()}", lambda design: update_state(design, name, change))
    return EditResult()


def _aliases(design: Design, text: str) -> tuple[str, ...]:
    """The used components named in a text, separated by commas or spaces.

    Raises:
        RefusedError: One of them is not used in this design.
    """
    aliases = tuple(dict.fromkeys(text.replace(",", " ").split()))
    for alias in aliases:
        if design.use(alias) is None:
            known = ", ".join(use.alias for use in design.uses) or "none yet"
            raise TableEditError(f"'{alias[:40]}' is no component used here (there are: {known})")
    return aliases


def _set_in_decision(document: DocumentSession, key: str, column: str, value: str) -> EditResult:
    located = find_decision(document.design, parse_transition_key(key))
    assert located is not None
    decision, path = located.decision, located.path
    changed: Decision
    if column == "name":
        if not isinstance(decision, Transition):
            raise TableEditError("only a transition leads to another state")
        if document.design.state(value) is None:
            raise TableEditError(f"there is no state '{value[:40]}'")
        changed = replace(decision, to=value)
    elif column == "doc":
        changed = replace(decision, doc=value)
    else:
        text = value.strip()
        guard = decision.guard
        changed = replace(decision, guard=replace(guard, when=text) if column == "when" else replace(guard, after=text))
    label = {"name": "To"}.get(column, column.capitalize())
    document.edit(f"edit {label}", lambda design: replace_decision(design, path, changed))
    return EditResult()


def _toggle(document: DocumentSession, payload: Payload) -> EditResult:
    thing, column = parse_row_id(str(payload["row"])), str(payload["column"])
    _cell(document, thing, column)
    if column == "disabled":
        _toggle_disabled(document, thing)
    elif column == "final":
        document.edit("edit Final", lambda design: update_state(design, thing.id, _flip_final))
    elif column == "initial":
        if document.design.initial == thing.id:
            raise TableEditError("a design starts somewhere: mark another state as initial")
        document.edit("edit Initial", lambda design: replace(design, initial=thing.id))
    return EditResult()


def _toggle_disabled(document: DocumentSession, thing: ItemRef) -> None:
    states = [thing.id] if thing.kind == "states" else []
    paths = [parse_transition_key(thing.id)] if thing.kind == "transitions" else []
    flag = _cell(document, thing, "disabled") == "False"
    document.edit("disable" if flag else "enable", lambda design: set_disabled(design, states, paths, disabled=flag))


def _flip_final(state: State) -> State:
    return replace(state, final=not state.final)


def _add_state(document: DocumentSession, payload: Payload) -> EditResult:
    """A new state below the one the row belongs to."""
    name = unique_name("State", {state.name for state in document.design.states})
    above = _source_of_row(str(payload.get("row") or ""))
    names = [state.name for state in document.design.states]
    index = names.index(above) + 1 if above in names else len(names)
    document.edit(f"add state {name}", lambda design: reorder_state(add_state(design, State(name=name)), name, index))
    return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)


def _add_transition(document: DocumentSession, payload: Payload) -> EditResult:
    """A new transition below the row, or at the end of its state's."""
    row = str(payload["row"])
    source, design = _source_of_row(row), document.design
    if source != COMMON and design.state(source) is None:
        raise TableEditError("that row is gone")
    target = next((state.name for state in design.states if state.name != source), source)
    if target == COMMON:
        raise TableEditError("there is no state yet that a transition could lead to")
    thing = parse_row_id(row)
    where = decisions_path(design, source)
    path = parse_transition_key(thing.id) if thing.kind == "transitions" else None
    is_flat = path is not None and path[:-1] == where
    last = _count(design, source)
    index = int(path[-1]) + 1 if path is not None and is_flat else last

    def change(old: Design) -> Design:
        return reorder_decision(add_transition(old, source, target), (*where, last), index)

    document.edit(f"connect {source.lstrip('@')} to {target}", change)
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*where, index))),))


def _count(design: Design, source: str) -> int:
    state = design.state(source)
    return len(state.transitions if state else design.common.transitions)


def _remove(document: DocumentSession, payload: Payload) -> EditResult:
    thing = parse_row_id(str(payload["row"]))
    if thing.kind == "states" and document.design.state(thing.id):
        document.edit(f"remove {thing.id}", lambda design: remove_states(design, [thing.id]))
    elif thing.kind == "transitions" and document.has_decision(thing.id):
        document.edit("remove transition", lambda design: remove_decisions(design, [parse_transition_key(thing.id)]))
    else:
        raise TableEditError("that cannot be removed here")
    return EditResult()


def _move(document: DocumentSession, payload: Payload) -> EditResult:
    """A row earlier or later among its like."""
    thing, by = parse_row_id(str(payload["row"])), 1 if int(payload["by"]) > 0 else -1
    design = document.design
    if thing.kind == "states" and design.state(thing.id):
        index = [state.name for state in design.states].index(thing.id) + by
        document.edit("change the order", lambda old: reorder_state(old, thing.id, index))
        return EditResult(new_selection=(thing,))
    located = find_decision(design, parse_transition_key(thing.id)) if thing.kind == "transitions" else None
    if located is None:
        raise TableEditError("that cannot be moved")
    path: DesignPath = located.path
    moved = (*path[:-1], int(path[-1]) + by)
    if find_decision(design, moved) is None:
        return EditResult()
    document.edit("change the order", lambda old: reorder_decision(old, path, int(moved[-1])))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key(moved)),))


def _source_of_row(row: str) -> str:
    """The state a row belongs to, or COMMON."""
    return parse_row_id(row).id.split("/")[0]
