"""vicode sweep: the same table however the runs are executed, nothing lost, and what users see of errors."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.traces.reader import open_trace
from vicode.traces.statistics import read_history, sum_states

ROOT = Path(__file__).parents[2]
PROJECT = """\
vicode: 1
project: Cars
languages: [python]
world: lab.world:World
enumerations: {Mode: {elements: [slow, fast]}}
constants: {limit: 0.5, mode: Mode.slow, unused: 1}
components:
  Eye: {implementation: "lab.world:Eye", outputs: {distance: {type: float, initial: 9}}}
"""
CAR = """\
vicode: 1
component: Car
uses: {eye: Eye, wheels: Wheels}
initial: Drive
states:
  Drive:
    requires: [eye]
    modulates: {wheels: {}}
    transitions: [{to: Stop, when: eye.distance < limit}]
  Stop: {final: true}
"""
WHEELS = """\
vicode: 1
component: Wheels
parameters: {pause: 0.3}
initial: Left
states:
  Left: {transitions: [{to: Right, when: state_time >= pause}]}
  Right: {transitions: [{to: Left, after: 0.2}]}
"""
WORLD = """\
import os, random, signal, sys, time
from pathlib import Path
from vicode.bica import Component

class World:
    def __init__(self, seed):
        print('{"a": "text of the code of the project"}')
        self.seed, self.distance, self.now_ns = seed, 2 + random.Random(seed).random(), 0
        kill = os.environ.get("KILL_ONCE")
        if kill and seed == 2 and not Path(kill).exists():
            Path(kill).touch()
            os.kill(os.getppid(), signal.SIGKILL)
        if Path("trouble").exists():
            make_trouble(seed)

    def advance(self, now_ns):
        self.distance -= (now_ns - self.now_ns) / 1e9
        self.now_ns = now_ns

    def summary(self):
        return {"distance": self.distance, "near": self.distance < 0, "late_s": None, "name": "Car", "parts": [1]}

class Eye(Component):
    def work(self):
        self.distance = self.world.distance
        if Path("trouble").exists() and self.world.seed == 2:
            raise ValueError("no picture")

def make_trouble(seed):
    if seed == 3:
        raise RuntimeError("no such place")
    if seed == 4:
        os._exit(7)
    if seed == 5:
        sys.exit("enough")
    if seed > 5:
        Path(f"{os.getpid()}.pid").touch()
        time.sleep(600)
"""


@pytest.fixture
def cars(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the project in `cars/`, which is also where we are."""
    folder = tmp_path / "cars"
    files = {"project.yaml": PROJECT, "car.yaml": CAR, "wheels.yaml": WHEELS, "lab/world.py": WORLD}
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return folder


def sweep(*words: str, seeds: int = 3, values: str = "limit=0.2..0.8:3", out: str = "out") -> int:
    return vicode(
        "sweep", "cars/car.yaml", "--set", values, "--seeds", str(seeds), "--seconds", "3", "--out", out, *words
    )


