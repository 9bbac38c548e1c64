"""A breakpoint is reached at its place only: a state, a transition by its id, a common transition, or an error."""

from typing import Any, cast

import pytest

from tests.bica.cpp_robot import any_control, cpp_control, cpp_program, cpp_robot
from tests.bica.live_robot import Viewer, close_connections, control, make_root, root
from vicode.bica.control import ControlError, Controller
from vicode.bica.observer import IterationRecord

__all__ = ["any_control", "close_connections", "control", "cpp_control", "cpp_program", "cpp_robot", "root"]


def record(*steps: dict[str, Any], errors: tuple[str, ...] = ()) -> IterationRecord:
    plain = {"component": "Lamp", "state": "Lit", "changed_from": "Dark", "transition": "t1"}
    tree = [{**plain, **step} for step in steps or ({},)]
    return cast("IterationRecord", {"tree": tree, "errors": [{"component": each} for each in errors]})


def controller(*places: list[str | None], viewer: object = "viewer") -> Controller:
    made = Controller(make_root())
    made.apply(viewer, {"do": "break", "places": list(places)})
    return made


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (["Lamp", "Lit"], "Lamp Lit"),
        (["Lamp", "Dark", "Lit", "t1"], "Lamp Dark → Lit"),
        (["Lamp", "", "Lit", "t1"], "Lamp any state → Lit"),
        (["Lamp", "Dark"], ""),
        (["Eyes", "Lit"], ""),
        (["Lamp", "Dark", "Lit", "t2"], ""),
        (["Lamp", "Dark", "Lit", None], ""),
        (["Lamp", "Lit", "Lit", "t1"], ""),
        (["Lamp", "Dark", "Dark", "t1"], ""),
        (["Lamp", "Lit", "Dark", "t1"], ""),
        (["Lamp", "", "Dark", "t1"], ""),
        (["Lamp", "", "Lit", "t2"], ""),
        (["", "error"], ""),
    ],
)
def test_a_change_of_the_state_reaches_its_places(place: list[str | None], words: str) -> None:
    made = controller()
    # Eyes have no states, so that a request cannot name one.
    if place[0] == "Eyes":
        with pytest.raises(ControlError):
            made.apply("viewer", {"do": "break", "places": [place]})
        return
    made.apply("viewer", {"do": "break", "places": [place]})
    assert (made.check_breakpoints(record()), made.is_paused) == (words, bool(words))


def test_a_transition_without_id_has_its_own_place() -> None:
    for source in ("Dark", ""):
        made = controller(["Lamp", source, "Lit", None])
        assert made.check_breakpoints(record({"transition": "t1"})) == ""
        assert made.check_breakpoints(record({"transition": None})) == f"Lamp {source or 'any state'} → Lit"


def test_a_step_that_stays_reaches_nothing() -> None:
    made = controller(["Lamp", "Lit"], ["Lamp", "", "Lit", "t1"])
    assert made.check_breakpoints(record({"changed_from": None, "transition": None})) == ""
    assert not made.is_paused
    # A transition to the same state, and one of several steps.
    assert made.check_breakpoints(record({"changed_from": None}, {"changed_from": "Lit"})) == "Lamp Lit"


def test_errors_have_a_place() -> None:
    made = controller(["", "error"])
    assert made.check_breakpoints(record()) == ""
    assert made.check_breakpoints(record({"changed_from": None}, errors=("Lamp",))) == "errors"
    assert made.is_paused
    other = controller(["Lamp", "Dark"])
    assert other.check_breakpoints(record(errors=("Lamp",))) == ""


def test_the_first_of_several_places_is_told() -> None:
    made = controller(["Lamp", "Lit"], ["Lamp", "Dark", "Lit", "t1"])
    assert made.check_breakpoints(record()) == "Lamp Dark → Lit"


def test_a_breakpoint_ends_the_steps_that_were_asked_for() -> None:
    made = controller(["Lamp", "Lit"])
    assert made.apply("viewer", {"do": "step", "count": 3}) == "runs 3 iterations"
    assert not made.is_paused
    assert made.check_breakpoints(record()) == "Lamp Lit"
    assert made.is_paused


def test_steps_are_counted_with_and_without_breakpoints() -> None:
    for places in ((), (["Lamp", "Dark"],)):
        made = controller(*places)
        assert made.apply("viewer", {"do": "step", "count": 2}) == "runs 2 iterations"
        paused = []
        for _iteration in range(3):
            made.check_breakpoints(record())
            paused.append(made.is_paused)
        assert paused == [False, True, True]
        assert made.apply("viewer", {"do": "step"}) == "runs 1 iteration"


def test_breakpoints_belong_to_their_viewer() -> None:
    made = controller(["Lamp", "Lit"], viewer="one")
    made.apply("two", {"do": "break", "places": [["Lamp", "Dark"]]})
    assert made.check_breakpoints(record()) == "Lamp Lit"
    assert made.apply("two", {"do": "release"}) == ""
    assert made.is_paused
    assert made.apply("one", {"do": "release"}) == "resumed, as the viewer that paused has left"
    assert not made.is_paused
    assert made.check_breakpoints(record()) == ""


@pytest.mark.parametrize(
    "place",
    [
        "Lamp",
        [],
        ["Lamp"],
        ["Lamp", "Lit", "Dark"],
        ["Lamp", "Lit", "Dark", "t", "u"],
        ["Lamp", None],
        [None, "Lit"],
        ["Lamp", "Lit", None, "t"],
        ["Lamp", 1],
        ["Lamp", "Lit", "Dark", 1],
        ["Lamp", "Off"],
        ["Lamp", "Off", "Lit", "t"],
        ["Lamp", "Lit", "Off", "t"],
        ["Arm", "Lit"],
    ],
)
def test_a_place_that_does_not_exist_is_refused(place: Any) -> None:
    made = controller(["Lamp", "Lit"])
    with pytest.raises(ControlError):
        made.apply("viewer", {"do": "break", "places": [["Lamp", "Dark"], place]})
    assert made.check_breakpoints(record()) == "Lamp Lit"


def test_places_and_counts_that_are_wrong_are_refused_over_the_protocol(any_control: Viewer) -> None:
    for place in (
        "Lamp",
        [],
        ["Lamp"],
        ["Lamp", None],
        ["Lamp", 1],
        ["Lamp", "Lit", "Dark", 1],
        ["Lamp", "Off"],
        ["Arm", "Lit"],
    ):
        assert "error" in any_control.ask(do="break", places=[["Lamp", "Dark"], place])
    for count in (0, -1, 1_000_001, True, 1.0, "1", None):
        assert "whole number" in any_control.ask(do="step", count=count)["error"]


@pytest.mark.parametrize("count", [0, -1, 1_000_001, True, 1.0, "1", None])
def test_a_count_of_steps_is_checked(count: Any) -> None:
    made = controller()
    with pytest.raises(ControlError):
        made.apply("viewer", {"do": "step", "count": count})
    assert made.apply("viewer", {"do": "step", "count": 1_000_000}) == "runs 1000000 iterations"
