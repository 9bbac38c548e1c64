"""Where two scenes differ: what changed, moved, came or went, but not where findings differ."""

from dataclasses import replace

from vicode.editor.view import make_scene
from vicode.editor.view.changed_places import find_changed_places
from vicode.model.design import Design, State, Transition
from vicode.model.edits import add_transition, remove_states, set_disabled
from vicode.model.project import Project

DESIGN = Design(
    component="Player",
    initial="A",
    states=(
        State(name="A", at=(0, 0), transitions=(Transition(to="B"),)),
        State(name="B", at=(400, 0)),
        State(name="C", at=(2000, 900)),
    ),
)


def places(before: Design, after: Design) -> list[tuple[float, float]]:
    old, new = (make_scene(Project(name="p", designs=(each,)), each, (), 0) for each in (before, after))
    old["states"][0]["messages"] = ["only before"]
    return [(x, y) for x, y in find_changed_places(old, new)]


def test_equal_drawings_have_no_changed_place() -> None:
    assert places(DESIGN, DESIGN) == []


def test_changed_moved_and_removed_items_are_found() -> None:
    assert places(DESIGN, set_disabled(DESIGN, ["C"], [], disabled=True)) == [(2000, 900)]
    moved = replace(DESIGN, states=(*DESIGN.states[:2], replace(DESIGN.states[2], at=(700, 0))))
    assert places(DESIGN, moved) == [(700, 0)]
    assert places(DESIGN, remove_states(DESIGN, ["C"])) == [(2000, 900)]


def test_a_transition_is_between_its_states() -> None:
    assert (1000, 450) in places(DESIGN, add_transition(DESIGN, "A", "C"))
