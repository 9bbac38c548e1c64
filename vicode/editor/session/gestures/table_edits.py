"""Edits in the table: cells, new and removed rows, the order of rows.

`row` is the id of a row (see `vicode.editor.view.table`).
"""

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.session.gestures.canvas_gestures import RenameGesture
from vicode.editor.session.gestures.edits import EditError, EditResult, RequestedEdit, creation_key
from vicode.editor.view import ItemRef, make_table, parse_row_id
from vicode.findings import DesignPath
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import COMMON, Call, Decision, Design, State, Transition
from vicode.model.edits import (
    add_state,
    add_transition,
    decisions_path,
    remove_decisions,
    remove_states,
    reorder_decision,
    reorder_state,
    replace_decision,
    set_disabled,
    unique_name,
    update_state,
)
from vicode.model.guard_text import settle_guard
from vicode.model.traversal import find_decision

MAX_CELL_LENGTH = 20_000
TextColumn = Literal["name", "when", "after", "requires", "modulates", "doc"]
FlagColumn = Literal["initial", "final", "disabled"]


@dataclass(frozen=True, slots=True, kw_only=True)
class SetCell:
    """Change the text of a cell from `base` to `value`."""

    kind: ClassVar = "set"
    row: str
    column: TextColumn
    value: str
    base: str

    def apply(self, document: DocumentSession) -> EditResult:
        item = parse_row_id(self.row)
        now = _cell(document, item, self.column)
        if len(self.value) > MAX_CELL_LENGTH:
            raise EditError("this text is too long for a cell")
        if self.value == now:
            return EditResult()
        if now != self.base:
            raise EditError(f"the cell has changed to '{now[:60]}': press Enter again to overwrite it")
        if item.kind == "states":
            return _set_in_state(document, item.id, self.column, self.value)
        if item.kind == "common":
            raise EditError("edit this in the inspector")
        return _set_in_decision(document, item.id, self.column, self.value)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToggleFlag:
    """Toggle a flag."""

    kind: ClassVar = "toggle"
    row: str
    column: FlagColumn

    def apply(self, document: DocumentSession) -> EditResult:
        item, label = parse_row_id(self.row), texts.edit_cell(self.column)
        is_set = _cell(document, item, self.column) == "True"
        if self.column == "disabled":
            _set_disabled(document, item, disabled=not is_set)
        elif self.column == "final":
            document.edit(
                label, lambda design: update_state(design, item.id, lambda state: replace(state, final=not is_set))
            )
        elif is_set:
            raise EditError("a design needs an initial state: mark another state instead")
        else:
            document.edit(label, lambda design: replace(design, initial=item.id))
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class AddState:
    """Add a state below the state of the row."""

    kind: ClassVar = "add-state"
    row: str = ""

    def apply(self, document: DocumentSession) -> EditResult:
        names = [state.name for state in document.design.states]
        name, above = unique_name("State", set(names)), _source_of_row(self.row)
        index = names.index(above) + 1 if above in names else len(names)
        document.edit(
            texts.add_state(name),
            lambda design: reorder_state(add_state(design, State(name=name)), name, index),
            coalesce_key=creation_key(document, name),
        )
        return EditResult(new_selection=(ItemRef(kind="states", id=name),))


