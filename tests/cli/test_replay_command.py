"""vicode replay: the recorded inputs of a run, through the design as it is now."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.cli.command_runner import vicode
from vicode.bica.recorder import find_segments

PROJECT = """
vicode: 1
project: Cars
enumerations: {Mood: [calm, angry]}
world: hands:World
components:
  Eye: {implementation: hands:Eye, outputs: {distance: float, mood: Mood}}
  Wheels: {implementation: hands:Wheels, parameters: {speed: {type: float, default: 0}}}
  Map: {implementation: hands:Map, outputs: {size: float, depth: {type: float, arguments: {x: {type: float}}}}}
  Road: {implementation: world, outputs: {slope: float}}
"""
HANDS = """
from vicode.bica import Component


class World:
    def __init__(self, seed=0):
        self.now_s = self.slope = 0.0

    def advance(self, now_ns):
        self.now_s = now_ns / 1e9
        self.slope = self.now_s % 3


class Eye(Component):
    def __init__(self, root):
        super().__init__(root)
        self.distance = 9.0

    def work(self):
        from cars.declarations import Mood

        self.distance = 5.0 - self.world.now_s % 5
        self.mood = Mood.angry if self.world.now_s % 7 > 6 else Mood.calm


class Wheels(Component):
    def modulate(self, *, speed=0.0):
        self.speed = speed


class Map(Component):
    size = 1.0

    def depth(self, x):
        return 2 * x
"""
CAR = """
vicode: 1
component: Car
frequency: 10
uses: {eye: Eye, wheels: Wheels, road: Road, turn: Turn}
parameters: {limit: {type: float, default: 1.0}}
variables: {laps: {type: int, initial: 0}}
initial: Drive
common: {transitions: [{to: Wait, when: eye.mood == Mood.angry and state_time > 0.5}]}
states:
  Drive:
    requires: [eye]
    modulates: {wheels: {speed: 2}}
    transitions:
      - {to: Avoid, when: eye.distance < limit}
      - {to: Wait, when: road.slope > 2.9}
  Avoid:
    requires: [eye]
    modulates: {turn: {}}
    enter: [{set: {laps: laps + 1}}]
    transitions: [{to: Drive, when: done(turn) or eye.distance > 4.5}]
  Wait: {requires: [eye], transitions: [{to: Drive, after: 0.35}]}
"""
TURN = """
vicode: 1
component: Turn
initial: Turning
states:
  Turning: {transitions: [{to: Over, after: 0.4}]}
  Over: {final: true}
