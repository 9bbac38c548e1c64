"""Diagrams of differences: each changed element has a sign, and removed ones are drawn, too."""

from dataclasses import replace

import pytest
from hypothesis import given, settings

from tests.strategies.designs import designs
from vicode.diagram.diff_diagram import DARK_DIFF, LIGHT_DIFF, css_variable_diff, render_diff
from vicode.diagram.primitives import PathShape, ShapeGroup, TextShape
from vicode.diagram.svg import write_svg
from vicode.model.design import DecisionGroup, Design, Guard, State, Transition, Use
from vicode.model.edits import add_state, remove_states, rename_state, update_state
from vicode.store import read_design

BASE = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="ball", component="Ball", at=(300, 300)),),
    states=(
        State(
            name="A",
            at=(0, 0),
            requires=("ball",),
            transitions=(
                Transition(to="B", guard=Guard(when="x")),
                DecisionGroup(guard=Guard(when="y"), then=(Transition(to="B"), Transition(to="C"))),
            ),
        ),
        State(name="B", at=(200, 0), transitions=(Transition(to="A"),)),
        State(name="C", at=(0, 200), transitions=(Transition(to="A"),)),
    ),
)


def signs(old: Design, new: Design) -> list[tuple[str, str]]:
    """The signs of the diagram with the first lines of their tooltips, without the legend."""
    groups = [group for group in render_diff(old, new).groups if group.css_class == "mark" and group.title]
    return sorted((text_of(group), group.title.split("\n")[0]) for group in groups if text_of(group))


def text_of(group: ShapeGroup) -> str:
    return "".join(shape.text for shape in group.shapes if isinstance(shape, TextShape))


GUARDED = update_state(
    BASE,
    "A",
    lambda state: replace(state, transitions=(Transition(to="B", guard=Guard(when="z")), state.transitions[1])),
)
UNGROUPED = update_state(BASE, "A", lambda state: replace(state, transitions=state.transitions[:1]))


@pytest.mark.parametrize(
    ("new", "expected"),
    [
        (BASE, []),
        (
            add_state(BASE, State(name="D", at=(9, 9), transitions=(Transition(to="A"),))),
            [("+", "+ state D: 1 transition"), ("+", "+ state D: 1 transition")],
        ),
        (GUARDED, [("~", "~ guard A → B: x → z")]),
        (
            UNGROUPED,
            [("−", "- decision of A: when y: → B, → C"), ("−", "- decision of A: when y: → B, → C")],
        ),
        (
            replace(BASE, states=BASE.states[:2]),
            [("−", "- state C: 1 transition"), ("−", "removed")],
        ),
        (
            update_state(BASE, "B", lambda state: replace(state, at=(200, 90))),
            [(">", "> moved state B: 200, 0 → 200, 90")],
        ),
        (rename_state(BASE, "B", "Z"), [("=", "= renamed state B → Z")]),
        (
            update_state(BASE, "A", lambda state: replace(state, requires=())),
            [("−", "- requirement ball of state A")],
        ),
    ],
)
def test_each_changed_element_has_a_sign(new: Design, expected: list[tuple[str, str]]) -> None:
    assert signs(BASE, new) == expected


def test_removed_elements_are_dashed_and_struck_through() -> None:
    image = render_diff(BASE, remove_states(BASE, ["C"]))
    (state,) = [group for group in image.groups if group.key == "s:C"]
    outline, name = state.shapes[0], next(shape for shape in state.shapes if isinstance(shape, TextShape))
    assert isinstance(outline, PathShape)
    assert outline.dash
    assert name.is_struck_through


def test_a_moved_state_leaves_an_outline() -> None:
    image = render_diff(BASE, update_state(BASE, "B", lambda state: replace(state, at=(200, -500))))
    assert next(text_of(group) for group in image.groups if group.css_class == "mark") == ""
    assert image.top < -500
    assert image.top + image.height > 0


@pytest.mark.parametrize("colors", [LIGHT_DIFF, DARK_DIFF, css_variable_diff()])
def test_the_legend_explains_the_signs(colors: object) -> None:
    svg = write_svg(render_diff(BASE, GUARDED, colors))  # type: ignore[arg-type]
    assert ">changed</text>" in svg
    assert ">added</text>" not in svg


@given(designs, designs)
@settings(max_examples=max(10, settings().max_examples // 8))
def test_any_two_designs_can_be_drawn(old: Design, new: Design) -> None:
    assert render_diff(old, new).groups or not (old.states or new.states)


def lowered(text: str) -> Design:
    design = read_design("vicode: 1\ncomponent: Player\n" + text).design
    assert design is not None
    return design


def test_changed_constructs_are_marked_where_they_are_drawn() -> None:
    states = "initial: A\nstates: {A: {}, B: {}, C: {}, D: {}}\n"
    old = lowered(states + "interrupts: [{do: B, when: x}, {do: C, when: y}]\n")
    new = lowered(states + "interrupts: [{do: B, when: z}, {do: C, when: y}, {do: D, when: u}]\n")
    assert signs(old, new) == [("+", "+ interrupt by D: do D; when u"), ("~", "~ when of interrupt by B: x → z")]
    assert signs(new, old) == [("~", "~ when of interrupt by B: z → x")]
    old = lowered("layers: {A: {}, B: {when: x}}\n")
    new = lowered("layers: {A: {}, B: {when: y}}\npositions: {A: [5, 5]}\n")
    assert signs(old, new) == [
        (">", "> moved state A: (automatic) → 5, 5"),
        ("~", "~ when of layer B: x → y"),
        ("~", "~ when of layer B: x → y"),
    ]