@dataclass(frozen=True, slots=True, kw_only=True)
class AddTransition:
    """Add a transition below the row, or at the end of its state."""

    kind: ClassVar = "add-transition"
    row: str

    def apply(self, document: DocumentSession) -> EditResult:
        source, design = _source_of_row(self.row), document.design
        state = design.state(source)
        if source != COMMON and state is None:
            raise EditError(texts.ROW_GONE)
        target = next((state.name for state in design.states if state.name != source), source)
        if target == COMMON:
            raise EditError("there is no state to connect to: add one first")
        item = parse_row_id(self.row)
        where = decisions_path(design, source)
        path = parse_transition_key(item.id) if item.kind == "transitions" else ()
        index = last = len(state.transitions if state else design.common.transitions)
        if path[:-1] == where and isinstance(path[-1], int):
            index = path[-1] + 1

        def change(old: Design) -> Design:
            return reorder_decision(add_transition(old, source, target), (*where, last), index)

        document.edit(texts.connect(source, target), change)
        return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key((*where, index))),))


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoveRow:
    """Remove a state or a decision."""

    kind: ClassVar = "remove"
    row: str

    def apply(self, document: DocumentSession) -> EditResult:
        item = parse_row_id(self.row)
        if item.kind == "states" and document.design.state(item.id):
            document.edit(f"remove {item.id}", lambda design: remove_states(design, [item.id]))
        elif item.kind == "transitions" and document.has_decision(item.id):
            path = parse_transition_key(item.id)
            document.edit("remove transition", lambda design: remove_decisions(design, [path]))
        else:
            raise EditError("this row cannot be removed")
        return EditResult()


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveRow:
    """Move a row up (-1) or down (1) in its list."""

    kind: ClassVar = "move"
    row: str
    by: int

    def apply(self, document: DocumentSession) -> EditResult:
        item, by, design = parse_row_id(self.row), 1 if self.by > 0 else -1, document.design
        if item.kind == "states" and design.state(item.id):
            index = [state.name for state in design.states].index(item.id) + by
            document.edit("reorder states", lambda old: reorder_state(old, item.id, index))
            return EditResult(new_selection=(item,))
        located = find_decision(design, parse_transition_key(item.id)) if item.kind == "transitions" else None
        if located is None:
            raise EditError("this row cannot be moved")
        path: DesignPath = located.path
        moved = (*path[:-1], int(path[-1]) + by)
        if find_decision(design, moved) is None:
            return EditResult()
        document.edit(texts.REORDER_TRANSITIONS, lambda old: reorder_decision(old, path, int(moved[-1])))
        return EditResult(new_selection=(ItemRef(kind="transitions", id=transition_key(moved)),))


TABLE_EDITS: tuple[type[RequestedEdit], ...] = (SetCell, ToggleFlag, AddState, AddTransition, RemoveRow, MoveRow)
"""The edits that the table requests."""


def _cell(document: DocumentSession, item: ItemRef, column: str) -> str:
    """The current content of a cell.

    Raises:
        EditError: There is no such cell.
    """
    rows = make_table(document.design, ())["rows"]
    cells = next((row["cells"] for row in rows if parse_row_id(row["id"]) == item), None)
    if cells is None:
        raise EditError(texts.ROW_GONE)
    if column not in cells:
        raise EditError("this cannot be changed here")
    return str(cells[column])


def _set_in_state(document: DocumentSession, name: str, column: str, value: str) -> EditResult:
    if column == "name":
        return RenameGesture(item=ItemRef(kind="states", id=name), name=value).apply(document)
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
        EditError: The design does not use one of them.
    """
    aliases = tuple(dict.fromkeys(text.replace(",", " ").split()))
    for alias in aliases:
        if design.use(alias) is None:
            raise EditError(texts.unknown_alias(alias, [use.alias for use in design.uses]))
    return aliases


def _set_in_decision(document: DocumentSession, key: str, column: str, value: str) -> EditResult:
    located = find_decision(document.design, parse_transition_key(key))
    assert located is not None
    decision, path = located.decision, located.path
    changed: Decision
    if column == "name":
        if not isinstance(decision, Transition):
            raise EditError("only a transition has a target")
        if document.design.state(value) is None:
            raise EditError(texts.unknown_state(value))
        changed = replace(decision, to=value)
    elif column == "doc":
        changed = replace(decision, doc=value)
    else:
        text = value.strip()
        guard = replace(decision.guard, when=text) if column == "when" else replace(decision.guard, after=text)
        changed = replace(decision, guard=settle_guard(guard, document.design.time_unit))
    document.edit(texts.edit_cell(column), lambda design: replace_decision(design, path, changed))
    return EditResult()


def _set_disabled(document: DocumentSession, item: ItemRef, *, disabled: bool) -> None:
    states = [item.id] if item.kind == "states" else []
    paths = [parse_transition_key(item.id)] if item.kind == "transitions" else []
    label = texts.set_disabled(states, len(paths), disabled=disabled)
    document.edit(label, lambda design: set_disabled(design, states, paths, disabled=disabled))


def _source_of_row(row: str) -> str:
    return parse_row_id(row).id.split("/")[0]
