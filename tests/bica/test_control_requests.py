"""Each request changes the robot as docs/live.md says; what a viewer holds ends with it."""

import math
import sys
from types import ModuleType
from typing import Any, cast

import pytest

from tests.bica.cpp_robot import any_control, cpp_control, cpp_program, cpp_robot
from tests.bica.live_robot import Eyes, Field, Lamp, Side, Viewer, advance, close_connections, control, root
from vicode.bica import Component, Root, SimulatedClock, State
from vicode.bica.control import ControlError, Controller, convert_value
from vicode.bica.observer import IterationRecord

__all__ = ["any_control", "close_connections", "control", "cpp_control", "cpp_program", "cpp_robot", "root"]


@pytest.fixture
def controller(root: Root) -> Controller:
    """The controller of a robot that has run one iteration."""
    advance(root)
    made = Controller(root)
    made.last_iteration = root.iteration
    return made


def lamp_of(root: Root) -> Lamp:
    return cast("Lamp", root.main)


def step_with(controller: Controller, component: Component, values: list[Any], name: str) -> None:
    """Step a component; the plain step notes a value and changes it."""

    def plain_step() -> None:
        values.append(getattr(component, name))
        setattr(component, name, -1)

    controller.prepare_step(component, plain_step)()
    values.append(getattr(component, name))


# Requests as a whole


def test_an_unknown_request_is_answered_with_the_known_ones(controller: Controller) -> None:
    known = "pause, resume, step, break, set, unset, enter, raise, frequency, tune, release"
    for request, name in (({"do": "fly"}, "'fly'"), ({}, "None"), ({"do": ["pause"]}, "['pause']")):
        with pytest.raises(ControlError) as caught:
            controller.apply("viewer", request)
        assert str(caught.value) == f"unknown request {name}; known are {known}"


def test_a_pause_ends_with_resume_or_its_viewer(controller: Controller) -> None:
    for viewer, request, words, is_paused in (
        ("one", "resume", "resumed", False),
        ("one", "pause", "paused", True),
        ("two", "release", "", True),
        ("two", "resume", "resumed", False),
        ("one", "pause", "paused", True),
        ("one", "release", "resumed, as the viewer that paused has left", False),
    ):
        assert (controller.apply(viewer, {"do": request}), controller.is_paused) == (words, is_paused)


@pytest.mark.parametrize("end", ["pause", "resume"])
def test_a_pause_and_its_end_cancel_the_steps_that_are_left(controller: Controller, end: str) -> None:
    controller.apply("one", {"do": "step", "count": 3})
    controller.apply("one", {"do": end})
    assert controller.is_paused == (end == "pause")
    controller.apply("one", {"do": "pause"})
    assert controller.is_paused


def test_steps_end_with_their_viewer(controller: Controller) -> None:
    controller.apply("one", {"do": "step", "count": 2})
    assert controller.apply("one", {"do": "release"}) == "resumed, as the viewer that paused has left"
    controller.apply("two", {"do": "pause"})
    assert controller.is_paused


def test_a_breakpoint_pauses_for_its_viewer(controller: Controller) -> None:
    controller.apply("one", {"do": "break", "places": [["Lamp", "Lit"]]})
    step = {"component": "Lamp", "state": "Lit", "changed_from": "Dark", "transition": None}
    assert controller.check_breakpoints(cast("IterationRecord", {"tree": [step], "errors": []})) == "Lamp Lit"
    assert controller.apply("two", {"do": "release"}) == ""
    assert controller.apply("one", {"do": "release"}) == "resumed, as the viewer that paused has left"


def test_the_robot_is_held_when_a_viewer_leaves(root: Root, controller: Controller) -> None:
    controller.apply("one", {"do": "resume"})
    assert cast("Field", root.world).holds == 0
    controller.apply("one", {"do": "release"})
    assert cast("Field", root.world).holds == 1


@pytest.mark.parametrize(("number", "words"), [(10, ""), (11, " and 1 more")])
def test_the_log_lists_ten_breakpoints(controller: Controller, number: int, words: str) -> None:
    done = controller.apply("one", {"do": "break", "places": [["Lamp", "Lit"]] * number})
    assert done == f"breakpoints: {', '.join(['Lamp Lit'] * 10)}{words}"


# Values


