"""Keeps elements without a position in the file where they are shown while others are added, removed or connected."""

from vicode.diagram.drawn_transitions import shows_common
from vicode.diagram.layered_layout import complete_layout
from vicode.model.design import Design, Point
from vicode.model.edits import move_nodes
from vicode.model.merge import find_renamed_states, find_renamed_uses


def keep_positions(before: Design, after: Design) -> Design:
    """`after`, in which the elements of `before` get the positions that they had if the layout would move one."""
    if _layout_inputs(before) == _layout_inputs(after):
        return after
    shown, now = complete_layout(before), complete_layout(after)
    states = _shown_positions(
        shown.states, find_renamed_states(before, after), {each.name: each.at for each in after.states}
    )
    uses = _shown_positions(shown.uses, find_renamed_uses(before, after), {each.alias: each.at for each in after.uses})
    common = shown.common if shows_common(before) and not after.common.at else None
    if states.items() <= now.states.items() and uses.items() <= now.uses.items() and common in (None, now.common):
        return after
    return move_nodes(after, _rounded(states), _rounded(uses), common and _round(common))


def _layout_inputs(design: Design) -> tuple[object, ...]:
    states = [(state.name, state.at, state.transitions) for state in design.states]
    return (states, design.uses, design.common, design.initial)


def _shown_positions(
    shown: dict[str, Point], new_names: dict[str, str], positions: dict[str, Point | None]
) -> dict[str, Point]:
    """The positions at which elements were shown that have none in the file."""
    renamed = {new_names.get(name, name): at for name, at in shown.items()}
    return {name: at for name, at in renamed.items() if name in positions and not positions[name]}


def _rounded(points: dict[str, Point]) -> dict[str, Point]:
    return {name: _round(at) for name, at in points.items()}


def _round(at: Point) -> Point:
    return (round(at[0]), round(at[1]))
