"""Viewers control a running root, if it allows that."""

import sys
import time
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tests.bica.cpp_robot import AnyRobot, CppRobot, any_control, any_robot, cpp_control, cpp_program, cpp_robot
from tests.bica.live_robot import (
    Background,
    Eyes,
    Side,
    Viewer,
    advance,
    close_connections,
    control,
    is_iteration,
    root,
)
from vicode.bica import Root

__all__ = [
    "any_control",
    "any_robot",
    "close_connections",
    "control",
    "cpp_control",
    "cpp_program",
    "cpp_robot",
    "root",
]


def test_control_needs_permission(root: Root) -> None:
    viewer = Viewer(root.watch(), root)
    assert "may only be watched" in viewer.ask(do="pause")["error"]
    advance(root)


def test_control_of_a_robot_in_cpp_needs_permission(cpp_program: Path) -> None:
    robot = CppRobot(cpp_program, "--watch", "0")
    assert "may only be watched" in Viewer(robot).ask(do="pause")["error"]
    robot.end()


def test_values_are_set_and_held(root: Root, control: Viewer) -> None:
    assert control.ask(do="set", component="Eyes", name="distance", value=0)["done"] == "set Eyes.distance = 0.0"
    assert root.main.state == "Lit"
    control.ask(do="set", component="Eyes", name="side", value="Side.right", hold=True)
    eyes = root.component(Eyes)
    eyes.side = Side.left
    advance(root)
    assert eyes.side is Side.right
    control.ask(do="unset", component="Eyes", name="side")
    eyes.side = Side.left
    advance(root)
    assert eyes.side is Side.left


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        ({"do": "set", "component": "Eyes", "name": "_secret", "value": 2}, "no value '_secret'"),
        ({"do": "set", "component": "Eyes", "name": "__class__", "value": 2}, "no value '__class__'"),
        ({"do": "set", "component": "Eyes", "name": "root", "value": 2}, "no value 'root'"),
        ({"do": "set", "component": "Eyes", "name": "distance", "value": "far"}, "type float"),
        ({"do": "set", "component": "Eyes", "name": "distance", "value": True}, "type float"),
        ({"do": "set", "component": "Eyes", "name": "side", "value": "Side.up"}, "Side.left, Side.right"),
        ({"do": "enter", "component": "Lamp", "state": "Broken"}, "no state 'Broken'"),
        ({"do": "break", "places": [["Lamp", "Broken"]]}, "no state 'Broken'"),
        ({"do": "break", "places": "all"}, "list of"),
        ({"do": "break", "places": [["Lamp", "Dark", "Lit"]]}, "list of"),
        ({"do": "break", "places": [["Lamp", "Dark", "Broken", None]]}, "no state 'Broken'"),
        ({"do": "step", "count": -1}, "whole number"),
        ({"do": "frequency", "component": "Eyes", "hz": 0}, "from 0.001"),
        ({"do": "frequency", "component": "Eyes", "hz": 1e-300}, "from 0.001"),
        ({"do": "tune", "name": "os", "value": 1}, "no component uses"),
        ({"do": "dance"}, "unknown request"),
        ({"do": "raise", "component": "Arms"}, "no component 'Arms'"),
    ],
)
def test_requests_that_cannot_be_done_say_why(any_control: Viewer, request_: dict[str, Any], words: str) -> None:
    assert words in any_control.ask(**request_)["error"]


def test_a_state_is_entered_and_an_error_injected(
    root: Root, control: Viewer, capsys: pytest.CaptureFixture[str]
) -> None:
    assert control.ask(do="enter", component="Lamp", state="Lit")["done"] == "Lamp: Dark → Lit"
    control.ask(do="raise", component="Lamp", message="no light")
    advance(root)
    assert root.errors.total() == 1
    err = capsys.readouterr().err
    assert "InjectedError: no light" in err
    assert "control: Lamp: Lamp: Dark → Lit" in err


def test_frequencies_change_at_run_time(root: Root, control: Viewer) -> None:
    control.ask(do="frequency", component="Eyes", hz=10)
    eyes = root.component(Eyes)
    advance(root)
    worked = eyes._worked_ns
    advance(root)
    assert eyes._worked_ns == worked
    for _step in range(5):
        advance(root)
    assert eyes._worked_ns == worked + 100_000_000


