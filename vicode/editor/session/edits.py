"""Edits that a browser requests: their protocol and result, and steps that several of them share."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.view import ItemRef
from vicode.model.design import Design, Point, State
from vicode.model.edits import add_state, add_transition, unique_name

_MAX_COORDINATE = 1_000_000

# Fields of these types follow the item when a gesture is rebased; the name of the common section stays.
StateName = Annotated[str, "states"]
ComponentAlias = Annotated[str, "components"]
TransitionKey = Annotated[str, "transitions"]


class EditError(Exception):
    """An invalid edit, with a message for the user."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EditResult:
    """The result of an edit; `error` and `note` are messages for the user."""

    new_selection: tuple[ItemRef, ...] | None = None
    """None keeps the selection."""
    error: str = ""
    note: str = ""
    state_to_rename: str = ""
    """The new state whose name field gets the focus."""


class RequestedEdit(Protocol):
    """An edit of a design; the items and values that it names may be invalid."""

    kind: ClassVar[str]

    def apply(self, document: DocumentSession) -> EditResult:
        """Edit the open design.

        Raises:
            EditError: The edit is invalid; nothing is changed.
        """


def apply_edit(document: DocumentSession, edit: RequestedEdit) -> EditResult:
    """Apply an edit; an invalid one changes nothing."""
    try:
        return edit.apply(document)
    except EditError as error:
        return EditResult(error=str(error))


def create_state(document: DocumentSession, at: Point, source: str = "") -> EditResult:
    """Add a state with a free name, and a transition from `source` to it if given."""
    name = unique_name("State", {state.name for state in document.design.states})

    def change(design: Design) -> Design:
        grown = add_state(design, State(name=name, at=at))
        return add_transition(grown, source, name) if source else grown

    document.edit(texts.add_state(name), change)
    return EditResult(new_selection=(ItemRef(kind="states", id=name),), state_to_rename=name)


def canvas_point(x: float, y: float) -> Point:
    """The nearest position on the canvas, in whole pixels."""
    limit = _MAX_COORDINATE
    return (round(max(-limit, min(x, limit))), round(max(-limit, min(y, limit))))


def require_state(document: DocumentSession, name: str) -> State:
    """The state of this name.

    Raises:
        EditError: There is no such state.
    """
    state = document.design.state(name)
    if state is None:
        raise EditError(texts.INVALID_REQUEST)
    return state
