"""The shapes that cross the border between Python and the canvas: scenes and changes down, gestures up."""

from collections.abc import Awaitable, Callable, Mapping
from typing import Any, Literal, NotRequired, TypedDict

Scene = Mapping[
    str, Any
]  # {"rev", "component", "states", "transitions", "components", "links", "common", …}, built by the editor's view
Changes = Mapping[str, Any]  # {"rev", "upsert": {kind: [things]}, "remove": {kind: [ids]}, "common" only if it changed}
Kind = Literal["states", "transitions", "components", "links", "common"]


class Item(TypedDict):
    """A thing in the scene."""

    of: Kind
    id: str


class Place(TypedDict):
    """A node and the centre it was moved to, in world units."""

    of: Kind
    id: str
    x: float
    y: float


class Select(TypedDict):
    """The selection changed by hand; empty when nothing is selected any more."""

    kind: Literal["select"]
    rev: int
    items: list[Item]


class Move(TypedDict):
    """Nodes were moved; the canvas already shows them there and accepts the echo (or a correction)."""

    kind: Literal["move"]
    rev: int
    items: list[Place]


class Delete(TypedDict):
    """The selected things are to go."""

    kind: Literal["delete"]
    rev: int
    items: list[Item]


class Connect(TypedDict):
    """A new transition; without a target, a new state is wanted at (x, y) first. The source may be `@common`."""

    kind: Literal["connect"]
    rev: int
    source: str
    target: str | None
    x: float | None
    y: float | None


class Reconnect(TypedDict):
    """One end of a transition was taken to another state (or, the source only, to `@common`)."""

    kind: Literal["reconnect"]
    rev: int
    id: str
    end: Literal["source", "target"]
    state: str


class Link(TypedDict):
    """A state is to require or to modulate a component.

    Drawn from the component it means `requires`. Drawn from the state it means `modulates`, but `requires` where the
    scene's component says `"parameters": 0`; without that key its parameters are unknown.
    """

    kind: Literal["link"]
    rev: int
    kind_of_link: Literal["requires", "modulates"]
    state: str
    component: str


class Create(TypedDict):
    """A new state is wanted with its centre at (x, y)."""

    kind: Literal["create"]
    rev: int
    x: float
    y: float


class Rename(TypedDict):
    """A state (or a component's alias) got another name; it is never empty, but may be taken or no name at all."""

    kind: Literal["rename"]
    rev: int
    of: Literal["states", "components"]
    id: str
    name: str


class Open(TypedDict):
    """A double click (or Enter) on something that is not renamed: show it, its design or its code."""

    kind: Literal["open"]
    rev: int
    of: Kind
    id: str


class Disable(TypedDict):
    """States and transitions are to be disabled, or enabled when all of them are disabled."""

    kind: Literal["disable"]
    rev: int
    items: list[Item]


class History(TypedDict):
    """Ctrl+Z, Ctrl+Shift+Z or Ctrl+Y were pressed on the canvas."""

    kind: Literal["undo", "redo"]
    rev: int
    note: NotRequired[str]


Gesture = Select | Move | Delete | Connect | Reconnect | Link | Create | Rename | Open | Disable | History
OnGesture = Callable[[Gesture], Awaitable[None] | None]
