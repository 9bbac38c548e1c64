"""The command of the runtime in separate processes, run from a copied package without other libraries."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[2]
PLAYER = "sample_player:Player"
BARE_START = "import sys, runpy; sys.path.insert(0, sys.argv.pop(1)); runpy.run_module('bica', run_name='__main__')"


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the runtime, a component and a world, and nothing else."""
    folder = tmp_path_factory.mktemp("robot")
    shutil.copytree(PROJECT / "vicode" / "bica", folder / "bica", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("sample_player.py", "sample_world.py"):
        text = (Path(__file__).parent / name).read_text().replace("vicode.bica", "bica")
        (folder / name).write_text(text)
    return folder


def command(robot: Path, *arguments: str) -> list[str]:
    return [sys.executable, "-I", "-S", "-c", BARE_START, str(robot), *arguments]


def run(robot: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command(robot, *arguments), capture_output=True, text=True, timeout=60, check=False)


def in_world(*arguments: str) -> tuple[str, ...]:
    return (PLAYER, "--world", "sample_world:World", *arguments)


def test_it_runs_from_a_copied_folder_on_a_bare_python(robot: Path) -> None:
    done = run(robot, *in_world("--seconds", "1"))
    assert (done.returncode, done.stderr) == (0, "")
    assert "stopped: limit" in done.stdout
    assert "iterations: 60" in done.stdout


def test_the_same_seed_gives_the_same_trace(robot: Path, tmp_path: Path) -> None:
    traces = []
    for number, seed in enumerate(("3", "3", "4")):
        path = tmp_path / f"{number}.jsonl"
        assert run(robot, *in_world("--seed", seed, "--trace", str(path), "--values")).returncode == 0
        traces.append(path.read_bytes())
    assert traces[0] == traces[1] != traces[2]
    header, *records, last = [json.loads(line) for line in traces[0].splitlines()]
    assert header == {"vicode-trace": 1, "runtime": "bica"}
    assert [record["iteration"] for record in records] == list(range(1, len(records) + 1))
    assert last["summary"]["stopped"] == "finished"
    assert last["summary"]["world"]["acts"] > 1


def test_a_stream_carries_the_world(robot: Path) -> None:
    done = run(robot, *in_world("--ticks", "3", "--tick-ms", "100", "--stream"))
    *records, last = [json.loads(line) for line in done.stdout.splitlines()]
    assert [record["time_ns"] for record in records] == [0, 100_000_000, 200_000_000]
    assert records[0]["world"]["unknown"] == "nan"
    assert last["summary"]["cycle_times"]["Player"]["count"] == 3


def test_it_stops_when_the_root_is_done(robot: Path) -> None:
    done = run(robot, *in_world("--until-done", "--stream"))
    summary = json.loads(done.stdout.splitlines()[-1])["summary"]
    assert (summary["stopped"], summary["state"], summary["done"]) == ("done", "Kick", True)


def test_an_interrupt_ends_it_with_the_summary(robot: Path) -> None:
    process = subprocess.Popen(
        command(robot, *in_world("--real-time", "--stream", "--tick-ms", "5")),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    with process.stdout as lines:
        first = json.loads(next(lines))
        process.send_signal(signal.SIGINT)
        last = json.loads(list(lines)[-1])
    assert process.wait(timeout=30) == 130
    assert first["iteration"] == 1
    assert last["summary"]["stopped"] == "interrupted"


def test_a_closed_stream_ends_the_run_silently(robot: Path) -> None:
    process = subprocess.Popen(
        command(robot, *in_world("--real-time", "--stream", "--tick-ms", "1")),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.readline()
    process.stdout.close()
    assert process.wait(timeout=30) == 1
    with process.stderr as errors:
        assert errors.read() == ""


def test_errors_are_counted_or_stop_it(robot: Path) -> None:
    done = run(robot, PLAYER, "--ticks", "5", "--stream")
    assert json.loads(done.stdout.splitlines()[-1])["summary"]["errors"] == 6
    assert done.stderr.count("\n") == 2
    stopped = run(robot, PLAYER, "--ticks", "5", "--on-error", "stop")
    assert stopped.returncode == 1
    assert "stopped: error" in stopped.stdout
    assert "Perception, work, line 1" in stopped.stderr


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("sample_player", "write it as module:Class"),
        ("sample_player:Nobody", "cannot load sample_player:Nobody"),
        ("no_such_module:Player", "No module named 'no_such_module'"),
        ("sample_player:Side", "is not a component; derive it from bica.component.Component"),
    ],
)
def test_a_failed_start_is_reported_in_one_line(robot: Path, name: str, message: str) -> None:
    done = run(robot, name)
    assert done.returncode == 2
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


def test_it_runs_as_a_module_of_the_package(robot: Path) -> None:
    arguments = ["--path", str(Path(__file__).parent), *in_world("--ticks", "2")]
    done = subprocess.run(
        [sys.executable, "-m", "vicode.bica", *arguments], cwd=PROJECT, capture_output=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