def test_a_value_is_set_once(root: Root, controller: Controller) -> None:
    done = controller.apply("one", {"do": "set", "component": "Eyes", "name": "distance", "value": 2})
    assert done == "set Eyes.distance = 2.0"
    assert not controller.has_effects
    eyes, values = root.component(Eyes), list[Any]()
    step_with(controller, eyes, values, "distance")
    assert values == [2.0, -1]


def test_a_value_is_held_before_and_after_each_step(root: Root, controller: Controller) -> None:
    done = controller.apply("one", {"do": "set", "component": "Eyes", "name": "distance", "value": 2, "hold": True})
    assert done == "holds Eyes.distance = 2.0"
    assert controller.has_effects
    eyes, values = root.component(Eyes), list[Any]()
    assert eyes.distance == 2.0
    eyes.distance = 7.0
    step_with(controller, eyes, values, "distance")
    step_with(controller, eyes, values, "distance")
    assert values == [2.0, 2.0, 2.0, 2.0]


def test_only_the_component_of_a_held_value_is_changed(root: Root, controller: Controller) -> None:
    controller.apply("one", {"do": "set", "component": "Eyes", "name": "distance", "value": 2, "hold": True})

    def plain_step() -> None:
        pass

    assert controller.prepare_step(root.main, plain_step) is plain_step
    assert controller.prepare_step(root.component(Eyes), plain_step) is not plain_step
    assert not hasattr(root.main, "distance")


def test_a_held_value_ends_with_unset_or_its_viewer(root: Root, controller: Controller) -> None:
    hold = {"do": "set", "component": "Eyes", "name": "distance", "value": 2, "hold": True}
    controller.apply("one", hold)
    controller.apply("two", {"do": "set", "component": "Lamp", "name": "count", "value": 5, "hold": True})
    assert controller.apply("one", {"do": "unset", "component": "Eyes", "name": "side"}) == "released Eyes.side"
    controller.apply("two", {"do": "release"})
    values: list[Any] = []
    step_with(controller, root.component(Eyes), values, "distance")
    step_with(controller, root.main, values, "count")
    assert values == [2.0, 2.0, 5, -1]
    assert controller.apply("two", {"do": "unset", "component": "Eyes", "name": "distance"}) == "released Eyes.distance"
    assert not controller.has_effects


@pytest.mark.parametrize("name", ["_secret", "root", "missing"])
def test_only_plain_public_attributes_are_set(controller: Controller, name: str) -> None:
    with pytest.raises(ControlError) as caught:
        controller.apply("one", {"do": "set", "component": "Eyes", "name": name, "value": 1})
    assert str(caught.value) == f"Eyes has no value '{name}' that can be set"


@pytest.mark.parametrize("plain", [True, 1, 1.5, "far", Side.left])
def test_attributes_of_all_plain_types_are_set(root: Root, controller: Controller, plain: object) -> None:
    vars(root.component(Eyes))["extra"] = plain
    value = "Side.right" if isinstance(plain, Side) else plain
    controller.apply("one", {"do": "set", "component": "Eyes", "name": "extra", "value": value})
    assert vars(root.component(Eyes))["extra"] == (Side.right if isinstance(plain, Side) else plain)


@pytest.mark.parametrize(
    ("value", "old", "expected"),
    [
        ("Side.right", Side.left, Side.right),
        ("right", Side.left, Side.right),
        (3, 1.5, 3.0),
        (2.5, 1.5, 2.5),
        ("inf", 1.5, math.inf),
        ("-inf", 1.5, -math.inf),
        (4, 1, 4),
        (10**300, 1, 2**53),
        (-(10**300), 1, -(2**53)),
        (True, False, True),
        ("far", "near", "far"),
    ],
)
def test_a_value_is_converted_to_the_type_of_the_old_one(value: object, old: object, expected: object) -> None:
    found = convert_value(value, old, "it")
    assert (found, type(found)) == (expected, type(expected))


def test_a_float_can_be_no_number() -> None:
    assert math.isnan(convert_value("nan", 1.5, "it"))


