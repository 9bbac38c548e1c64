"""What a person does in the table: a cell gets another value, rows come, go and change their order.

The payloads come from a browser: nothing in them is trusted.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from vicode.editor.session.document import Document
from vicode.editor.session.gestures import Outcome, apply_gesture
from vicode.editor.view import Selected, path_of_key, table_of, thing_of_row, transition_key
from vicode.findings import Path
from vicode.model.design import COMMON, Call, Decision, Design, State, Transition
from vicode.model.edits import (
    add_state,
    add_transition,
    free_name,
    items_path,
    remove_decisions,
    remove_states,
    reorder_decision,
    reorder_state,
    replace_decision,
    update_state,
)
from vicode.model.enabling import disable
from vicode.model.walks import decision_at

Payload = Mapping[str, Any]
LONGEST = 20_000
_TEXTS = frozenset({"name", "when", "after", "requires", "modulates", "doc"})


class RefusedError(Exception):
    """A value that cannot be taken over; the message says why, for the person."""


def apply_table_edit(document: Document, payload: Payload) -> Outcome:
    """Do what the table asks for. A payload of another shape than expected does nothing."""
    jobs: dict[str, Callable[[Document, Payload], Outcome]] = {
        "set": _set,
        "toggle": _toggle,
        "add-state": _add_state,
        "add-transition": _add_transition,
        "remove": _remove,
        "move": _move,
    }
    job = jobs.get(str(payload.get("kind")))
    if job is None:
        return Outcome()
    try:
        return job(document, payload)
    except RefusedError as error:
        return Outcome(refused=str(error))
    except (KeyError, TypeError, ValueError, AttributeError):
        # Only the payload's own shape can raise these here: an old page, or somebody else's script.
        return Outcome(refused="that was not understood")


def _set(document: Document, payload: Payload) -> Outcome:
    column, value, base = (str(payload[name]) for name in ("column", "value", "base"))
    thing = thing_of_row(str(payload["row"]))
    now = _cell(document, thing, column)
    if column not in _TEXTS or len(value) > LONGEST:
        raise RefusedError("that is too long for a cell" if column in _TEXTS else "that cannot be changed here")
    if value == now:
        return Outcome()
    if now != base:
        raise RefusedError(f"it became '{now[:60]}' meanwhile: press Enter again to write yours over it")
    if thing.of == "states":
        return _set_in_state(document, thing.id, column, value)
    if thing.of == "common":
        raise RefusedError("this is edited in the inspector")
    return _set_in_decision(document, thing.id, column, value)


def _cell(document: Document, thing: Selected, column: str) -> str:
    """What a cell holds now.

    Raises:
        RefusedError: There is no such cell.
    """
    rows = table_of(document.design, ())["rows"]
    cells = next((row["cells"] for row in rows if thing_of_row(row["id"]) == thing), None)
    if cells is None:
        raise RefusedError("that row is gone")
    if column not in cells:
        raise RefusedError("that cannot be changed here")
    return str(cells[column])


def _set_in_state(document: Document, name: str, column: str, value: str) -> Outcome:
    if column == "name":
        return apply_gesture(document, {"kind": "rename", "of": "states", "id": name, "name": value})
    if column == "doc":
        document.edit("edit Doc", lambda design: update_state(design, name, lambda state: replace(state, doc=value)))
        return Outcome()
    aliases = _aliases(document.design, value)

    def change(state: State) -> State:
        if column == "requires":
            return replace(state, requires=aliases)
        known = {call.alias: call for call in state.modulates}
        return replace(state, modulates=tuple(known.get(alias, Call(alias=alias)) for alias in aliases))

    document.edit(f"edit {column.capitalize()}", lambda design: update_state(design, name, change))
    return Outcome()


def _aliases(design: Design, text: str) -> tuple[str, ...]:
    """The used components named in a text, separated by commas or spaces.

    Raises:
        RefusedError: One of them is not used in this design.
    """
    aliases = tuple(dict.fromkeys(text.replace(",", " ").split()))
    for alias in aliases:
        if design.use(alias) is None:
            known = ", ".join(use.alias for use in design.uses) or "none yet"
            raise RefusedError(f"'{alias[:40]}' is no component used here (there are: {known})")
    return aliases


def _set_in_decision(document: Document, key: str, column: str, value: str) -> Outcome:
    located = decision_at(document.design, path_of_key(key))
    assert located is not None
    decision, path = located.decision, located.path
    changed: Decision
    if column == "name":
        if not isinstance(decision, Transition):
            raise RefusedError("only a transition leads to another state")
        if document.design.state(value) is None:
            raise RefusedError(f"there is no state '{value[:40]}'")
        changed = replace(decision, to=value)
    elif column == "doc":
        changed = replace(decision, doc=value)
    else:
        text = value.strip()
        guard = decision.guard
        changed = replace(decision, guard=replace(guard, when=text) if column == "when" else replace(guard, after=text))
    label = {"name": "To"}.get(column, column.capitalize())
    document.edit(f"edit {label}", lambda design: replace_decision(design, path, changed))
    return Outcome()


def _toggle(document: Document, payload: Payload) -> Outcome:
    thing, column = thing_of_row(str(payload["row"])), str(payload["column"])
    _cell(document, thing, column)
    if column == "disabled":
        _toggle_disabled(document, thing)
    elif column == "final":
        document.edit("edit Final", lambda design: update_state(design, thing.id, _flip_final))
    elif column == "initial":
        if document.design.initial == thing.id:
            raise RefusedError("a design starts somewhere: mark another state as initial")
        document.edit("edit Initial", lambda design: replace(design, initial=thing.id))
    return Outcome()


def _toggle_disabled(document: Document, thing: Selected) -> None:
    states = [thing.id] if thing.of == "states" else []
    paths = [path_of_key(thing.id)] if thing.of == "transitions" else []
    flag = _cell(document, thing, "disabled") == "False"
    document.edit("disable" if flag else "enable", lambda design: disable(design, states, paths, flag=flag))


def _flip_final(state: State) -> State:
    return replace(state, final=not state.final)


def _add_state(document: Document, payload: Payload) -> Outcome:
    """A new state below the one the row belongs to."""
    name = free_name("State", {state.name for state in document.design.states})
    above = _source_of_row(str(payload.get("row") or ""))
    names = [state.name for state in document.design.states]
    index = names.index(above) + 1 if above in names else len(names)
    document.edit(f"add state {name}", lambda design: reorder_state(add_state(design, State(name=name)), name, index))
    return Outcome(select=(Selected(of="states", id=name),), rename=name)


def _add_transition(document: Document, payload: Payload) -> Outcome:
    """A new transition below the row, or at the end of its state's."""
    row = str(payload["row"])
    source, design = _source_of_row(row), document.design
    if source != COMMON and design.state(source) is None:
        raise RefusedError("that row is gone")
    target = next((state.name for state in design.states if state.name != source), source)
    if target == COMMON:
        raise RefusedError("there is no state yet that a transition could lead to")
    thing = thing_of_row(row)
    where = items_path(design, source)
    path = path_of_key(thing.id) if thing.of == "transitions" else None
    is_flat = path is not None and path[:-1] == where
    last = _count(design, source)
    index = int(path[-1]) + 1 if path is not None and is_flat else last

    def change(old: Design) -> Design:
        return reorder_decision(add_transition(old, source, target), (*where, last), index)

    document.edit(f"connect {source.lstrip('@')} to {target}", change)
    return Outcome(select=(Selected(of="transitions", id=transition_key((*where, index))),))


