"""A robot keeps its last minutes in files that a crash does not break, and never waits for the disk."""

import json
import os
import random
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.bica.sample_player import Player
from vicode.bica import Component, Root, SimulatedClock
from vicode.bica.recorder import Recorder, find_segments
from vicode.traces.reader import trace_schema

HOME = Path(__file__).parents[2]


class Sonar(Component):
    """Provides a value of the world."""

    @property
    def distance(self) -> float:
        return float(self.world.distance)


class Car(Component):
    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.sonar = root.component(Sonar)
        self.speed = 0.0

    def work(self) -> None:
        self.speed = self.sonar.distance


def make_world() -> SimpleNamespace:
    return SimpleNamespace(ball_seen=False, ball_distance=9.0, fallen=False, log=[], distance=1.0)


def read(files: list[Path]) -> list[dict[str, Any]]:
    return [json.loads(line) for file in files for line in file.read_text().splitlines()[1:]]


def run(path: Path, steps: int, *, ms: int = 20, **options: Any) -> None:
    clock = SimulatedClock()
    with Root(Player, clock=clock, world=make_world()) as root:
        recorder = root.record(path, **options)
        for _ in range(steps):
            root.step()
            recorder.write()
            clock.advance(ms * 1_000_000)


def test_a_record_is_a_trace_with_values(tmp_path: Path) -> None:
    run(tmp_path / "run.jsonl", 20, design="0123456789ab")
    [file] = tmp_path.iterdir()
    assert file.name == "run.1.000001.jsonl"
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert lines[0] == {"vicode-trace": 1, "runtime": "bica", "design": "0123456789ab", "segment": 1}
    assert [line["iteration"] for line in lines[1:]] == [*range(1, 21)]
    assert lines[1]["tree"][0]["values"]["kicks"] == 0
    validator = Draft202012Validator(trace_schema())
    for line in lines:
        validator.validate(line)


def test_only_the_last_minutes_are_kept(tmp_path: Path) -> None:
    run(tmp_path / "run.jsonl", 1000, ms=100, minutes=0.5)
    files = find_segments(tmp_path / "run.jsonl")[1]
    assert len(files) == 11
    times_s = [record["time_ns"] / 1e9 for record in read(files)]
    assert times_s[-1] == pytest.approx(99.9)
    assert 30 <= times_s[-1] - times_s[0] <= 33
    assert len(times_s) == len(set(times_s)) == round((times_s[-1] - times_s[0]) * 10) + 1


def test_records_of_earlier_runs_are_kept_up_to_a_number(tmp_path: Path) -> None:
    for _ in range(7):
        run(tmp_path / "run.jsonl", 1)
    assert list(find_segments(tmp_path / "run.jsonl")) == [3, 4, 5, 6, 7]


def test_a_full_queue_drops_and_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vicode.bica.recorder._MAX_WAITING", 2)
    recorder = Recorder(tmp_path / "run.jsonl", start_thread=False)
    for number in range(1, 7):
        recorder.add({"iteration": number, "time_ns": 0, "tree": [], "errors": []})
        if number == 5:
            recorder.write()
    recorder.close()
    records = read([*tmp_path.iterdir()])
    assert recorder.dropped == 3
    assert [(each["iteration"], each.get("dropped")) for each in records] == [(1, None), (2, None), (6, 3)]


def test_a_broken_disk_is_reported_once_and_the_robot_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    recorder = Recorder(tmp_path / "run.jsonl", start_thread=False)

    def fail(_record: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(recorder, "_write_record", fail)
    for number in (1, 2):
        recorder.add({"iteration": number, "time_ns": 0, "tree": [], "errors": []})
        recorder.write()
    recorder.close()
    assert capsys.readouterr().err.count("No space left on device; the run continues without it") == 1


def test_a_full_disk_does_not_fail_the_end_of_the_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorder = Recorder(tmp_path / "run.jsonl", start_thread=False)
    recorder._stream.close()
    recorder._stream = Path("/dev/full").open("w", encoding="utf-8")  # noqa: SIM115 - closed by the recorder
    recorder.add({"iteration": 1, "time_ns": 0, "tree": [], "errors": []})
    recorder.close()
    assert capsys.readouterr().err.count("No space left on device; the run continues without it") == 1


def test_values_of_components_that_are_not_stepped_are_recorded(tmp_path: Path) -> None:
    world = make_world()
    with Root(Car, clock=SimulatedClock(), world=world) as root:
        root.record(tmp_path / "run.jsonl")
        root.step()
        world.distance = 2.0
        root.step()
    records = read([*tmp_path.iterdir()])
    assert [record["inputs"] for record in records] == [{"Sonar": {"distance": 1.0}}, {"Sonar": {"distance": 2.0}}]


def test_a_live_view_and_measuring_leave_the_record_complete(tmp_path: Path) -> None:
    with Root(Player, clock=SimulatedClock(), world=make_world()) as root:
        root.watch("unix:" + str(tmp_path / "socket"))
        root.record(tmp_path / "run.jsonl")
        watched_step = root._step_main
        root.measure = True
        assert root._step_main == watched_step
        root.step()
    assert len(read(find_segments(tmp_path / "run.jsonl")[1])) == 1


def test_the_environment_starts_a_record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_RECORD", str(tmp_path / "run.jsonl"))
    with Root(Player, clock=SimulatedClock(), world=make_world()) as root:
        root.step()
    assert len(read([*tmp_path.iterdir()])) == 1


def test_the_environment_does_not_stop_a_robot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("VICODE_RECORD", "/dev/null/run.jsonl")
    Root(Player, clock=SimulatedClock(), world=make_world()).step()
    assert "cannot record to /dev/null/run.jsonl" in capsys.readouterr().err


def test_the_command_records(tmp_path: Path) -> None:
    names = ["tests.bica.sample_player:Player", "--world", "tests.bica.sample_world:World"]
    command = [sys.executable, "-m", "vicode.bica", *names, "--ticks", "3"]
    subprocess.run([*command, "--record", str(tmp_path / "run.jsonl"), "--minutes", "1"], cwd=HOME, check=True)
    assert len(read([*tmp_path.iterdir()])) == 3


@pytest.mark.parametrize("kills", [20, pytest.param(200, marks=pytest.mark.nightly)])
def test_a_killed_robot_leaves_all_that_was_flushed(tmp_path: Path, kills: int) -> None:
    random.seed(kills)
    for number in range(kills):
        path = tmp_path / f"{number}.jsonl"
        environment = {**os.environ, "PYTHONPATH": str(HOME)}
        command = [sys.executable, "-m", "tests.bica.recording_robot", str(path)]
        robot = subprocess.Popen(command, cwd=HOME, env=environment, stdout=subprocess.PIPE, text=True)
        assert robot.stdout is not None
        for _ in range(random.randrange(20, 500)):
            robot.stdout.readline()
        robot.send_signal(signal.SIGKILL)
        flushed = max(
            int(line) for line in ["0\n", *robot.communicate()[0].splitlines(keepends=True)] if line[-1] == "\n"
        )
        lines = [line for file in find_segments(path)[1] for line in file.read_text().splitlines()[1:]]
        numbers = [json.loads(line)["iteration"] for line in lines[:-1]]
        assert numbers == [*range(numbers[0], numbers[0] + len(numbers))] if numbers else flushed <= 1
        assert not numbers or flushed <= numbers[-1] + 1