def table(out: str = "out") -> list[dict[str, str]]:
    with Path(out, "runs.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_the_table_is_the_same_on_one_core_and_on_two(cars: Path) -> None:
    assert sweep("--jobs", "1", out="one") == 0
    assert sweep("--jobs", "2", out="two") == 0
    assert Path("one/runs.csv").read_bytes() == Path("two/runs.csv").read_bytes()
    rows = table("one")
    assert [(row["limit"], row["seed"]) for row in rows] == [(x, s) for x in ("0.2", "0.5", "0.8") for s in "123"]
    assert {row["error"] for row in rows} == {""}
    assert len({row["done_s"] for row in rows}) == 9
    for row in rows:
        assert float(row["seconds.Car.Drive"]) == float(row["done_s"])
        assert row["taken.Car.Drive->Stop"] == "1"
        assert float(row["done_s"]) < float(row["time_s"]) == 2.98
        assert row["state"] == "Stop"
        assert (row["world.near"], row["world.late_s"]) == (str(float(row["world.distance"]) < 0), "")
        assert not {"world.name", "world.parts"} & row.keys()


def test_a_worker_that_is_killed_loses_nothing(cars: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if find_spec("distributed") is None:
        pytest.skip("Dask is missing: install the extra cluster")
    from distributed import LocalCluster

    assert sweep(out="here") == 0
    killed = cars.with_name("killed")
    monkeypatch.setenv("KILL_ONCE", str(killed))
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0") as cluster:
        assert sweep("--cluster", cluster.scheduler_address, out="there") == 0
    assert killed.exists()
    assert Path("there/runs.csv").read_bytes() == Path("here/runs.csv").read_bytes()


@pytest.mark.parametrize("seed", [1, 2])
def test_the_figures_are_those_of_the_trace_of_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """Of the trace that has all iterations."""
    monkeypatch.chdir(tmp_path)
    design = str(ROOT / "designs/forward/player.yaml")
    assert (
        vicode("sweep", design, "--set", "lost_after=2", "--seeds", str(seed), "--seconds", "40", "--out", "out") == 0
    )
    row = table()[-1]
    assert vicode("run", design, "--seed", str(seed), "--seconds", "40", "--trace", "run.jsonl") == 0
    history = read_history(open_trace(Path("run.jsonl")).iterations())
    expected = {
        f"seconds.{component}.{state}": round(each.total_ns / 1e9, 6)
        for component, states in sum_states([history]).items()
        for state, each in states.items()
    }
    for (component, source, target, _id), count in history.transitions.items():
        name = f"taken.{component}.{source}->{target}"
        expected[name] = expected.get(name, 0) + count
    got = {name: float(text) for name, text in row.items() if name.startswith(("seconds.", "taken."))}
    assert {name: number for name, number in got.items() if number} == {n: x for n, x in expected.items() if x}
    summary = json.loads(Path("run.jsonl").read_text().splitlines()[-1])["summary"]
    assert {f"world.{name}": str(each if each is not None else "") for name, each in summary["world"].items()} == {
        name: text for name, text in row.items() if name.startswith("world.")
    }


def test_the_same_command_does_only_what_is_missing(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert sweep(seeds=2) == 0
    runs, whole = Path("out/runs.jsonl"), Path("out/runs.csv").read_bytes()
    lines = runs.read_bytes().splitlines(keepends=True)
    kept, lost = lines[:-1], lines[-1]
    runs.write_bytes(b"".join(kept) + lost[: len(lost) // 2])
    assert sweep(seeds=2) == 0
    assert runs.read_bytes() == b"".join(lines)
    assert Path("out/runs.csv").read_bytes() == whole
    assert sweep(seeds=3, values="limit=0.8,0.9") == 0
    assert runs.read_bytes().startswith(b"".join(lines))
    # Seed 3 with 0.5, the value of the file, and with 0.8; three seeds with 0.9.
    assert len(runs.read_bytes().splitlines()) == len(lines) + 5
    assert {row["limit"] for row in table()} == {"0.5", "0.8", "0.9"}


@pytest.mark.parametrize(
    ("file", "old", "new", "word"),
    [
        ("car.yaml", "eye.distance < limit", "eye.distance < limit + 1", "design"),
        ("project.yaml", "limit: 0.5", "limit: 0.6", "design"),
        ("lab/world.py", "2 + random", "3 + random", "Python code"),
    ],
)
def test_runs_of_another_design_are_not_continued(
    cars: Path, capsys: pytest.CaptureFixture[str], file: str, old: str, new: str, word: str
) -> None:
    assert sweep(seeds=1) == 0
    before = Path("out/runs.jsonl").read_bytes()
    change(cars / file, old, new)
    assert sweep(seeds=1) == 2
    assert f"out/runs.jsonl has runs with another {word}; choose another --out" in capsys.readouterr().err
    assert Path("out/runs.jsonl").read_bytes() == before
    assert sweep("--again", seeds=1) == 0
    assert Path("out/runs.jsonl").read_bytes() != before


def test_a_comment_and_generated_code_do_not_end_a_sweep(cars: Path) -> None:
    assert sweep(seeds=1) == 0
    before = Path("out/runs.jsonl").read_bytes()
    change(cars / "car.yaml", "initial: Drive", "initial: Drive  # first")
    assert vicode("gen", "cars") == 0
    assert sweep(seeds=1) == 0
    assert Path("out/runs.jsonl").read_bytes() == before


def test_another_limit_and_a_file_of_something_else_are_not_continued(
    cars: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert sweep(seeds=1) == 0
    assert sweep("--until-done", seeds=1) == 2
    assert "another --until-done" in capsys.readouterr().err
    Path("out/runs.jsonl").write_text("my notes\n", encoding="utf-8")
    assert sweep(seeds=1) == 2
    assert Path("out/runs.jsonl").read_text(encoding="utf-8") == "my notes\n"


@pytest.mark.parametrize("name", ["runs.csv", "sweep.html"])
def test_results_of_something_else_stay(cars: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    Path("out").mkdir()
    Path("out", name).write_text("mine", encoding="utf-8")
    for words in ([], ["--again"]):
        assert sweep(*words, seeds=1) == 2
        assert f"out/{name} is not replaced" in capsys.readouterr().err
    assert [(path.name, path.read_text(encoding="utf-8")) for path in Path("out").iterdir()] == [(name, "mine")]


@pytest.mark.parametrize("text", ["mine", "mine\n", '{"vicode": 1}\n'])
def test_runs_of_something_else_stay(cars: Path, capsys: pytest.CaptureFixture[str], text: str) -> None:
    Path("out").mkdir()
    Path("out/runs.jsonl").write_text(text, encoding="utf-8")
    for words in ([], ["--again"]):
        assert sweep(*words, seeds=1) == 2
        assert "out/runs.jsonl is not replaced, as 'vicode sweep' did not write it" in capsys.readouterr().err
    assert Path("out/runs.jsonl").read_text(encoding="utf-8") == text


def test_too_many_runs_are_refused(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert sweep("--set", "unused=1..400:400", values="limit=1..400:400", seeds=2) == 2
    assert "320000 runs are too many: a sweep has at most 100000" in capsys.readouterr().err


def test_each_error_is_a_row(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("trouble").touch()
    assert sweep(seeds=5, values="limit=0.5") == 1
    errors = [row["error"] for row in table()]
    assert errors[0] == ""
    assert errors[1].startswith("Eye, work, line 3: ValueError: no picture [lab/world.py:")
    assert errors[1].endswith("]")
    assert errors[2].startswith("cannot create lab.world:World: RuntimeError: no such place [lab/world.py:")
    assert errors[3:] == ["the program ended with exit code 7", "the program ended with exit code 1: enough"]
    printed = capsys.readouterr().out
    assert "5 runs, 4 failed" in printed
    assert all(error in printed for error in errors)
    assert [row["state"] for row in table()] == ["Stop", "Stop", "", "", ""]
    page = Path("out/sweep.html").read_text(encoding="utf-8")
    assert "4 runs with errors" in page
    assert "no picture" in page
    # The same command does them again.
    Path("trouble").unlink()
    assert sweep(seeds=5, values="limit=0.5") == 0
    assert [(row["seed"], row["error"]) for row in table()] == [(seed, "") for seed in "12345"]


def test_ctrl_c_ends_the_runs_and_keeps_what_is_done(cars: Path) -> None:
    Path("trouble").touch()
    limits = ["--seeds", "9", "--jobs", "2", "--seconds", "3"]
    words = ["sweep", "cars/car.yaml", "--set", "limit=0.5", *limits, "--out", "out"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "vicode", *words]
    with subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True) as process:
        while len(pids := [int(path.stem) for path in Path().glob("*.pid")]) < 2 and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _out, err = process.communicate()
    assert process.returncode == 130
    assert err == "vicode: stopped; the same command continues\n"
    assert len(pids) == 2
    assert not [pid for pid in pids if _is_running(pid)]
    rows = [json.loads(line) for line in Path("out/runs.jsonl").read_text(encoding="utf-8").splitlines()][1:]
    assert sorted(row["seed"] for row in rows) == [1, 2, 3, 4, 5]
    Path("trouble").unlink()
    sweep(seeds=9, values="limit=0.5")
    assert len(table()) == 9


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ("limit=0.2..0.6", "write a range as FIRST..LAST:COUNT, such as 0.2..0.6:5"),
        ("limit=1..2:01", "write a range as FIRST..LAST:COUNT, such as 0.2..0.6:5"),
        ("limit=1..2:1000000000", "1000000000 values are too many: a sweep has at most 100000 runs"),
        ("limit=fast", "'fast' is no value of limit, which has the type float"),
        ("limits=1", "the project has no constant 'limits'; did you mean 'limit'?"),
        ("Wheels.paus=1", "Wheels has no parameter 'paus'; did you mean 'pause'?"),
        ("limit", "write Component.parameter=VALUE or constant=VALUE"),
    ],
)
def test_wrong_values_are_named(cars: Path, capsys: pytest.CaptureFixture[str], values: str, message: str) -> None:
    assert sweep(values=values) == 2
    assert capsys.readouterr().err == f"vicode: --set {values}: {message}\n"
    assert not Path("out").exists()


def test_values_of_an_enumeration_and_of_a_parameter_are_combined(cars: Path) -> None:
    assert sweep("--set", "Wheels.pause=0.5", seeds=1, values="mode=Mode.slow,Mode.fast") == 0
    found = [(row["mode"], row["Wheels.pause"]) for row in table()]
    # The values of the files, slow and 0.3, are the baseline.
    assert found == [("fast", "0.5"), ("slow", "0.3"), ("slow", "0.5")]
    short, long = (float(row["seconds.Wheels.Left"]) for row in table()[1:])
    assert short < long


def test_the_order_of_the_names_does_not_matter(cars: Path) -> None:
    assert sweep("--set", "Wheels.pause=0.5", seeds=1) == 0
    before = Path("out/runs.jsonl").read_bytes()
    assert sweep("--set", "limit=0.2..0.8:3", seeds=1, values="Wheels.pause=0.5") == 0
    assert Path("out/runs.jsonl").read_bytes() == before


def test_a_name_that_has_no_effect_is_refused(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("sweep", "cars/wheels.yaml", "--set", "limit=1", "--set", "limit=2", "--out", "out") == 2
    assert "limit is set twice; separate its values by commas" in capsys.readouterr().err
    (cars / "other.yaml").write_text("vicode: 1\ncomponent: Other\nparameters: {a: 1}\ninitial: On\nstates: {On: {}}\n")
    assert sweep(values="Other.a=2") == 2
    assert "Car does not use Other" in capsys.readouterr().err


def test_values_without_an_effect_are_reported(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert sweep(values="unused=1,2") == 0
    assert "the values make no difference" in capsys.readouterr().out
    assert sweep(out="other") == 0
    assert "no difference" not in capsys.readouterr().out


def test_the_best_value_is_named(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert sweep("--minimize", "done_s", seeds=8) == 0
    first = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Best"))
    assert first.startswith("Best done_s: limit=0.8, median ")
    assert first.endswith(". Higher in 0 and lower in 8 of 8 seeds: significant, p = 0.016.")
    assert first in Path("out/sweep.html").read_text(encoding="utf-8").replace("&#39;", "'")
    assert sweep("--maximize", "done", seeds=8) == 2
    assert "no run has the figure 'done'; did you mean 'done_s'?" in capsys.readouterr().err


def test_without_dask_a_cluster_is_refused(
    cars: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "vicode.runs.sweep_cluster", raising=False)
    assert sweep("--cluster", "127.0.0.1:1") == 2
    assert "pip install 'vicode-fsm[cluster]'" in capsys.readouterr().err


@pytest.mark.parametrize("address", ["robotlab", "http://robotlab:8786"])
def test_another_address_than_that_of_a_scheduler_is_refused(
    cars: Path, capsys: pytest.CaptureFixture[str], address: str
) -> None:
    assert sweep("--cluster", address) == 2
    assert f"'{address}' is no address of a scheduler; write tcp://HOST:PORT" in capsys.readouterr().err


def test_a_world_that_sets_the_pace_is_refused(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    change(cars / "project.yaml", "world: lab.world:World", "world: lab.world:World\nclock: world")
    change(cars / "lab/world.py", "    def advance", "    def next_cycle(self):\n        return 1\n\n    def advance")
    assert sweep() == 2
    assert "needs a simulated world" in capsys.readouterr().err


def _is_running(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True