def _count(design: Design, source: str) -> int:
    state = design.state(source)
    return len(state.transitions if state else design.common.transitions)


def _remove(document: Document, payload: Payload) -> Outcome:
    thing = thing_of_row(str(payload["row"]))
    if thing.of == "states" and document.design.state(thing.id):
        document.edit(f"remove {thing.id}", lambda design: remove_states(design, [thing.id]))
    elif thing.of == "transitions" and document.has_decision(thing.id):
        document.edit("remove transition", lambda design: remove_decisions(design, [path_of_key(thing.id)]))
    else:
        raise RefusedError("that cannot be removed here")
    return Outcome()


def _move(document: Document, payload: Payload) -> Outcome:
    """A row earlier or later among its like."""
    thing, by = thing_of_row(str(payload["row"])), 1 if int(payload["by"]) > 0 else -1
    design = document.design
    if thing.of == "states" and design.state(thing.id):
        index = [state.name for state in design.states].index(thing.id) + by
        document.edit("change the order", lambda old: reorder_state(old, thing.id, index))
        return Outcome(select=(thing,))
    located = decision_at(design, path_of_key(thing.id)) if thing.of == "transitions" else None
    if located is None:
        raise RefusedError("that cannot be moved")
    path: Path = located.path
    moved = (*path[:-1], int(path[-1]) + by)
    if decision_at(design, moved) is None:
        return Outcome()
    document.edit("change the order", lambda old: reorder_decision(old, path, int(moved[-1])))
    return Outcome(select=(Selected(of="transitions", id=transition_key(moved)),))


def _source_of_row(row: str) -> str:
    """The state a row belongs to, or COMMON."""
    return thing_of_row(row).id.split("/")[0]
