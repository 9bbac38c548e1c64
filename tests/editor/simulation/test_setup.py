"""What a person can set, and when a design means something else."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.editor.simulation.lamps import stage_of, write_lamps
from vicode.editor.session.simulation import Breakpoints, meaning_of, used_components
from vicode.editor.view import Selected
from vicode.model.edits import move, update_state
from vicode.store import open_project


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


def test_inputs_are_known_from_the_declarations(lamps: Path) -> None:
    inputs = {each.key: each for each in stage_of(lamps).inputs}
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
    # Without a first value it is 0, or the nearest in the range.
    assert (inputs["Eye", "count"].type, inputs["Eye", "count"].initial) == ("int", 2)
    assert inputs["Eye", "mood"].options == ("Mood.calm", "Mood.angry")
    assert inputs["Eye", "toward"].arguments == ("x",)


def test_stood_in_designs_can_be_done(lamps: Path) -> None:
    inputs = stage_of(lamps, stood_in=frozenset({"Timer"})).inputs
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
def test_values_from_a_browser_are_taken_by_type(
    lamps: Path, key: tuple[str, str], given: object, taken: object
) -> None:
    each = next(each for each in stage_of(lamps).inputs if each.key == key)
    assert each.accept(given) == taken


def test_places_do_not_change_the_meaning(lamps: Path) -> None:
    project = open_project(lamps).project
    design = project.design("Lamp")
    assert design is not None
    before = meaning_of(project, design)
    assert meaning_of(project, move(design, {"Dark": (5.0, 5.0)})) == before
    final = update_state(design, "Dark", lambda state: replace(state, final=True))
    assert meaning_of(project, final) != before
    timer = project.design("Timer")
    assert timer is not None
    other = replace(project, designs=(design, replace(timer, doc="slow")))
    assert meaning_of(other, design) != before


def test_used_components_are_found_through_designs(lamps: Path) -> None:
    project = open_project(lamps).project
    design = project.design("Lamp")
    assert design is not None
    assert used_components(project, design) == ("Eye", "Bulb", "Timer")


def test_breakpoints_are_set_all_or_taken_away_all() -> None:
    dark, first = Selected(of="states", id="Dark"), Selected(of="transitions", id="Dark/0")
    some = Breakpoints().toggled(dark)
    both = some.toggled(dark, first, Selected(of="components", id="eye"))
    assert both.things == {dark, first}
    assert both.toggled(dark, first).things == frozenset()
    assert both.stops(also="Lit").states == ("Dark", "Lit")


def test_breakpoints_go_with_their_things(lamps: Path) -> None:
    design = open_project(lamps).project.design("Lamp")
    assert design is not None
    kept = Selected(of="transitions", id="@common/0")
    gone = Selected(of="transitions", id="Dark/7")
    assert Breakpoints(things=frozenset({kept, gone})).within(design).things == {kept}
