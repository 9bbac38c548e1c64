"""A robot in C++ is watched, controlled and recorded as one in Python; its thread allocates nothing."""

import random
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from tests.bica.cpp_robot import LAMP, CppRobot, cpp_control, cpp_program, cpp_robot
from tests.bica.live_robot import Viewer, close_connections, is_iteration
from tests.bica.test_live_attacks import FRAMES_PER_CONNECTION, attack, flood
from vicode.generators import generate, list_outputs
from vicode.model.project import Project
from vicode.robots import decode_hello
from vicode.services.robot_version import find_other_versions
from vicode.store import open_project
from vicode.store.documents import read_design
from vicode.traces.reader import open_trace

__all__ = ["close_connections", "cpp_control", "cpp_program", "cpp_robot"]

LIT = [["Lamp", "Lit"]]


def distance(control: Viewer, value: float) -> None:
    control.ask(do="set", component="Eyes", name="distance", value=value)


def start_without_input(program: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    command = [program, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)


def state(line: dict[str, Any]) -> str:
    return str(line["tree"][0]["state"])


def test_a_viewer_sees_the_activation_tree(cpp_robot: CppRobot) -> None:
    viewer = Viewer(cpp_robot)
    hello = decode_hello(viewer.get(lambda line: "vicode-live" in line))
    (robot,) = hello.robots
    assert (robot.name, robot.root, hello.control, robot.language) == ("Lamp", "Lamp", True, "cpp")
    assert robot.components["Lamp"].states == ("Dark", "Lit")
    steps = {step["component"]: step for step in viewer.get(is_iteration)["tree"]}
    assert (steps["Lamp"]["state"], steps["Eyes"]["by"], steps["Eyes"]["link"]) == ("Dark", "Lamp", "requires")
    assert steps["Eyes"]["values"] == {"distance": 5.0, "side": "Side.left"}
    assert steps["Lamp"]["step_ns"] >= steps["Eyes"]["step_ns"] > 0


def test_the_robot_tells_the_version_of_its_designs(cpp_robot: CppRobot) -> None:
    (robot,) = decode_hello(Viewer(cpp_robot).get(lambda line: "vicode-live" in line)).robots
    opened = open_project(LAMP)
    sources = {component: path.name for component, path in opened.files.items() if component}
    assert find_other_versions(opened.project, sources, robot) == ()
    assert find_other_versions(opened.project, {**sources, "Lamp": "renamed.yaml"}, robot) == ("Lamp",)


def test_values_are_set_and_held(cpp_control: Viewer) -> None:
    assert cpp_control.ask(do="set", component="Eyes", name="distance", value=0)["done"] == "set Eyes.distance = 0.0"
    assert cpp_control.get(lambda line: is_iteration(line) and state(line) == "Lit")
    done = cpp_control.ask(do="set", component="Lamp", name="count", value=7, hold=True)["done"]
    assert done == "holds Lamp.count = 7"
    distance(cpp_control, 5)
    cpp_control.get(lambda line: is_iteration(line) and state(line) == "Dark")
    assert cpp_control.get(is_iteration)["tree"][0]["values"]["count"] == 7
    cpp_control.ask(do="unset", component="Lamp", name="count")
    assert cpp_control.get(lambda line: is_iteration(line) and line["tree"][0]["values"]["count"] > 7)


def test_a_breakpoint_pauses_steps_go_on_and_time_stands_still(cpp_robot: CppRobot, cpp_control: Viewer) -> None:
    cpp_control.ask(do="break", places=LIT)
    distance(cpp_control, 0)
    line = cpp_control.get(lambda line: line.get("paused"))
    assert (state(line), line["tree"][0]["state_time_ns"]) == ("Lit", 0)
    lines = [line]
    for _step in range(3):
        cpp_control.ask(do="step")
        lines.append(
            cpp_control.get(lambda each, last=lines[-1]: each.get("paused") and each["iteration"] > last["iteration"])
        )
    for before, after in pairwise(lines):
        assert after["iteration"] == before["iteration"] + 1
        assert after["time_ns"] == before["time_ns"] + 20_000_000
        assert after["missed"] == 0
    cpp_control.ask(do="resume")
    assert cpp_control.get(lambda line: is_iteration(line) and not line["paused"])
    printed, logged = cpp_robot.end()
    assert int(printed.split()[4]) >= 4
    assert "control: Lamp: paused at the breakpoint Lamp Lit\n" in logged


@pytest.mark.parametrize("source", ["Lit", ""])
def test_a_breakpoint_on_a_transition_pauses_only_there(cpp_control: Viewer, source: str) -> None:
    cpp_control.ask(do="break", places=[["Lamp", source, "Dark", None], ["Lamp", "Dark", "Lit", "another"]])
    distance(cpp_control, 0)
    assert not cpp_control.get(lambda line: is_iteration(line) and state(line) == "Lit")["paused"]
    distance(cpp_control, 5)
    assert state(cpp_control.get(lambda line: line.get("paused"))) == "Dark"


def test_a_state_is_entered_and_an_error_injected(cpp_control: Viewer) -> None:
    assert cpp_control.ask(do="break", places=[["", "error"]])["done"] == "breakpoints: errors"
    assert cpp_control.ask(do="enter", component="Lamp", state="Lit")["done"] == "Lamp: Dark → Lit"
    cpp_control.ask(do="raise", component="Lamp", message="no light")
    line = cpp_control.get(lambda line: line.get("paused"))
    assert (line["errors_total"], line["errors"][0]["message"]) == (1, "InjectedError: no light")


def test_a_constant_is_tuned_and_a_frequency_set(cpp_control: Viewer) -> None:
    assert cpp_control.ask(do="tune", name="NEAR", value=6)["done"] == "constant NEAR = 6.0"
    assert cpp_control.get(lambda line: is_iteration(line) and state(line) == "Lit")
    assert "that is tunable" in cpp_control.ask(do="tune", name="HALF", value=6)["error"]
    assert "finite" in cpp_control.ask(do="tune", name="NEAR", value="inf")["error"]
    assert cpp_control.ask(do="frequency", component="Eyes", hz=10)["done"] == "Eyes works at 10 Hz"
    assert cpp_control.get(lambda line: is_iteration(line) and not line["tree"][1]["worked"])
    assert "no frequency in its design" in cpp_control.ask(do="frequency", component="Lamp", hz=10)["error"]


def test_a_pause_and_what_is_held_end_with_the_viewer(cpp_robot: CppRobot, cpp_control: Viewer) -> None:
    cpp_control.ask(do="set", component="Eyes", name="distance", value=0, hold=True)
    cpp_control.send({"robot": "Lamp", "do": "pause"})
    paused = cpp_control.get(lambda line: line.get("paused"))["iteration"]
    other = Viewer(cpp_robot)
    cpp_control.socket.close()
    other.get(lambda line: is_iteration(line) and line["iteration"] > paused)
    distance(other, 5)
    assert other.get(lambda line: is_iteration(line) and state(line) == "Dark")


def test_random_frames_harm_nobody(cpp_robot: CppRobot) -> None:
    good, chance = Viewer(cpp_robot), random.Random(7)
    last = good.get(is_iteration)["iteration"]
    for _connection in range(1_500 // FRAMES_PER_CONNECTION):
        attack(cpp_robot, chance)
        last = good.get(lambda line, last=last: is_iteration(line) and line["iteration"] > last)["iteration"]
    cpp_robot.end()


def test_a_flood_is_limited_and_then_disconnected(cpp_robot: CppRobot) -> None:
    good, flooding = Viewer(cpp_robot), Viewer(cpp_robot)
    with pytest.raises(ConnectionError):
        flood(flooding, [])
    last = good.get(is_iteration)["iteration"]
    assert good.get(lambda line: is_iteration(line) and line["iteration"] > last)
    cpp_robot.end()


def test_a_bad_address_is_an_error(cpp_program: Path) -> None:
    for address in ("nowhere", "unix:/no/folder/robot.sock"):
        ended = start_without_input(cpp_program, "--watch", address)
        assert (ended.returncode, ended.stderr.startswith(f"error: cannot be watched at {address}: ")) == (2, True)


def test_a_port_in_use_is_an_error(cpp_robot: CppRobot, cpp_program: Path) -> None:
    port = cpp_robot.address.rpartition(":")[2]
    assert f"error: cannot be watched at {port}: " in start_without_input(cpp_program, "--watch", port).stderr


def test_a_robot_without_hold_is_only_controlled_if_asked_twice(cpp_program: Path) -> None:
    refused = start_without_input(cpp_program, "--watch", "0", "--control", "--no-hold")
    assert (refused.returncode, "a paused robot would keep moving" in refused.stderr) == (2, True)
    for arguments, environment in (
        (("--control", "--without-hold"), {}),
        ((), {"VICODE_WATCH_CONTROL": "without-hold"}),
    ):
        robot = CppRobot(cpp_program, "--watch", "0", *arguments, "--no-hold", **environment)
        assert Viewer(robot).ask(do="pause")["done"] == "paused"
        robot.end()


def test_the_robot_is_held_when_it_pauses_and_when_a_viewer_leaves(cpp_robot: CppRobot, cpp_control: Viewer) -> None:
    cpp_control.ask(do="set", component="Eyes", name="distance", value=4)
    cpp_control.socket.close()
    other = Viewer(cpp_robot)
    other.ask(do="pause")
    other.get(lambda line: line.get("paused"))
    other.ask(do="resume")
    printed, _logged = cpp_robot.end()
    assert " 2 holds" in printed


def test_the_thread_of_the_robot_allocates_nothing(cpp_program: Path, tmp_path: Path) -> None:
    robot = CppRobot(cpp_program, "--watch", "0", "--control", "--record", str(tmp_path / "run.jsonl"))
    control = Viewer(robot)
    control.ask(do="break", places=LIT)
    control.ask(do="set", component="Eyes", name="distance", value=0, hold=True)
    control.get(lambda line: line.get("paused"))
    for request in (
        {"do": "step"},
        {"do": "enter", "component": "Lamp", "state": "Dark"},
        {"do": "break", "places": []},
        {"do": "resume"},
    ):
        assert "done" in control.ask(**request)
    control.socket.close()
    Viewer(robot).get(is_iteration)
    printed, _logged = robot.end()
    assert " 0 allocations" in printed


def test_a_record_is_replayed(cpp_program: Path, tmp_path: Path) -> None:
    for run in (1, 2):
        robot = CppRobot(cpp_program, "--watch", "0", "--control", VICODE_RECORD=str(tmp_path / "run.jsonl"))
        control = Viewer(robot)
        for value in (0, 5):
            distance(control, value)
            control.get(lambda line: is_iteration(line) and line["changes"])
        robot.end()
        assert (tmp_path / f"run.{run}.000001.jsonl").is_file()
    trace = open_trace(tmp_path / "run.jsonl")
    numbers = [each.iteration for each in trace.iterations()]
    assert numbers == list(range(1, len(numbers) + 1))
    for command in (
        ["replay", "run.jsonl", "--design", str(LAMP)],
        ["trace", "check", "run.jsonl", "--design", str(LAMP)],
    ):
        ended = subprocess.run(
            [sys.executable, "-m", "vicode", *command], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert ended.returncode == 0, ended.stdout + ended.stderr


def cpp_files(project: Project) -> dict[str, str]:
    return {file.path: file.text for file in generate(project, languages=["cpp"])}


def test_only_projects_that_ask_get_the_live_view() -> None:
    project = open_project(LAMP).project
    users = [path for path, text in cpp_files(project).items() if "bica_live.hpp" in text]
    assert users == ["cpp/bica_live.hpp", "cpp/lamps/CMakeLists.txt", "cpp/lamps/live.hpp"]
    without = replace(project, live=False)
    assert not [path for path, text in cpp_files(without).items() if "live" in path.lower() or "code_hash" in text]
    assert set(list_outputs(project)) - set(list_outputs(without)) == {"cpp/bica_live.hpp", "cpp/lamps/live.hpp"}


def test_an_edit_of_an_action_changes_one_file() -> None:
    project = open_project(LAMP).project
    before = cpp_files(project)
    text = (LAMP / "lamp.yaml").read_text(encoding="utf-8").replace("count + 1", "count + 2")
    design = read_design(text).design
    assert design is not None
    after = cpp_files(replace(project, designs=(design,)))
    assert [path for path in after if after[path] != before[path]] == ["cpp/lamps/lamp.cpp"]
