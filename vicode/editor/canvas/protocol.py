"""The shapes that cross the border between Python and the canvas: scenes and changes down, gestures up."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Literal, NotRequired, TypedDict

Scene = Mapping[
    str, Any
]  # {"rev", "component", "states", "transitions", "components", "links", "common", …}, built by the editor's view
SceneChanges = Mapping[
    str, Any
]  # {"rev", "upsert": {kind: [things]}, "remove": {kind: [ids]}, "common" only if it changed}
ElementKind = Literal["states", "transitions", "components", "links", "common"]


class SceneItem(TypedDict):
    """A thing in the scene."""

    of: ElementKind
    id: str


class RemoteUser(TypedDict):
    """Another person: the number of a colour, what is selected there, where the pointer is (None: nowhere here)."""

    name: str
    colour: int
    items: list[SceneItem]
    pointer: dict[str, float] | None


class NodePosition(TypedDict):
    """A node and the centre it was moved to, in world units."""

    of: ElementKind
    id: str
    x: float
    y: float


class SelectGesture(TypedDict):
    """The selection changed by hand; empty when nothing is selected any more."""

    kind: Literal["select"]
    rev: int
    items: list[SceneItem]
    client_seq: int
    """How many selections by hand were told, this one included."""


class MoveGesture(TypedDict):
    """Nodes were moved; the canvas already shows them there and accepts the echo (or a correction)."""

    kind: Literal["move"]
    rev: int
    items: list[NodePosition]
    how: str
    """By which command: "drag", "nudge", "align-left" …"""


class DeleteGesture(TypedDict):
    """The selected things are to go."""

    kind: Literal["delete"]
    rev: int
    items: list[SceneItem]


class ConnectGesture(TypedDict):
    """A new transition; without a target, a new state is wanted at (x, y) first. The source may be `@common`."""

    kind: Literal["connect"]
    rev: int
    source: str
    target: str | None
    x: float | None
    y: float | None


class ReconnectGesture(TypedDict):
    """One end of a transition was taken to another state (or, the source only, to `@common`)."""

    kind: Literal["reconnect"]
    rev: int
    id: str
    end: Literal["source", "target"]
    state: str


class LinkGesture(TypedDict):
    """A state is to require or to modulate a component.

    Drawn from the component it means `requires`. Drawn from the state it means `modulates`, but `requires` where the
    scene's component says `"parameters": 0`; without that key its parameters are unknown.
    """

    kind: Literal["link"]
    rev: int
    kind_of_link: Literal["requires", "modulates"]
    state: str
    component: str


class CreateGesture(TypedDict):
    """A new state is wanted with its centre at (x, y)."""

    kind: Literal["create"]
    rev: int
    x: float
    y: float


class RenameGesture(TypedDict):
    """A state (or a component's alias) got another name; it is never empty, but may be taken or no name at all."""

    kind: Literal["rename"]
    rev: int
    of: Literal["states", "components"]
    id: str
    name: str


class OpenGesture(TypedDict):
    """A double click (or Enter) on something that is not renamed: show it, its design or its code."""

    kind: Literal["open"]
    rev: int
    of: ElementKind
    id: str


class DisableGesture(TypedDict):
    """States and transitions are to be disabled, or enabled when all of them are disabled."""

    kind: Literal["disable"]
    rev: int
    items: list[SceneItem]


class CopyGesture(TypedDict):
    """The text of these things is wanted for the clipboard; `write_clipboard` answers."""

    kind: Literal["copy"]
    rev: int
    items: list[SceneItem]


class PasteGesture(TypedDict):
    """A text from the clipboard is to become part of the design, its middle at (x, y)."""

    kind: Literal["paste"]
    rev: int
    text: str
    x: float
    y: float


class DuplicateGesture(TypedDict):
    """The selected things are wanted once more, a little beside."""

    kind: Literal["duplicate"]
    rev: int
    items: list[SceneItem]


class ReorderGesture(TypedDict):
    """A transition is to be tested earlier or later: `by` -1 or 1, or where the transition `onto` is tested now."""

    kind: Literal["reorder"]
    rev: int
    id: str
    by: NotRequired[int]
    onto: NotRequired[str]


class LabelGesture(TypedDict):
    """A label was put on a part of the way (0 to 1) and pixels beside it; None: wherever there is room."""

    kind: Literal["label"]
    rev: int
    id: str
    at: tuple[float, float] | None


class StateFlagGesture(TypedDict):
    """A state is to be the initial one, or final or no longer so."""

    kind: Literal["mark"]
    rev: int
    mark: Literal["initial", "final"]
    id: str


class UseGesture(TypedDict):
    """A component is to be used at (x, y): the one a dropped link leads to, else one to be chosen."""

    kind: Literal["use"]
    rev: int
    address: str | None
    x: float
    y: float


class CommandGesture(TypedDict):
    """A command of the page is wanted, by its name."""

    kind: Literal["command"]
    rev: int
    name: str


class TooltipGesture(TypedDict):
    """The pointer or the keys rest on a thing: its card is shown, and `show_tooltip` may tell more of it."""

    kind: Literal["tooltip"]
    rev: int
    of: ElementKind
    id: str


class PreviewGesture(TypedDict):
    """Enter or Escape was pressed while other places are shown: they are wanted, or not."""

    kind: Literal["preview"]
    rev: int
    accepted: bool


class HistoryGesture(TypedDict):
    """Ctrl+Z, Ctrl+Shift+Z or Ctrl+Y were pressed on the canvas."""

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