@pytest.mark.parametrize(
    ("value", "old", "words"),
    [
        ("up", Side.left, "it must be one of Side.left, Side.right"),
        ("Other.left", Side.left, "it must be one of Side.left, Side.right"),
        (True, 1.5, "it must be a value of type float"),
        ("1", 1.5, "it must be a value of type float"),
        (1.0, 1, "it must be a value of type int"),
        (True, 1, "it must be a value of type int"),
        ("inf", 1, "it must be a value of type int"),
        (1, True, "it must be a value of type bool"),
        (1, "near", "it must be a value of type str"),
        (None, "near", "it must be a value of type str"),
    ],
)
def test_a_value_of_another_type_is_refused(value: object, old: object, words: str) -> None:
    with pytest.raises(ControlError) as caught:
        convert_value(value, old, "it")
    assert str(caught.value) == words


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("side", "up", "Eyes.side must be one of Side.left, Side.right"),
        ("distance", True, "Eyes.distance must be a value of type float"),
        ("distance", "1", "Eyes.distance must be a value of type float"),
        ("distance", "-inf", "set Eyes.distance = -inf"),
        ("distance", 3, "set Eyes.distance = 3.0"),
        ("distance", 0.1, "set Eyes.distance = 0.1"),
    ],
)
def test_values_are_converted_over_the_protocol(any_control: Viewer, name: str, value: object, words: str) -> None:
    answer = any_control.ask(do="set", component="Eyes", name=name, value=value)
    assert answer.get("done", answer.get("error")) == words


def test_an_int_is_limited_over_the_protocol(any_control: Viewer) -> None:
    done = any_control.ask(do="set", component="Lamp", name="count", value=10**300)["done"]
    assert done == f"set Lamp.count = {2**53}"


# States


