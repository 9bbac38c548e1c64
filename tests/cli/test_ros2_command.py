"""Commands with a profile whose components are topics of ROS 2."""

import itertools
import math
import os
import random
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.bica.ros_robot import SCAN, TWIST, make_scan, read_latched, write_bag
from tests.cli.command_runner import vicode
from vicode.bica import ros_session

PROJECT = """\
vicode: 1
project: Scouts
constants: {near: {value: 1.0, range: [0.2, 5.0], tunable: true}, far: {value: 9, tunable: true}}
components:
  Scan: {outputs: {nearest: 9.0, is_alive: bool}}
  Drive: {parameters: {speed: 0.0, turn: 0.0}}
profiles:
  ros2:
    tune: true
    components:
      Scan: {topic: /scan, type: sensor_msgs/msg/LaserScan, outputs: {nearest: min(ranges)}, max_age: 5}
      Drive: {topic: /cmd_vel, type: geometry_msgs/msg/Twist, parameters: {speed: linear.x, turn: angular.z}}
"""
SCOUT = """\
vicode: 1
component: Scout
uses: {scan: Scan, drive: Drive}
parameters: {speed: 1.0}
initial: Go
states:
  Go:
    requires: [scan]
    modulates: {drive: {speed: speed}}
    transitions: [{to: Near, when: scan.is_alive and scan.nearest < near}]
  Near: {requires: [scan], modulates: [drive]}
"""
HOME = Path(__file__).parents[2]
LIMIT_S = 30.0


