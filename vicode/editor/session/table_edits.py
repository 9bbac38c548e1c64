"""Applies edits in the table: cells, new and removed rows, the order of rows.

The payloads come from a browser and are untrusted.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from vicode.editor.session import texts
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
    """An invalid edit, with a message for the user."""


def apply_table_edit(document: DocumentSession, payload: Payload) -> EditResult:
    """Apply an edit; a malformed payload changes nothing."""
    handlers: dict[str, Callable[[DocumentSession, Payload], EditResult]] = {
        "set": _set,
        "toggle": _toggle,
        "add-state": _add_state,
        "add-transition": _add_transition,
        "remove": _remove,
        "move": _move,
    }
    handler = handlers.get(str(payload.get("kind")))
    if handler is None:
        return EditResult()
    try:
        return handler(document, payload)
    except TableEditError as error:
        return EditResult(error=str(error))
    except (KeyError, TypeError, ValueError, AttributeError):
        # Only a malformed payload raises these: from an outdated page or another script.
        return EditResult(error=texts.INVALID_REQUEST)


def _set(document: DocumentSession, payload: Payload) -> EditResult:
    column, value, base = (str(payload[name]) for name in ("column", "value", "base"))
    item = parse_row_id(str(payload["row"]))
    now = _cell(document, item, column)
    if column not in _TEXTS or len(value) > MAX_CELL_LENGTH:
        raise TableEditError(texts.CELL_TOO_LONG if column in _TEXTS else texts.CELL_READ_ONLY)
    if value == now:
        return EditResult()
    if now != base:
        raise TableEditError(texts.cell_changed(now))
    if item.kind == "states":
        return _set_in_state(document, item.id, column, value)
    if item.kind == "common":
        raise TableEditError(texts.CELL_IN_INSPECTOR)
    return _set_in_decision(document, item.id, column, value)


def _cell(document: DocumentSession, item: ItemRef, column: str) -> str:
    """The current content of a cell.

    Raises:
        TableEditError: There is no such cell.
    """
    rows = make_table(document.design, ())["rows"]
    cells = next((row["cells"] for row in rows if parse_row_id(row["id"]) == item), None)
    if cells is None:
        raise TableEditError(texts.ROW_GONE)
    if column not in cells:
        raise TableEditError(texts.CELL_READ_ONLY)
    return str(cells[column])


def _set_in_state(document: DocumentSession, name: str, column: str, value: str) -> EditResult:
    if column == "name":
        return apply_gesture(document, {"kind": "rename", "of": "states", "id": name, "name": value})
    if column == "doc":
        document.edit(
            texts.edit_cell(column),
            lambda design: update_state(design, name, lambda state: replace(state, doc=value)),
        )
        return EditResult()
    aliases = _aliases(document.design, value)

    def change(state: State) -> State:
        if column == "requires":
            return replace(state, requires=aliases)
        known = {call.alias: call for call in state.modulates}
        return replace(state, modulates=tuple(known.get(alias, Call(alias=alias)) for alias in aliases))

    document.edit(texts.edit_cell(column), lambda design: update_state(design, name, change))
    return EditResult()


def _aliases(design: Design, text: str) -> tuple[str, ...]:
    """The aliases in a text, separated by commas or spaces.

    Raises:
        TableEditError: The design does not use one of them.
    """
    aliases = tuple(dict.fromkeys(text.replace(",", " ").split()))
    for alias in aliases:
        if design.use(alias) is None:
            raise TableEditError(texts.unknown_alias(alias, [use.alias for use in design.uses]))
    return aliases


def _set_in_decision(document: DocumentSession, key: str, column: str, value: str) -> EditResult:
    located = find_decision(document.design, parse_transition_key(key))
    assert located is not None
    decision, path = located.decision, located.path
    changed: Decision
    if column == "name":
        if not isinstance(decision, Transition):
            raise TableEditError(texts.NO_TARGET)
        if document.design.state(value) is None:
            raise TableEditError(texts.unknown_state(value))
        changed = replace(decision, to=value)
    elif column == "doc":
        changed = replace(decision, doc=value)
    else:
        text = value.strip()
        guard = decision.guard
        changed = replace(decision, guard=replace(guard, when=text) if column == "when" else replace(guard, after=text))
    document.edit(texts.edit_cell(column), lambda design: replace_decision(design, path, changed))
    return EditResult()


def _toggle(document: DocumentSession, payload: Payload) -> EditResult:
    item, column = parse_row_id(str(payload["row"])), str(payload["column"])
    _cell(document, item, column)
    if column == "disabled":
        _toggle_disabled(document, item)
    elif column == "final":
        document.edit(texts.edit_cell(column), lambda design: update_state(design, item.id, _flip_final))
    elif column == "initial":
        if document.design.initial == item.id:
            raise TableEditError(texts.INITIAL_REQUIRED)
        document.edit(texts.edit_cell(column), lambda design: replace(design, initial=item.id))
    return EditResult()


def _toggle_disabled(document: DocumentSession, item: ItemRef) -> None:
    states = [item.id] if item.kind == "states" else []
    paths = [parse_transition_key(item.id)] if item.kind == "transitions" else []
    flag = _cell(document, item, "disabled") == "False"
    label = texts.set_disabled(states, len(paths), disabled=flag)
    document.edit(label, lambda design: set_disabled(design, states, paths, disabled=flag))


def _flip_final(state: State) -> State:
    return replace(state, final=not state.final)


def _add_state(document: DocumentSession, payload: Payload) -> EditResult:
    """Add a state below the state of the row."""
    name = unique_name("State", {state.name for state in document.design.states})
    above = _source_of_row(str(payload.get("row") or ""))
    names = [state.name for state in document.design.states]
    index = names.index(above) + 1 if above in names else len(names)
    document.edit(texts.add_state(name), lambda design: reorder_state(add_state(design, State(name=name)), name, index))
    return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)


def _add_transition(document: DocumentSession, payload: Payload) -> EditResult:
    """Add a transition below the row, or at the end of its state."""
    row = str(payload["row"])
    source, design = _source_of_row(row), document.design
    if source != COMMON and design.state(source) is None:
        raise TableEditError(texts.ROW_GONE)
    target = next((state.name for state in design.states if state.name != source), source)
    if target == COMMON:
        raise TableEditError(texts.NO_STATE_TO_CONNECT)
    item = parse_row_id(row)
    where = decisions_path(design, source)
    path = parse_transition_key(item.id) if item.kind == "transitions" else None
    is_flat = path is not None and path[:-1] == where
    last = _count(design, source)
    index = int(path[-1]) + 1 if path is not None and is_flat else last

    def change(old: Design) -> Design:
        return reorder_decision(add_transition(old, source, target), (*where, last), index)

    document.edit(texts.connect(source, target), change)
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*where, index))),))


def _count(design: Design, source: str) -> int:
    state = design.state(source)
    return len(state.transitions if state else design.common.transitions)


def _remove(document: DocumentSession, payload: Payload) -> EditResult:
    item = parse_row_id(str(payload["row"]))
    if item.kind == "states" and document.design.state(item.id):
        document.edit(texts.remove(item.id), lambda design: remove_states(design, [item.id]))
    elif item.kind == "transitions" and document.has_decision(item.id):
        document.edit(texts.REMOVE_TRANSITION, lambda design: remove_decisions(design, [parse_transition_key(item.id)]))
    else:
        raise TableEditError(texts.ROW_NOT_REMOVABLE)
    return EditResult()


def _move(document: DocumentSession, payload: Payload) -> EditResult:
    item, by = parse_row_id(str(payload["row"])), 1 if int(payload["by"]) > 0 else -1
    design = document.design
    if item.kind == "states" and design.state(item.id):
        index = [state.name for state in design.states].index(item.id) + by
        document.edit(texts.REORDER_STATES, lambda old: reorder_state(old, item.id, index))
        return EditResult(new_selection=(item,))
    located = find_decision(design, parse_transition_key(item.id)) if item.kind == "transitions" else None
    if located is None:
        raise TableEditError(texts.ROW_NOT_MOVABLE)
    path: DesignPath = located.path
    moved = (*path[:-1], int(path[-1]) + by)
    if find_decision(design, moved) is None:
        return EditResult()
    document.edit(texts.REORDER_TRANSITIONS, lambda old: reorder_decision(old, path, int(moved[-1])))
    return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key(moved)),))


def _source_of_row(row: str) -> str:
    return parse_row_id(row).id.split("/")[0]
