"""Inputs of a simulation, and edits that change its behavior."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import prepare_lamp, write_lamps
from vicode.editor.session.simulation import Breakpoints
from vicode.editor.view import ItemRef
from vicode.model.design import Design, State, Transition
from vicode.model.edits import move_nodes, update_state
from vicode.runs import behavior_key, used_components
from vicode.store import open_project, read_design


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


def test_inputs_come_from_the_declarations(lamps: Path) -> None:
    inputs = {each.key: each for each in prepare_lamp(lamps).inputs}
    assert list(inputs) == [
        ("", "patience"),
        ("Eye", "seen"),
        ("Eye", "light"),
        ("Eye", "count"),
        ("Eye", "mood"),
        ("Eye", "level"),
        ("Eye", "toward"),
    ]
    patience = inputs["", "patience"]
    assert (patience.type, patience.initial, patience.range, patience.unit) == ("float", 0.06, (0, 2), "s")
    assert inputs["Eye", "seen"].initial is False
    assert inputs["Eye", "seen"].doc == "Somebody is there."
    # Without an initial value it is 0, or the nearest value in the range.
    assert (inputs["Eye", "count"].type, inputs["Eye", "count"].initial) == ("int", 2)
    assert inputs["Eye", "mood"].options == ("Mood.calm", "Mood.angry")
    assert inputs["Eye", "toward"].arguments == ("x",)


def test_components_without_an_implementation_come_first(lamps: Path) -> None:
    file = lamps / "project.yaml"
    file.write_text(file.read_text().replace("    implementation: hands:Eye\n", ""))
    prepared = prepare_lamp(lamps)
    assert [each.component for each in prepared.inputs] == ["Eye"] * 6 + [""]
    assert [stub.component for stub in prepared.setup.stubs] == ["Eye", "Bulb"]


def test_stubbed_designs_can_be_done(lamps: Path) -> None:
    inputs = prepare_lamp(lamps, stubbed=frozenset({"Timer"})).inputs
    assert [each.key for each in inputs] == [("", "patience"), ("Timer", "is_done")]


@pytest.mark.parametrize(
    ("key", "given", "taken"),
    [
        (("Eye", "count"), 4.6, 5),
        (("Eye", "light"), 7, 7.0),
        (("Eye", "light"), True, None),
        (("Eye", "light"), 1e300, None),
        (("Eye", "seen"), 1, None),
        (("Eye", "mood"), "Mood.angry", "Mood.angry"),
        (("Eye", "mood"), ["Mood.angry"], None),
    ],
)
def test_values_from_the_browser_are_converted_by_type(
    lamps: Path, key: tuple[str, str], given: object, taken: object
) -> None:
    each = next(each for each in prepare_lamp(lamps).inputs if each.key == key)
    assert each.accept(given) == taken


def test_positions_do_not_change_the_behavior(lamps: Path) -> None:
    project = open_project(lamps).project
    design = project.design("Lamp")
    assert design is not None
    before = behavior_key(project, design)
    assert behavior_key(project, move_nodes(design, {"Dark": (5.0, 5.0)})) == before
    final = update_state(design, "Dark", lambda state: replace(state, final=True))
    assert behavior_key(project, final) != before
    timer = project.design("Timer")
    assert timer is not None
    other = replace(project, designs=(design, replace(timer, doc="slow")))
    assert behavior_key(other, design) != before


def test_used_components_include_indirect_ones(lamps: Path) -> None:
    project = open_project(lamps).project
    design = project.design("Lamp")
    assert design is not None
    assert used_components(project, design) == ("Eye", "Bulb", "Timer")


def test_breakpoints_are_toggled_together() -> None:
    design = Design(component="Lamp", states=(State(name="Dark", transitions=(Transition(to="Dark"),)),))
    dark, first = ItemRef(kind="states", id="Dark"), ItemRef(kind="transitions", id="Dark/0")
    some = Breakpoints().toggled(design, dark)
    both = some.toggled(design, dark, first, ItemRef(kind="components", id="eye"))
    assert both.items == {dark, first}
    assert both.toggled(design, dark, first).items == frozenset()
    assert both.stop_conditions(extra_state="Lit").states == ("Dark", "Lit")


def test_a_breakpoint_on_an_interrupt_is_on_all_its_transitions() -> None:
    read = read_design(
        "vicode: 1\ncomponent: Walk\ninitial: A\ninterrupts: [{do: Wait, when: state_time > 1}]\n"
        "states: {A: {transitions: [{to: B}]}, B: {}, Wait: {}}\n"
    )
    assert read.design is not None
    interrupt = ItemRef(kind="transitions", id="A/0")
    points = Breakpoints().toggled(read.design, interrupt)
    assert points.places(read.design) == (
        ("A", "Wait", None),
        ("B", "Wait", None),
        ("Wait", "A", None),
        ("Wait", "B", None),
    )
    assert points.toggled(read.design, ItemRef(kind="transitions", id="B/0")).items == frozenset()


def test_breakpoints_are_removed_with_their_items(lamps: Path) -> None:
    design = open_project(lamps).project.design("Lamp")
    assert design is not None
    kept = ItemRef(kind="transitions", id="@common/0")
    gone = ItemRef(kind="transitions", id="Dark/7")
    assert Breakpoints(items=frozenset({kept, gone})).existing_in(design).items == {kept}


def test_the_default_period_fits_the_frequencies(lamps: Path) -> None:
    assert prepare_lamp(lamps).setup.tick_ns == 20_000_000
    timer = lamps / "timer.yaml"
    timer.write_text(timer.read_text(encoding="utf-8") + "frequency: 15\n", encoding="utf-8")
    assert prepare_lamp(lamps).setup.tick_ns == 16_666_667
    assert prepare_lamp(lamps, tick_ms=5.0).setup.tick_ns == 5_000_000
