"""Data exchanged with the canvas in the browser: scenes and scene changes to it, gestures from it."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Literal, NotRequired, TypedDict

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


class SelectGesture(TypedDict):
    """The user changed the selection; `items` may be empty."""

    kind: Literal["select"]
    rev: int
    items: list[SceneItem]
    client_seq: int
    """Number of selections reported so far, including this one."""


class MoveGesture(TypedDict):
    """The user moved nodes. The canvas already shows the new positions and accepts an echo or a correction."""

    kind: Literal["move"]
    rev: int
    items: list[NodePosition]
    how: str
    """Command that moved them: "drag", "nudge", "align-left", …"""


class DeleteGesture(TypedDict):
    """Delete elements."""

    kind: Literal["delete"]
    rev: int
    items: list[SceneItem]


class ConnectGesture(TypedDict):
    """Add a transition. Without a target, create a state at (x, y) first. The source may be `@common`."""

    kind: Literal["connect"]
    rev: int
    source: str
    target: str | None
    x: float | None
    y: float | None


class ReconnectGesture(TypedDict):
    """Move one end of a transition to another state; the source may also become `@common`."""

    kind: Literal["reconnect"]
    rev: int
    id: str
    end: Literal["source", "target"]
    state: str


class LinkGesture(TypedDict):
    """Let a state require or modulate a component.

    A link drawn from the component is `requires`. A link drawn from the state is `modulates`, or `requires` if the
    component has `"parameters": 0` in the scene; without that key its parameters are unknown.
    """

    kind: Literal["link"]
    rev: int
    kind_of_link: Literal["requires", "modulates"]
    state: str
    component: str


class CreateGesture(TypedDict):
    """Create a state with its center at (x, y)."""

    kind: Literal["create"]
    rev: int
    x: float
    y: float


class RenameGesture(TypedDict):
    """Rename a state or a component's alias. The name is not empty, but may be taken or invalid."""

    kind: Literal["rename"]
    rev: int
    of: Literal["states", "components"]
    id: str
    name: str


class OpenGesture(TypedDict):
    """Open an element that is not renamed in place (double-click or Enter): its guard, design or code."""

    kind: Literal["open"]
    rev: int
    of: ElementKind
    id: str


class DisableGesture(TypedDict):
    """Disable states and transitions; enable them if all of them are disabled."""

    kind: Literal["disable"]
    rev: int
    items: list[SceneItem]


class CopyGesture(TypedDict):
    """Request the elements as text for the clipboard; `write_clipboard` answers."""

    kind: Literal["copy"]
    rev: int
    items: list[SceneItem]


class PasteGesture(TypedDict):
    """Insert a text from the clipboard into the design, centered at (x, y)."""

    kind: Literal["paste"]
    rev: int
    text: str
    x: float
    y: float


class DuplicateGesture(TypedDict):
    """Duplicate elements at a small offset."""

    kind: Literal["duplicate"]
    rev: int
    items: list[SceneItem]


class ReorderGesture(TypedDict):
    """Change the priority of a transition: by -1 or 1 (`by`), or to the priority of the transition `onto`."""

    kind: Literal["reorder"]
    rev: int
    id: str
    by: NotRequired[int]
    onto: NotRequired[str]


class LabelGesture(TypedDict):
    """Position a label: fraction along the curve (0 to 1) and offset from it in pixels; None: automatic."""

    kind: Literal["label"]
    rev: int
    id: str
    at: tuple[float, float] | None


class StateFlagGesture(TypedDict):
    """Make a state the initial state, or toggle whether it is final."""

    kind: Literal["mark"]
    rev: int
    mark: Literal["initial", "final"]
    id: str


class UseGesture(TypedDict):
    """Add a component at (x, y): the one at the address of a dropped link, or one that the user chooses."""

    kind: Literal["use"]
    rev: int
    address: str | None
    x: float
    y: float


class CommandGesture(TypedDict):
    """Run a command of the page."""

    kind: Literal["command"]
    rev: int
    name: str


class TooltipGesture(TypedDict):
    """A tooltip opened for an element; `show_tooltip` may add sections to it."""

    kind: Literal["tooltip"]
    rev: int
    of: ElementKind
    id: str


class PreviewGesture(TypedDict):
    """The user accepted (Enter) or rejected (Escape) a layout preview."""

    kind: Literal["preview"]
    rev: int
    accepted: bool


class HistoryGesture(TypedDict):
    """Ctrl+Z, Ctrl+Shift+Z or Ctrl+Y was pressed on the canvas."""

    kind: Literal["undo", "redo"]
    rev: int
    note: NotRequired[str]


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
    | HistoryGesture
)
OnGesture = Callable[[Gesture], Awaitable[None] | None]
OnPointer = Callable[[tuple[float, float] | None], None]
