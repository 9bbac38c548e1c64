"""Data exchanged with the canvas in the browser: scenes and scene changes to it, gestures from it."""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Any, ClassVar, Literal, TypedDict, get_args

from vicode.editor.canvas.decoding import MalformedEventError, decode

# {"rev", "component", "states", "transitions", "components", "links", "common", …}, built by `vicode.editor.view`.
Scene = Mapping[str, Any]
# {"rev", "upsert": {kind: [items]}, "remove": {kind: [ids]}, "common" only if it changed}
SceneChanges = Mapping[str, Any]
ElementKind = Literal["states", "transitions", "components", "links", "common"]


class SceneItem(TypedDict):
    """Reference to an element of the scene."""

    of: ElementKind
    id: str


class RemoteUser(TypedDict):
    """Another user: color number, selection, and pointer position (None: outside the canvas)."""

    name: str
    colour: int
    items: list[SceneItem]
    pointer: dict[str, float] | None


class NodePosition(TypedDict):
    """A node and its center, in world units."""

    of: ElementKind
    id: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SelectGesture:
    """The user changed the selection; `items` may be empty."""

    kind: ClassVar = "select"
    rev: int
    items: tuple[SceneItem, ...]
    client_seq: int
    """Number of selections reported so far, including this one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveGesture:
    """The user moved nodes. The canvas already shows the new positions and accepts an echo or a correction."""

    kind: ClassVar = "move"
    rev: int
    items: tuple[NodePosition, ...]
    how: str
    """Command that moved them: "drag", "nudge", "align-left", …"""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeleteGesture:
    """Delete elements."""

    kind: ClassVar = "delete"
    rev: int
    items: tuple[SceneItem, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectGesture:
    """Add a transition. Without a target, create a state at (x, y) first. The source may be `@common`."""

    kind: ClassVar = "connect"
    rev: int
    source: str
    target: str | None
    x: float | None
    y: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ReconnectGesture:
    """Move one end of a transition to another state; the source may also become `@common`."""

    kind: ClassVar = "reconnect"
    rev: int
    id: str
    end: Literal["source", "target"]
    state: str


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkGesture:
    """Let a state require or modulate a component.

    A link drawn from the component is `requires`. A link drawn from the state is `modulates`, or `requires` if the
    component has `"parameters": 0` in the scene; without that key its parameters are unknown.
    """

    kind: ClassVar = "link"
    rev: int
    kind_of_link: Literal["requires", "modulates"]
    state: str
    component: str


@dataclass(frozen=True, slots=True, kw_only=True)
class CreateGesture:
    """Create a state with its center at (x, y)."""

    kind: ClassVar = "create"
    rev: int
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RenameGesture:
    """Rename a state or a component's alias. The name is not empty, but may be taken or invalid."""

    kind: ClassVar = "rename"
    rev: int
    of: Literal["states", "components"]
    id: str
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenGesture:
    """Open an element that is not renamed in place (double-click or Enter): its guard, design or code."""

    kind: ClassVar = "open"
    rev: int
    of: ElementKind
    id: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DisableGesture:
    """Disable states and transitions; enable them if all of them are disabled."""

    kind: ClassVar = "disable"
    rev: int
    items: tuple[SceneItem, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CopyGesture:
    """Request the elements as text for the clipboard; `write_clipboard` answers."""

    kind: ClassVar = "copy"
    rev: int
    items: tuple[SceneItem, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PasteGesture:
    """Insert a text from the clipboard into the design, centered at (x, y)."""

    kind: ClassVar = "paste"
    rev: int
    text: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class DuplicateGesture:
    """Duplicate elements at a small offset."""

    kind: ClassVar = "duplicate"
    rev: int
    items: tuple[SceneItem, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReorderGesture:
    """Change the priority of a transition: by -1 or 1 (`by`), or to the priority of the transition `onto`."""

    kind: ClassVar = "reorder"
    rev: int
    id: str
    by: int | None = None
    onto: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelGesture:
    """Position a label: fraction along the curve (0 to 1) and offset from it in pixels; None: automatic."""

    kind: ClassVar = "label"
    rev: int
    id: str
    at: tuple[float, float] | None
    by: Literal["nudge"] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StateFlagGesture:
    """Make a state the initial state, or toggle whether it is final."""

    kind: ClassVar = "mark"
    rev: int
    mark: Literal["initial", "final"]
    id: str


@dataclass(frozen=True, slots=True, kw_only=True)
class UseGesture:
    """Add a component at (x, y): the one at the address of a dropped link, or one that the user chooses."""

    kind: ClassVar = "use"
    rev: int
    address: str | None
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandGesture:
    """Run a command of the page."""

    kind: ClassVar = "command"
    rev: int
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TooltipGesture:
    """A tooltip opened for an element; `show_tooltip` may add sections to it."""

    kind: ClassVar = "tooltip"
    rev: int
    of: ElementKind
    id: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewGesture:
    """The user accepted (Enter) or rejected (Escape) a layout preview."""

    kind: ClassVar = "preview"
    rev: int
    accepted: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class StateRenamedGesture:
    """Another user renamed a state while its rename field is open; `name` is the old name, `id` the new one."""

    kind: ClassVar = "state-renamed"
    rev: int
    of: Literal["states"]
    id: str
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class UndoGesture:
    """Ctrl+Z was pressed on the canvas."""

    kind: ClassVar = "undo"
    rev: int


@dataclass(frozen=True, slots=True, kw_only=True)
class RedoGesture:
    """Ctrl+Shift+Z or Ctrl+Y was pressed on the canvas."""

    kind: ClassVar = "redo"
    rev: int


Gesture = (
    SelectGesture
    | MoveGesture
    | DeleteGesture
    | ConnectGesture
    | ReconnectGesture
    | LinkGesture
    | CreateGesture
    | RenameGesture
    | OpenGesture
    | DisableGesture
    | CopyGesture
    | PasteGesture
    | DuplicateGesture
    | ReorderGesture
    | LabelGesture
    | StateFlagGesture
    | UseGesture
    | CommandGesture
    | TooltipGesture
    | PreviewGesture
    | StateRenamedGesture
    | UndoGesture
    | RedoGesture
)
GESTURES: Mapping[str, type[Gesture]] = {gesture.kind: gesture for gesture in get_args(Gesture)}
"""The gestures that the canvas may report, by kind."""

OnGesture = Callable[[Gesture], Awaitable[None] | None]
OnPointer = Callable[[tuple[float, float] | None], None]


def decode_gesture(payload: object) -> Gesture:
    """Decode a gesture from the browser.

    Raises:
        MalformedEventError: The kind is unknown, or the fields do not match its declaration.
    """
    if not isinstance(payload, dict):
        raise MalformedEventError("a gesture must be an object")
    kind = payload.get("kind")
    gesture = GESTURES.get(kind) if isinstance(kind, str) else None
    if gesture is None:
        raise MalformedEventError(f"unknown kind of gesture: {kind!r:.40}")
    return decode({name: value for name, value in payload.items() if name != "kind"}, gesture, gesture.kind)


def gesture_payload(gesture: Gesture) -> dict[str, Any]:
    """Return a gesture as a mapping for `vicode.editor.session`, without the optional fields that have no value."""
    payload: dict[str, Any] = {"kind": gesture.kind}
    for field in fields(gesture):
        value = getattr(gesture, field.name)
        if value is not None or field.default is MISSING:
            payload[field.name] = list(value) if isinstance(value, tuple) else value
    return payload