def test_a_breakpoint_pauses_and_steps_go_on(root: Root, capsys: pytest.CaptureFixture[str]) -> None:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    viewer.ask(do="break", places=[["Lamp", "Lit"]])
    root.component(Eyes).distance = 0.0
    viewer.root = None
    with Background(root):
        line = viewer.get(lambda line: line.get("paused"))
        assert line["tree"][0]["state"] == "Lit"
        iteration = line["iteration"]
        viewer.send({"id": 1, "robot": "Lamp", "do": "step"})
        following = viewer.get(lambda line: is_iteration(line) and line["iteration"] > iteration)
        assert following["iteration"] == iteration + 1
        time.sleep(0.1)
        assert root.main._stepped_in == iteration + 1
        viewer.send({"id": 2, "robot": "Lamp", "do": "break", "places": []}, {"id": 3, "robot": "Lamp", "do": "resume"})
        assert viewer.get(lambda line: is_iteration(line) and not line["paused"])
    lines = [line.removeprefix("control: Lamp: ") for line in capsys.readouterr().err.splitlines()[1:]]
    expected = ["breakpoints: Lamp Lit", "paused at the breakpoint Lamp Lit", "runs 1 iteration"]
    assert lines == [*expected, "breakpoints: none", "resumed"]


@pytest.mark.parametrize(
    ("places", "words"),
    [
        ([["", "error"]], "errors"),
        ([["Lamp", "", "Lit", None], ["Lamp", "Lit", "Dark", "an\x1bid"]], "Lamp any state → Lit, Lamp Lit → Dark"),
        ([["Lamp", "Lit"]] * 12, f"{', '.join(['Lamp Lit'] * 10)} and 2 more"),
    ],
)
def test_breakpoints_are_logged_in_words(any_control: Viewer, places: list[list[Any]], words: str) -> None:
    assert any_control.ask(do="break", places=places)["done"] == f"breakpoints: {words}"


@pytest.mark.parametrize("source", ["Lit", ""])
def test_a_breakpoint_on_a_transition_pauses_only_there(root: Root, control: Viewer, source: str) -> None:
    control.ask(do="break", places=[["Lamp", source, "Dark", None], ["Lamp", "Dark", "Lit", "another"]])
    eyes = root.component(Eyes)
    eyes.distance = 0.0
    assert not control.get(lambda line: is_iteration(line) and line["tree"][0]["state"] == "Lit")["paused"]
    eyes.distance = 5.0
    control.root = None
    with Background(root):
        assert control.get(lambda line: line.get("paused"))["tree"][0]["state"] == "Dark"
        control.send({"id": 1, "robot": "Lamp", "do": "break", "places": []}, {"robot": "Lamp", "do": "resume"})


def test_a_pause_ends_with_the_viewer(root: Root) -> None:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    viewer.root = None
    with Background(root):
        viewer.send({"id": 1, "robot": "Lamp", "do": "pause"})
        viewer.get(lambda line: line.get("paused"))
        viewer.socket.close()


def test_who_attaches_later_does_not_see_a_pause_that_has_ended(any_robot: AnyRobot) -> None:
    with any_robot.running():
        viewer = any_robot.viewer()
        viewer.get(is_iteration)
        viewer.send({"id": 1, "robot": "Lamp", "do": "pause"})
        viewer.get(lambda line: line.get("paused"))
        viewer.socket.close()
        # The robot notices it a moment later.
        for _attempt in range(100):
            time.sleep(0.02)
            viewer = any_robot.viewer()
            if not viewer.get(is_iteration)["paused"]:
                return
            viewer.socket.close()
    raise AssertionError("it is shown as paused")


def test_missed_iterations_are_those_between_two_lines(any_robot: AnyRobot) -> None:
    with any_robot.running():
        viewer = any_robot.viewer()
        lines = [viewer.get(is_iteration)]
        viewer.send({"robot": "Lamp", "do": "pause"})
        for _step in range(10):
            before = lines[-1]["iteration"]
            while not (lines[-1]["paused"] and lines[-1]["iteration"] > before):
                lines.append(viewer.get(is_iteration))
            viewer.send({"robot": "Lamp", "do": "step"})
    for before, after in pairwise(lines):
        assert after["missed"] == max(0, after["iteration"] - before["iteration"] - 1)


def test_an_iteration_handles_a_limited_number_of_requests(root: Root, control: Viewer) -> None:
    control.root = None
    control.send(*({"id": number, "robot": "Lamp", "do": "unset"} for number in range(90)))
    # The server refuses what the robot, which does not step yet, could not handle in time.
    for _refused in range(90 - 64):
        control.get(lambda line: "too many requests" in line.get("error", ""))
    control.root, before = root, root.iteration
    for _handled in range(64):
        control.get(lambda line: "done" in line)
    assert root.iteration - before >= 64 // 4
    assert "done" in control.ask(do="unset")


def test_only_constants_are_tuned(control: Viewer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, f"{__package__}.declarations", ModuleType("declarations"))
    assert "no component uses" in control.ask(do="tune", name="__name__", value="other")["error"]