"""


@pytest.fixture
def cars(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "cars"
    folder.mkdir()
    for name, text in (("project.yaml", PROJECT), ("hands.py", HANDS), ("car.yaml", CAR), ("turn.yaml", TURN)):
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def record(seconds: float = 15, *options: str) -> None:
    options = options or ("--values",)
    assert vicode("run", "cars/car.yaml", "--seconds", str(seconds), "--trace", "run.jsonl", *options) == 0


def edit_trace(edit: Callable[[list[dict[str, Any]]], list[dict[str, Any]]]) -> None:
    lines = [json.loads(line) for line in Path("run.jsonl").read_text().splitlines()]
    Path("run.jsonl").write_text("".join(json.dumps(line) + "\n" for line in edit(lines)))


def test_a_trace_gives_the_same_states_and_a_changed_design_the_first_difference(
    cars: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record()
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0
    assert capsys.readouterr().out == "Car: same states in 750 iterations, 14.98 s\n"
    change(cars / "car.yaml", "eye.distance < limit", "eye.distance < limit - 0.5")
    assert vicode("replay", "run.jsonl", "--design", "cars/car.yaml") == 1
    assert capsys.readouterr().out.splitlines() == [
        "4.100 s, iteration 206: Car: expected Avoid, got Drive",
        "  before: Drive",
        "  Drive → Avoid: eye.distance < limit - 0.5",
        "    eye.distance = 0.9",
        "    limit = 1",
    ]


def test_a_difference_is_explained_with_inputs_of_the_world_and_constants(
    cars: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    change(cars / "project.yaml", "world: hands:World", "world: hands:World\nconstants: {steep: 2.9}")
    change(cars / "car.yaml", "road.slope > 2.9", "road.slope > steep")
    record()
    change(cars / "project.yaml", "steep: 2.9", "steep: 2.95")
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "5.900 s, iteration 296: Car: expected Wait, got Drive"
    assert lines[-2:] == ["    road.slope = 2.9", "    steep = 2.95"]


def test_a_tolerance_permits_states_that_change_a_little_later(cars: Path) -> None:
    record(4.8)
    change(cars / "turn.yaml", "0.4", "0.42")
    assert vicode("replay", "run.jsonl", "--design", "cars") == 1
    assert vicode("replay", "run.jsonl", "--design", "cars", "--tolerance", "0.1") == 0


@pytest.mark.parametrize("start", [2, 207, 216, 231, 301, 633])
def test_a_record_can_begin_in_the_middle(cars: Path, capsys: pytest.CaptureFixture[str], start: int) -> None:
    record()
    edit_trace(lambda lines: [lines[0], *lines[start : start + 20], *lines[start + 60 : -1]])
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0, capsys.readouterr().out


def test_the_record_of_a_robot_is_replayed_by_its_name(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record()
    lines = Path("run.jsonl").read_text().splitlines()
    for number, part in enumerate((lines[600:620], lines[620:700]), start=4):
        header = json.dumps({**json.loads(lines[0]), "segment": number})
        Path(f"robot.1.{number:06}.jsonl").write_text("\n".join([header, *part]) + "\n")
    with Path("robot.1.000005.jsonl").open("a") as stream:
        stream.write(lines[700][:100])
    assert len(find_segments(Path("robot.jsonl").resolve())[1]) == 2
    capsys.readouterr()
    assert vicode("replay", "robot.jsonl", "--design", "cars") == 0
    assert "same states in 9" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("", "", "the trace has no values; record it with --values"),
        ("self.distance =", "self._distance =", "the trace has no value of Eye.distance; an output must be a bool"),
    ],
)
def test_missing_values_are_reported(
    cars: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, message: str
) -> None:
    if old:
        change(cars / "hands.py", old, new)
        distance = "property(lambda self: Decimal(self._distance))"
        change(cars / "hands.py", "class Eye(Component):", f"class Eye(Component):\n    distance = {distance}\n")
        change(cars / "hands.py", "from vicode.bica", "from decimal import Decimal\n\nfrom vicode.bica")
    record(1, *(["--values"] if old else ["--seed", "0"]))
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("distance", ["9.0", "property(lambda self: self._distance)"])
def test_an_output_is_recorded_wherever_it_is_defined(
    cars: Path, capsys: pytest.CaptureFixture[str], distance: str
) -> None:
    change(cars / "hands.py", "self.distance =", "self._distance =")
    change(cars / "hands.py", "class Eye(Component):", f"class Sensor(Component):\n    distance = {distance}")
    change(cars / "hands.py", "    def __init__(self, root)", "\nclass Eye(Sensor):\n    def __init__(self, root)")
    record(5)
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0, capsys.readouterr().out


@pytest.mark.parametrize("is_hidden", [False, True])
def test_a_component_of_the_world_that_a_state_requires_is_replayed(
    cars: Path, capsys: pytest.CaptureFixture[str], is_hidden: bool
) -> None:
    change(cars / "car.yaml", "Drive:\n    requires: [eye]", "Drive:\n    requires: [eye, road]")
    record()
    steps = [json.loads(line).get("tree", ()) for line in Path("run.jsonl").read_text().splitlines()]
    assert all(step["values"].keys() == {"slope"} for tree in steps for step in tree if step["component"] == "Road")
    if is_hidden:
        # So earlier versions wrote it.
        text = Path("run.jsonl").read_text()
        Path("run.jsonl").write_text(re.sub(r'"values": \{"slope": [^}]*\}', '"values": {}', text))
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0, capsys.readouterr().err
    assert capsys.readouterr().out == "Car: same states in 750 iterations, 14.98 s\n"


def test_outputs_with_arguments_return_what_they_returned(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(
        cars / "hands.py", "return 2 * x", "return self.depth_of(x)\n\n    def depth_of(self, x):\n        return ROAD"
    )
    change(cars / "hands.py", "ROAD", "self.world.now_s % (x + 2)")
    change(cars / "car.yaml", "uses: {", "uses: {map: Map, ")
    change(cars / "car.yaml", "road.slope > 2.9", "map.depth(x=1) > 2.9")
    change(cars / "project.yaml", "size: float, ", "")
    record()
    calls = [call for line in Path("run.jsonl").read_text().splitlines() for call in json.loads(line).get("calls", ())]
    assert {(call["component"], call["output"], str(call["arguments"])) for call in calls} == {
        ("Map", "depth", "{'x': 1.0}")
    }
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0, capsys.readouterr().out
    edit_trace(lambda lines: [lines[0], *lines[207:230], *lines[280:-1]])
    assert vicode("replay", "run.jsonl", "--design", "cars") == 0, capsys.readouterr().out
    change(cars / "car.yaml", "map.depth(x=1) > 2.9", "map.depth(x=1) > 1")
    assert vicode("replay", "run.jsonl", "--design", "cars") == 1


def test_calls_with_other_arguments_are_reported(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(cars / "car.yaml", "uses: {", "uses: {map: Map, ")
    change(cars / "car.yaml", "road.slope > 2.9", "map.depth(x=1) > 2.9")
    change(cars / "project.yaml", "size: float, ", "")
    record(1)
    change(cars / "car.yaml", "map.depth(x=1)", "map.depth(x=2)")
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars") == 2
    message = "at 0.000 s, iteration 1, the design calls Map.depth(x=2.0), which the trace has no result of"
    assert message in capsys.readouterr().err
    assert vicode("replay", "run.jsonl", "--design", "cars", "--allow-missing") == 0


def test_edits_missing_from_the_design_are_refused_as_in_a_run(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(cars / "car.yaml", "modulates: {turn: {}}", "modulates: {turn: {}}\n    actions: 'self.laps += 0'")
    record(1)
    assert vicode("gen", "cars") == 0
    change(cars / "generated/python/cars/car.py", "self.laps += 0", "self.laps += 1")
    capsys.readouterr()
    assert vicode("run", "cars/car.yaml", "--seconds", "1") == 1
    refused = capsys.readouterr().err
    assert "error G501 edited-generated: the code of region 'Avoid.actions' was edited" in refused
    assert vicode("replay", "run.jsonl", "--design", "cars") == 2
    assert capsys.readouterr().err == refused


def test_a_trace_of_another_design_or_no_trace_is_an_error(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record(1)
    capsys.readouterr()
    edit_trace(lambda lines: [lines[0], {**lines[1], "tree": [{**lines[1]["tree"][0], "component": "Truck"}]}])
    assert vicode("replay", "run.jsonl", "--design", "cars") == 2
    assert "cars has no design of Truck, the root component of the trace" in capsys.readouterr().err
    assert vicode("replay", "cars/hands.py", "--design", "cars") == 2
    assert "cars/hands.py: line 1 is not JSON" in capsys.readouterr().err
