"""Data exchanged with the canvas in the browser: scenes and scene changes to it, gestures from it."""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypedDict, get_args

from vicode.decoding import MalformedEventError, decode, decode_event
from vicode.editor.session.gestures.canvas_gestures import EDIT_GESTURES
from vicode.editor.session.gestures.edits import RequestedEdit
from vicode.editor.view import ItemRef


class RemoteUser(TypedDict):
    """Another user: color number, selection, and pointer position (None: outside the canvas)."""

    name: str
    color: int
    items: list[dict[str, str]]
    pointer: dict[str, float] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class SelectGesture:
    """The user changed the selection; `items` may be empty."""

    kind: ClassVar = "select"
    items: tuple[ItemRef, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenGesture:
    """Open an element that is not renamed in place (double-click or Enter): its guard, design or code."""

    kind: ClassVar = "open"
    item: ItemRef
    is_open: bool = field(default=False, metadata={"json": "isOpen"})
    """Whether the browser has opened it already."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CopyGesture:
    """Request the elements as text for the clipboard; `write_clipboard` answers."""

    kind: ClassVar = "copy"
    items: tuple[ItemRef, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PasteGesture:
    """Insert a text from the clipboard into the design, centered at (x, y)."""

    kind: ClassVar = "paste"
    text: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class UseGesture:
    """Add a component at (x, y): the one at the address of a dropped link, or one that the user chooses."""

    kind: ClassVar = "use"
    address: str | None
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandGesture:
    """Run a command of the page."""

    kind: ClassVar = "command"
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TooltipGesture:
    """A tooltip opened for an element; `show_tooltip` may add sections to it."""

    kind: ClassVar = "tooltip"
    item: ItemRef


@dataclass(frozen=True, slots=True, kw_only=True)
class InsideGesture:
    """Show the machines of a used component, or of those that a state uses, in place, or stop showing them."""

    kind: ClassVar = "inside"
    item: ItemRef
    shown: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class InsideEditGesture:
    """Edit a component that is shown in place: `edit` is a gesture on its design of revision `seen`, undo or redo."""

    kind: ClassVar = "inside-edit"
    component: str
    seen: int
    edit: dict[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewGesture:
    """The user accepted (Enter) or rejected (Escape) a layout preview."""

    kind: ClassVar = "preview"
    accepted: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class StateRenamedGesture:
    """Another user renamed a state while its rename field is open."""

    kind: ClassVar = "state-renamed"
    old: str
    new: str


PageGesture = (
    SelectGesture
    | OpenGesture
    | CopyGesture
    | PasteGesture
    | UseGesture
    | CommandGesture
    | TooltipGesture
    | InsideGesture
    | InsideEditGesture
    | PreviewGesture
    | StateRenamedGesture
)
Gesture = PageGesture | RequestedEdit
GESTURES: Mapping[str, type[Gesture]] = {gesture.kind: gesture for gesture in (*get_args(PageGesture), *EDIT_GESTURES)}
"""The gestures that the canvas may report, by kind: those that the page handles, and edits of the design."""


@dataclass(frozen=True, slots=True)
class GestureReport:
    """A gesture from the browser."""

    gesture: Gesture
    rev: int
    """Revision of the scene in which it was made."""
    seq: int
    """Number of selections that the user has made so far, including one by this gesture."""


OnGesture = Callable[[GestureReport], Awaitable[None] | None]
OnPointer = Callable[[tuple[float, float] | None], None]


def decode_gesture(payload: object) -> GestureReport:
    """Decode a gesture from the browser.

    Raises:
        MalformedEventError: The kind is unknown, or the fields do not match its declaration.
    """
    if not isinstance(payload, dict):
        raise MalformedEventError("a gesture must be an object")
    fields = dict(payload)
    rev, seq = (decode(fields.pop(name, None), int, name) for name in ("rev", "seq"))
    return GestureReport(decode_event(fields, GESTURES), rev, seq)


def item_json(item: ItemRef) -> dict[str, str]:
    """Return a reference to an element of the scene in the form that the browser receives."""
    return {"of": item.kind, "id": item.id}