@pytest.fixture
def scouts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project, in the current folder; the domain of DDS is random."""
    (tmp_path / "project.yaml").write_text(PROJECT)
    (tmp_path / "scout.yaml").write_text(SCOUT)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(random.randint(100, 200)))
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE", raising=False)
    monkeypatch.delenv("CYCLONEDDS_URI", raising=False)
    return tmp_path


def wait(condition: Callable[[], Any]) -> Any:
    end_s = time.monotonic() + LIMIT_S
    while time.monotonic() < end_s:
        if result := condition():
            return result
        time.sleep(0.01)
    raise AssertionError("nothing happened")


@pytest.fixture
def run(scouts: Path) -> Iterator["subprocess.Popen[str]"]:
    """A run that ends with the test."""
    command = [sys.executable, "-m", "vicode", "run", "scout.yaml", "--profile", "ros2", "--real-time"]
    environment = {**os.environ, "PYTHONPATH": str(HOME)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment) as run:
        try:
            yield run
        finally:
            run.terminate()


def test_a_run_drives_a_robot_until_it_is_stopped(run: "subprocess.Popen[str]") -> None:
    session = ros_session.open_session()
    commands, publish = session.reader("/cmd_vel", TWIST), session.writer("/scan", SCAN)
    assert wait(lambda: commands.take(0)).linear.x == 1.0
    # Published before this reader came.
    states = read_latched("/Scout/states")
    assert wait(lambda: states.take(1))[0].data == "Scout.Go"

    def approach() -> Any:
        publish(make_scan(0.5))
        return states.take(1)

    assert wait(approach)[0].data == "Scout.Near"

    def is_stopped() -> bool:
        command = commands.take(0)
        return command is not None and command.linear.x == 0.0

    wait(is_stopped)
    run.terminate()
    output, errors = run.communicate(timeout=LIMIT_S)
    assert run.returncode == 143
    assert "Traceback" not in errors
    assert "Scout: Go → Near" in output


def test_the_default_command_is_published_at_the_end(run: "subprocess.Popen[str]") -> None:
    commands = ros_session.open_session().reader("/cmd_vel", TWIST)
    assert wait(lambda: commands.take(0)).linear.x == 1.0
    run.terminate()
    received = []
    wait(lambda: received.append(commands.take(0)) or run.poll() is not None)
    received.append(commands.take(0))
    assert [message for message in received if message is not None][-1].linear.x == 0.0


def test_a_message_sets_a_tunable_constant(run: "subprocess.Popen[str]") -> None:
    session = ros_session.open_session()
    states, publish = read_latched("/Scout/states"), session.writer("/scan", SCAN)
    tune = session.writer("/Scout/set/near", "std_msgs/msg/Float64")
    assert wait(lambda: states.take(1))[0].data == "Scout.Go"

    def send(near: float) -> Any:
        message = ros_session.make_message("std_msgs/msg/Float64")
        message.data = near
        tune(message)
        publish(make_scan(4.0))
        return states.take(1)

    # Out of range; the writer may need a moment until the first arrives.
    end_s = time.monotonic() + 1.0
    for near in itertools.cycle((9.0, math.nan)):
        assert send(near) == []
        time.sleep(0.02)
        if time.monotonic() > end_s:
            break
    assert wait(lambda: send(4.5))[0].data == "Scout.Near"
    run.terminate()
    _output, errors = run.communicate(timeout=LIMIT_S)
    assert errors.count("/Scout/set/near is ignored") == 1
    # No component uses the other constant.
    assert "far" not in errors


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [(", tunable: true", "", "no constant is tunable"), ("topic: ", "remote: a", "the profile has no topics")],
)
def test_nothing_to_tune(scouts: Path, old: str, new: str, message: str, capfd: pytest.CaptureFixture[str]) -> None:
    (scouts / "project.yaml").write_text(PROJECT.replace(old, new))
    assert vicode("check", ".") == 1
    assert message in capfd.readouterr().out


def test_checked_and_generated(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert vicode("check", ".") == 0
    assert vicode("gen", "--profile", "ros2") == 0
    assert vicode("gen", "--profile", "ros2", "--check") == 0
    # Without the profile, the classes are others.
    assert vicode("gen", "--check") == 1
    capfd.readouterr()
    assert vicode("gen", "--profile", "ros2", "--language", "cpp") == 0
    assert "Scan, Drive: a topic of ROS 2 only in Python; write the class in C++" in capfd.readouterr().err


def test_a_deployed_program_says_what_it_needs(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert vicode("deploy", "scout.yaml", "--profile", "ros2", "--to", "robot", "--python", sys.executable) == 0
    assert f"{sys.executable} -m pip install cyclonedds rosbags" in capfd.readouterr().err
    assert vicode("deploy", "scout.yaml", "--to", "other") == 0
    assert "pip install" not in capfd.readouterr().err
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run(
        ["robot/run", "--seconds", "0.5"], capture_output=True, text=True, check=False, timeout=LIMIT_S, env=environment
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "state: Go" in done.stdout


def test_a_deployed_cpp_program_has_no_topics(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (scouts / "main.cpp").write_text("int main() {}\n")
    assert vicode("deploy", "scout.yaml", "--profile", "ros2", "--to", "robot", "--language", "cpp") == 0
    assert "write the class in C++" in capfd.readouterr().err


def test_inputs_take_the_place_of_topics(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    inputs = ("--set", "Scan.is_alive=true", "--set", "1 s: Scan.nearest=0.5")
    assert vicode("run", "scout.yaml", "--profile", "ros2", "--seconds", "2", *inputs) == 0
    assert "1.00 s  Scout: Go → Near" in capfd.readouterr().out


def test_a_trace_of_topics_is_replayed_and_checked(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    options = ("--profile", "ros2", "--real-time", "--seconds", "0.3", "--trace", "run.jsonl", "--values")
    assert vicode("run", "scout.yaml", *options) == 0
    assert vicode("replay", "run.jsonl") == 0
    assert "Scout: same states" in capfd.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("run", "scout.yaml", "--profile", "ros2"), "/scan: topics need --real-time"),
        (
            ("sweep", "scout.yaml", "--profile", "ros2", "--set", "Scout.speed=1,2", "--out", "runs"),
            "Scan is a topic, which needs real time",
        ),
    ],
)
def test_simulated_time_is_refused(
    scouts: Path, arguments: tuple[str, ...], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert vicode(*arguments) == 2
    assert message in capfd.readouterr().err


@pytest.mark.parametrize("arguments", [("conform", "."), ("test", "gen", ".", "--out", "suite")])
def test_commands_without_profiles(scouts: Path, arguments: tuple[str, ...]) -> None:
    assert vicode(*arguments) == 0


def record(folder: Path) -> None:
    """A bag of 2 s in which the wall gets nearer; the last message ends it."""
    distances = enumerate([3.0, 2.0, 1.5, 0.8, 0.7])
    write_bag(folder, [(7_000_000_000 + 500_000_000 * number, make_scan(each)) for number, each in distances])


def test_a_bag_is_replayed_until_its_end(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    record(scouts / "bag")
    options = ("--bag", "bag", "scout.yaml", "--profile", "ros2", "--trace", "run.jsonl")
    assert vicode("replay", *options) == 0
    output, errors = capfd.readouterr()
    assert "1.50 s  Scout: Go → Near" in output
    assert "2.00 s in 101 iterations" in output
    assert errors == ""
    # The trace leads to the same states without the bag.
    assert vicode("replay", "run.jsonl") == 0
    assert "same states in 101 iterations" in capfd.readouterr().out
    assert ros_session.BAG not in os.environ


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--bag", "bag", "scout.yaml"), "Scout uses no topics; name a profile"),
        (("--bag", "none", "scout.yaml", "--profile", "ros2"), "cannot read the bag none"),
        (("--bag", "bag", "scout.yaml", "--profile", "robot"), "profile"),
        (("--bag", "bag", "scout.yaml", "--profile", "ros2", "--tolerance", "1"), "no effect with --bag"),
        (("run.jsonl", "--profile", "ros2"), "no effect without --bag"),
    ],
)
def test_wrong_replays_of_bags(
    scouts: Path, arguments: tuple[str, ...], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    record(scouts / "bag")
    assert vicode("replay", *arguments) == 2
    assert message in capfd.readouterr().err


def test_a_topic_without_messages_is_named(scouts: Path, capfd: pytest.CaptureFixture[str]) -> None:
    write_bag(scouts / "bag", [(0, make_scan(1.0))], topic="/scam")
    assert vicode("replay", "--bag", "bag", "scout.yaml", "--profile", "ros2") == 0
    assert "has no messages on /scan" in capfd.readouterr().err
