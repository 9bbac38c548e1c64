"""Edits that a browser requests: their protocol and result, and steps that several of them share."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol

from vicode.editor.session import texts
from vicode.editor.session.document import DocumentSession
from vicode.editor.view import ItemRef
from vicode.model.design import Design, Guard, Point, State
from vicode.model.edits import add_state, add_transition, unique_name
from vicode.services.rename.name_errors import state_name_error

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


class RequestedEdit(Protocol):
    """An edit of a design; the items and values that it names may be invalid."""

    kind: ClassVar[str]

    def apply(self, document: DocumentSession) -> EditResult:
        """Edit the open design.

        Raises:
            EditError: The edit is invalid; nothing is changed.
        """


def apply_edit(document: DocumentSession, edit: RequestedEdit) -> EditResult:
    """Apply an edit; an invalid one, or one that would lose content of the file, changes nothing."""
    shared, notice, rev = document.shared, document.shared.notice, document.rev
    try:
        result = edit.apply(document)
    except EditError as error:
        return EditResult(error=str(error))
    is_refused = shared.notice is not notice and document.rev == rev
    return EditResult(error=shared.notice.text) if is_refused else result


def create_state(
    document: DocumentSession,
    at: Point,
    wanted: str = "",
    source: str = "",
    guard: Guard | None = None,
    *,
    select: bool = True,
) -> EditResult:
    """Add a state, and a transition from `source` to it if given. It gets a free name if the wanted one is invalid."""
    names = {state.name for state in document.design.states}
    error = state_name_error(wanted, names) if wanted else ""
    name = wanted if wanted and not error else unique_name("State", names)

    def change(design: Design) -> Design:
        grown = add_state(design, State(name=name, at=at))
        return add_transition(grown, source, name, guard) if source else grown

    document.edit(texts.add_state(name), change, coalesce_key=creation_key(document, name))
    if document.design.state(name) is None:
        return EditResult(error="the state was not added")
    return EditResult(new_selection=(ItemRef(kind="states", id=name),) if select else None, error=error)


def creation_key(document: DocumentSession, name: str) -> str:
    """The coalesce key of the creation of a state; its naming has the same."""
    return f"create {name} {document.rev}"


def naming_key(document: DocumentSession, name: str) -> str:
    """The coalesce key that merges the renaming of a state into its creation, if that is the latest edit."""
    latest = document.history.next_undo(document.user_id)
    key = latest.coalesce_key if latest else ""
    return key if key.rpartition(" ")[0] == f"create {name}" else ""


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
