"""The scene as Python builds it and `editor/canvas/js` draws it: JSON values, checked on both sides.

mypy checks the builders in `scene.py`; `tests/editor/view/test_scene_types.py` checks that the canvas reads these keys
and no others.
"""

from typing import Literal, NotRequired, TypedDict

SceneList = Literal["states", "transitions", "components", "links", "frames", "notes"]
SCENE_LISTS: tuple[SceneList, ...] = ("states", "transitions", "components", "links", "frames", "notes")


class ScenePlace(TypedDict):
    """The center of an item, in world units."""

    x: float
    y: float


class SceneMarks(TypedDict):
    """The findings of an item: the worst severity, the number of findings of this severity, and all messages."""

    severity: str | None
    count: int
    messages: list[str]


class SceneDesignState(SceneMarks):
    """What the design says of a state; `requires` and `modulates` are numbers of components."""

    id: str
    name: str
    initial: bool
    final: bool
    color: str
    disabled: bool
    enter: bool
    actions: bool
    leave: bool
    requires: int
    modulates: int
    doc: str


class SceneState(ScenePlace, SceneDesignState):
    """A state."""

    outside: bool
    """Whether its generated code was edited outside of regions."""
    unfinished: bool
    """Whether its findings are gray, as the drawing is not finished."""
    dead: bool
    """Whether it can never be active."""


class SceneTransition(SceneMarks):
    """A transition; `source` may be `@common`, `order` is its place among the `of` transitions of its source."""

    id: str
    source: str
    target: str
    label: str
    guard: str | None
    """As it is edited on the label; None if it is code, or derived."""
    order: int
    of: int
    disabled: bool
    dead: bool
    """Whether it can never be taken."""
    derived: bool
    """Whether an interrupt, a competence or layers mean it."""
    also: list[str]
    """The ids of other transitions that it stands for."""
    leads_back: bool
    """Whether it has an arrowhead at both ends."""
    label_at: list[float] | None
    kind: str
    doc: str


class SceneComponent(ScenePlace, SceneMarks):
    """A used component: `id` is its alias, `name` that of the component; `parameters` is None if unknown."""

    id: str
    name: str
    design: bool
    parameters: int | None


class SceneLink(TypedDict):
    """A state requires or modulates a component; both are ids."""

    id: str
    kind: str
    state: str
    component: str


class SceneFrame(SceneMarks):
    """A frame around states; `side` and `top` are its padding, as frames may contain others of a lower `level`."""

    id: str
    name: str
    color: str
    states: list[str]
    level: int
    side: float
    top: float


class SceneNote(ScenePlace):
    """A note: its text and the lines that are drawn."""

    id: str
    name: str
    lines: list[str]
    w: float
    h: float


class SceneCommon(ScenePlace, SceneMarks):
    """The badge of the common transitions: their number, and whether there are common actions."""

    transitions: int
    actions: bool


SceneItem = SceneState | SceneTransition | SceneComponent | SceneLink | SceneFrame | SceneNote


class Scene(TypedDict):
    """What the canvas draws of a design."""

    rev: int
    component: str
    doc: str
    states: list[SceneState]
    transitions: list[SceneTransition]
    components: list[SceneComponent]
    links: list[SceneLink]
    frames: list[SceneFrame]
    notes: list[SceneNote]
    common: SceneCommon | None


class SceneChanges(TypedDict):
    """The way from one scene to the next: items to add or replace, and ids to remove; `common` only if it changed."""

    rev: int
    upsert: dict[SceneList, list[SceneItem]]
    remove: dict[SceneList, list[str]]
    common: NotRequired[SceneCommon | None]
