"""Frames around states: their rectangles, and their nesting for formats and layouts whose groups cannot overlap."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field

from vicode.diagram.spatial_index import Rect
from vicode.model.design import Design, DiagramFrame

TITLE_HEIGHT = 28.0
_SIDE, _SIDE_STEP = 24.0, 16.0


@dataclass(frozen=True, slots=True, kw_only=True)
class FramePadding:
    """Pixels between the states of a frame and its border."""

    side: float
    top: float


@dataclass(slots=True, kw_only=True)
class FrameGroup:
    """A frame in a tree, in which every state is in one innermost group; `members` includes those of the groups."""

    name: str
    members: set[str]
    groups: "list[FrameGroup]" = field(default_factory=list)

    @property
    def own_states(self) -> set[str]:
        """The states that are in none of the inner groups."""
        return self.members.difference(*(group.members for group in self.groups))


def drawn_frames(
    design: Design, only: Collection[str] | None = None
) -> list[tuple[DiagramFrame, tuple[str, ...], int]]:
    """The frames back to front, each with its states that exist (and are in `only`), and its level of nesting."""
    known = {state.name for state in design.states if only is None or state.name in only}
    frames = [(frame, tuple(name for name in dict.fromkeys(frame.states) if name in known)) for frame in design.frames]
    levels = _levels([frozenset(states) for _frame, states in frames])
    drawn = [(frame, states, level) for (frame, states), level in zip(frames, levels, strict=True) if states]
    return sorted(drawn, key=lambda each: -each[2])


def frame_padding(level: int) -> FramePadding:
    """An outer frame leaves room for the borders and titles of the frames inside."""
    side = _SIDE + level * _SIDE_STEP
    return FramePadding(side=side, top=side + (level + 1) * TITLE_HEIGHT)


def frame_rect(boxes: Iterable[Rect], padding: FramePadding) -> Rect:
    """The rectangle of a frame around the boxes of its states."""
    found = tuple(boxes)
    return Rect(
        min(box.left for box in found) - padding.side,
        min(box.top for box in found) - padding.top,
        max(box.right for box in found) + padding.side,
        max(box.bottom for box in found) + padding.side,
    )


def nest_frames(design: Design, only: Collection[str] | None = None) -> list[FrameGroup]:
    """The frames as a tree. A state of overlapping frames is in the larger one."""
    roots: list[FrameGroup] = []
    for frame, states, _level in sorted(drawn_frames(design, only), key=lambda each: -len(each[1])):
        _insert(roots, FrameGroup(name=frame.name, members=set(states)))
    return roots


def _insert(groups: list[FrameGroup], new: FrameGroup) -> None:
    around = next((group for group in groups if new.members <= group.members), None)
    if around is not None:
        _insert(around.groups, new)
        return
    new.members.difference_update(*(group.members for group in groups))
    if new.members:
        groups.append(new)


def _levels(sets: list[frozenset[str]]) -> list[int]:
    """The number of frames inside one another in each frame; of equal ones the first is outside."""
    levels = [0] * len(sets)
    for index in sorted(range(len(sets)), key=lambda index: (len(sets[index]), -index)):
        inner = (
            levels[other]
            for other in range(len(sets))
            if sets[other] and (sets[other] < sets[index] or (sets[other] == sets[index] and other > index))
        )
        levels[index] = 1 + max(inner, default=-1)
    return levels