class Door(Component):
    """Notes what happens in its states."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.events: list[str] = []
        self._set_states(
            State("Open", self._run, leave=lambda: self.events.append("leave Open")),
            State("Shut", self._run, enter=lambda: self.events.append(f"enter {self.state}")),
            State("Locked", self._run),
        )

    def _run(self, decide: bool = True) -> None:
        self.events.append(f"in {self.state}")


@pytest.fixture
def door() -> Door:
    made = Root(Door, clock=SimulatedClock())
    advance(made)
    advance(made)
    return cast("Door", made.main)


def enter(door: Door, state: str, last_iteration: int = 2) -> str:
    made = Controller(door.root)
    made.last_iteration = last_iteration
    return made.apply("viewer", {"do": "enter", "component": "Door", "state": state})


def test_entering_a_state_leaves_the_active_one(door: Door) -> None:
    door._called = [(door, {})]
    assert enter(door, "Shut") == "Door: Open → Shut"
    assert door.events[2:] == ["leave Open", "enter Shut"]
    # Two iterations of 20 ms; the time in the state begins with that of the second one.
    assert (door.state, door._entered_ns, door._called) == ("Shut", 20_000_000, [])
    assert enter(door, "Locked") == "Door: Shut → Locked"
    assert enter(door, "Open") == "Door: Locked → Open"
    advance(cast("Root", door.root))
    assert door.events[2:] == ["leave Open", "enter Shut", "in Open"]


def test_only_a_state_of_an_active_component_is_entered(door: Door) -> None:
    for state, last, words in (
        ("Ajar", 2, "Door has no state 'Ajar'"),
        ("Shut", 3, "Door is not active: it was not stepped in the last iteration"),
    ):
        with pytest.raises(ControlError) as caught:
            enter(door, state, last)
        assert str(caught.value) == words
    assert door.events == ["in Open", "in Open"]


def test_before_the_first_iteration_no_component_is_active(root: Root) -> None:
    made = Controller(root)
    assert made.last_iteration == 0
    with pytest.raises(ControlError, match="not active"):
        made.apply("viewer", {"do": "enter", "component": "Lamp", "state": "Lit"})


# Errors


def test_the_next_step_raises_an_error(root: Root, controller: Controller, capsys: pytest.CaptureFixture[str]) -> None:
    done = controller.apply("viewer", {"do": "raise", "component": "Lamp", "message": "no light"})
    assert done == "the next step of Lamp raises: no light"
    steps: list[str] = []

    def plain_step() -> None:
        steps.append("step")

    assert controller.prepare_step(root.component(Eyes), plain_step) is plain_step
    root.iteration = 7
    controller.prepare_step(root.main, plain_step)()
    assert "error: Lamp (lamp.yaml), state Dark, _fail, line 1: InjectedError: no light" in capsys.readouterr().err
    assert root.errors.total() == 1
    # The component counts as stepped, so it does not restart in the next iteration.
    assert (steps, root.main._stepped_in) == ([], 7)
    assert not controller.has_effects
    assert controller.prepare_step(root.main, plain_step) is plain_step


@pytest.mark.parametrize(
    ("request_", "message"), [({}, "injected error"), ({"message": "x" * 201}, "x" * 200), ({"message": 7}, "7")]
)
def test_the_message_of_an_error_has_a_default_and_a_limit(
    controller: Controller, request_: dict[str, Any], message: str
) -> None:
    done = controller.apply("viewer", {"do": "raise", "component": "Lamp", **request_})
    assert done == f"the next step of Lamp raises: {message}"


# Frequencies and constants


@pytest.mark.parametrize(
    ("hertz", "words", "period_ns"),
    [(0.001, "0.001", 10**12), (10_000, "10000", 100_000), (12.5, "12.5", 80_000_000)],
)
def test_a_frequency_is_set(root: Root, controller: Controller, hertz: float, words: str, period_ns: int) -> None:
    done = controller.apply("viewer", {"do": "frequency", "component": "Eyes", "hz": hertz})
    assert (done, root.component(Eyes)._period_ns) == (f"Eyes works at {words} Hz", period_ns)


@pytest.mark.parametrize("hertz", [0.0009, 10_001, True, "5", None, math.nan, math.inf])
def test_a_frequency_is_a_number_in_its_range(controller: Controller, hertz: object) -> None:
    with pytest.raises(ControlError) as caught:
        controller.apply("viewer", {"do": "frequency", "component": "Eyes", "hz": hertz})
    assert str(caught.value) == "'hz' must be a number from 0.001 to 10000"


@pytest.fixture
def modules(monkeypatch: pytest.MonkeyPatch) -> dict[str, ModuleType]:
    """A package of generated code: both modules of components import the constants that they use."""
    made = {name: ModuleType(f"robot.{name}") for name in ("declarations", "lamp", "eyes")}
    for module in made.values():
        module.__package__ = "robot"
        monkeypatch.setitem(sys.modules, module.__name__, module)
    vars(made["declarations"]).update(NEAR=1.5, FAR=9, UNUSED=1, _hidden=1)
    vars(made["lamp"]).update(NEAR=1.5, FAR=9, _hidden=1, other=1)
    vars(made["eyes"]).update(NEAR=1.5)
    monkeypatch.setattr(Lamp, "__module__", "robot.lamp")
    monkeypatch.setattr(Eyes, "__module__", "robot.eyes")
    return made


def test_a_constant_is_set_where_it_is_used(controller: Controller, modules: dict[str, ModuleType]) -> None:
    assert controller.apply("viewer", {"do": "tune", "name": "NEAR", "value": 2}) == "constant NEAR = 2.0"
    assert [vars(module)["NEAR"] for module in modules.values()] == [2.0, 2.0, 2.0]
    assert controller.apply("viewer", {"do": "tune", "name": "FAR", "value": 4}) == "constant FAR = 4"
    values = {name: vars(module).get("FAR") for name, module in modules.items()}
    assert values == {"declarations": 4, "lamp": 4, "eyes": None}


@pytest.mark.parametrize("name", ["UNUSED", "other", "_hidden", "missing", None])
def test_only_a_constant_of_the_project_that_is_used_is_set(
    controller: Controller, modules: dict[str, ModuleType], name: str | None
) -> None:
    before = {key: dict(vars(module)) for key, module in modules.items()}
    with pytest.raises(ControlError) as caught:
        controller.apply("viewer", {"do": "tune", "name": name, "value": 2})
    assert str(caught.value) == f"no component uses a constant '{name}'"
    assert {key: dict(vars(module)) for key, module in modules.items()} == before


@pytest.mark.parametrize("value", ["inf", "-inf", "nan", math.inf])
def test_a_constant_is_finite(controller: Controller, modules: dict[str, ModuleType], value: object) -> None:
    with pytest.raises(ControlError) as caught:
        controller.apply("viewer", {"do": "tune", "name": "NEAR", "value": value})
    assert str(caught.value) == "NEAR must be a finite number"
    assert vars(modules["declarations"])["NEAR"] == 1.5
