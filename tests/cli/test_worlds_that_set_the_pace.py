"""`clock: world`: a world that sets the pace is run, deployed, watched and recorded."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.cli.command_runner import vicode

PROJECT = """
vicode: 1
project: Train
components:
  Rail: {implementation: world, outputs: {place: float}}
  Drive: {implementation: world, parameters: {speed: {type: float, default: 0}}}
profiles:
  track: {world: "rail:Track", clock: world}
  model: {world: "rail:Track"}
"""
TRAIN = """
vicode: 1
component: Train
uses: {rail: Rail, drive: Drive}
initial: Ahead
states:
  Ahead: {requires: [rail], modulates: {drive: {speed: 1}}, transitions: [{to: Back, after: 0.35}]}
  Back: {modulates: {drive: {speed: -1}}}
"""
RAIL = """
class Track:
    # The cycles that begin before each iteration; 0: none within a second.
    script = [1, 1, 3, 0, 1, 1]

    def __init__(self):
        self.cycle = 70
        self.place = self.speed = 0.0
        self.sent = []
        self.waiting = [*self.script]
        self.finished = False

    def now_ns(self):
        return self.cycle * 100_000_000

    def next_cycle(self):
        self.sent.append(self.speed)
        if not self.waiting:
            self.finished = True
            return 0
        begun = self.waiting.pop(0)
        self.cycle += begun
        self.place += self.speed * begun
        return begun

    def drive(self, *, speed):
        self.speed = speed

    def hold(self):
        self.speed = 0.0
        self.sent.append("held")

    def summary(self):
        return {"sent": self.sent}
"""
TIMES_NS = [0, 100_000_000, 400_000_000, 500_000_000, 600_000_000]
SENT = [0, 1, 1, -1, -1, -1, -1, "held"]


@pytest.fixture
def train(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for name, text in (("project.yaml", PROJECT), ("train.yaml", TRAIN), ("rail.py", RAIL)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def read_trace(file: Path) -> tuple[list[int], dict[str, Any]]:
    _header, *lines, last = (json.loads(line) for line in file.read_text().splitlines())
    return [line["time_ns"] for line in lines], last["summary"]


@pytest.mark.parametrize("is_deployed", [False, True])
def test_each_cycle_of_the_world_is_an_iteration(
    train: Path, is_deployed: bool, capfd: pytest.CaptureFixture[str]
) -> None:
    options = ("--trace", "run.jsonl", "--watch", f"unix:{train / 'live'}", "--control", "--values")
    if is_deployed:
        assert vicode("deploy", ".", "--to", "robot", "--profile", "track", "--python", sys.executable) == 0
        command = ["robot/run", *options, "--record", str(train / "record.jsonl")]
        command[2] = str(train / "run.jsonl")
        subprocess.run(command, cwd=train, check=True, timeout=60)
    else:
        assert vicode("run", ".", "--profile", "track", *options) == 0
    times_ns, summary = read_trace(train / "run.jsonl")
    assert times_ns == TIMES_NS
    assert (summary["stopped"], summary["world"]["sent"]) == ("finished", SENT)
    out = capfd.readouterr().out
    if is_deployed:
        [record] = train.glob("record.*.jsonl")
        assert [json.loads(line)["time_ns"] for line in record.read_text().splitlines()[1:]] == TIMES_NS
        assert "missed_cycles: 2" in out
    else:
        assert "missed cycles: 2 of 7" in out
        assert "commands: sent" in out
    assert vicode("replay", "run.jsonl") == 0


@pytest.mark.parametrize("options", [("--seconds", "0.45"), ("--ticks", "3")])
def test_a_run_ends_by_the_time_of_the_world(train: Path, options: tuple[str, ...]) -> None:
    assert vicode("run", ".", "--profile", "track", "--trace", "run.jsonl", *options) == 0
    times_ns, summary = read_trace(train / "run.jsonl")
    assert (times_ns, summary["stopped"]) == (TIMES_NS[:3], "limit")


def test_another_world_is_paced_by_ticks_unless_the_clock_is_given(train: Path) -> None:
    for options, count in ((("--world", "rail:Track"), 3), (("--world", "rail:Track", "--clock", "world"), 2)):
        arguments = ("--profile", "track", "--seconds", "0.25", "--tick-ms", "100")
        arguments = arguments[: 4 if "--clock" in options else 6]
        assert vicode("run", ".", *arguments, *options, "--trace", "run.jsonl") == 0
        assert len(read_trace(train / "run.jsonl")[0]) == count


@pytest.mark.parametrize("option", [("--real-time",), ("--tick-ms", "20")])
def test_options_of_the_pace_are_refused(
    train: Path, capfd: pytest.CaptureFixture[str], option: tuple[str, ...]
) -> None:
    assert vicode("run", ".", "--profile", "track", *option) == 2
    assert f"{option[0]} has no effect if the world sets the pace" in capfd.readouterr().err


def test_a_world_that_cannot_set_the_pace_is_found(train: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (train / "rail.py").write_text(RAIL.replace("def next_cycle", "def following_cycle"))
    assert vicode("check", ".", "--strict") == 1
    assert "'Track' has no method 'next_cycle', which 'clock: world' needs" in capfd.readouterr().out
    assert vicode("run", ".", "--profile", "track") == 1
    (train / "rail.py").write_text(RAIL + "class Model: place = 0.0\n")
    assert vicode("run", ".", "--world", "rail:Model", "--clock", "world") == 2
    assert "rail:Model cannot set the pace (clock: world): it has no now_ns()" in capfd.readouterr().err


def test_a_clock_without_a_world_is_found(train: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = PROJECT.replace('world: "rail:Track", clock', "clock").replace(
        "project: Train", "project: Train\nclock: world"
    )
    (train / "project.yaml").write_text(text)
    assert vicode("check", ".") == 1
    out = capfd.readouterr().out
    assert "P203" in out
    assert "P213" in out
    (train / "project.yaml").write_text(PROJECT.replace("clock: world", "clock: server"))
    assert vicode("check", ".") == 1
    assert "unknown value 'server'; write world" in capfd.readouterr().out


def test_a_robot_is_held_during_an_iteration_that_hangs(train: Path, capfd: pytest.CaptureFixture[str]) -> None:
    hanging = """
        if self.speed < 0 and not self.is_held.wait(60):
            raise TimeoutError
"""
    text = RAIL.replace("        self.speed = speed\n", "        self.speed = speed\n" + hanging, 1)
    text = text.replace('self.sent.append("held")', 'self.sent.append("held")\n        self.is_held.set()')
    text = text.replace("self.cycle = 70", "self.cycle = 70\n        self.is_held = threading.Event()")
    (train / "rail.py").write_text("import threading\n" + text)
    assert vicode("run", ".", "--profile", "track", "--hold-after", "0.1", "--trace", "run.jsonl") == 0
    assert "warning: iteration 3 takes longer than 0.1 s; the robot was held" in capfd.readouterr().err
    assert read_trace(train / "run.jsonl")[1]["world"]["sent"][3:6] == ["held", 0.0, 0.0]


def test_control_without_hold_is_refused(train: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (train / "rail.py").write_text(RAIL.replace("def hold", "def stop"))
    options = ("--profile", "track", "--watch", f"unix:{train / 'live'}", "--control")
    assert vicode("run", ".", *options) == 2
    assert "--control is refused: the world Track has no hold()" in capfd.readouterr().err
    assert vicode("run", ".", *options, "--without-hold") == 0
    assert vicode("run", ".", *options[:-1], "--without-hold") == 2
    assert "--without-hold has no effect without --control" in capfd.readouterr().err
