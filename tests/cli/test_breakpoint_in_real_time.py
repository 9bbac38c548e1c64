"""A breakpoint in the tutorial's robot, run and deployed: its trace is the same as without."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.cli.command_runner import vicode
from tests.manual.code_blocks import code_blocks

ROOT = Path(__file__).parents[2]
LIMIT_S = 60.0

# Time that only waiting and a pause let pass: each pause takes three seconds.
STEPPED_TIME = """

import time
from pathlib import Path

from vicode.bica import run


class SteppedTime:
    time_ns = 0

    def now_ns(self):
        return self.time_ns

    def sleep(self, seconds):
        self.time_ns += round(seconds * 1e9)


SYSTEM = SteppedTime()


class SteppedClock(run.PacedClock):
    def __init__(self):
        super().__init__(SYSTEM, SYSTEM.sleep)


run.PacedClock = SteppedClock


class WatchedHall(Hall):
    holds = 0

    def advance(self, now_ns):
        for _attempt in range(2000):
            if Path("FOLDER/go").exists():
                break
            time.sleep(0.01)
        super().advance(now_ns)

    def hold(self):
        super().hold()
        self.holds += 1
        SYSTEM.time_ns += 3_000_000_000 * (self.holds == 1)

    def summary(self):
        return {"holds": self.holds}
"""


@pytest.fixture
def corridor(tmp_path: Path) -> Path:
    folder = tmp_path / "corridor"
    folder.mkdir()
    for block in code_blocks(ROOT / "docs/tutorial.md", "yaml", "python"):
        (folder / block.name).write_text(block.text, encoding="utf-8")
    hall = (folder / "hall.py").read_text() + STEPPED_TIME.replace("FOLDER", str(tmp_path))
    (folder / "hall.py").write_text(hall)
    return folder


def read_trace(file: Path) -> tuple[list[tuple[int, str]], dict[str, Any]]:
    """The times of the iterations with the states, and the summary."""
    _header, *lines, last = (json.loads(line) for line in file.read_text().splitlines())
    return [(line["time_ns"], line["tree"][0]["state"]) for line in lines], last["summary"]


@contextmanager
def attached(address: Path) -> Iterator[Any]:
    """A viewer: a function that sends a line and returns the next one with a key."""
    with socket.socket(socket.AF_UNIX) as viewer:
        viewer.settimeout(LIMIT_S)
        for _attempt in range(1000):
            try:
                viewer.connect(str(address))
                break
            except OSError:
                time.sleep(0.02)
        with viewer.makefile("rw") as lines:

            def ask(message: dict[str, Any], key: str = "") -> dict[str, Any]:
                lines.write(json.dumps(message) + "\n")
                lines.flush()
                return next(line for line in map(json.loads, lines) if line.get(key)) if key else {}

            yield ask


@pytest.mark.parametrize("is_deployed", [False, True])
def test_a_breakpoint_changes_no_time(corridor: Path, tmp_path: Path, is_deployed: bool) -> None:
    address = tmp_path / "live"
    if is_deployed:
        assert vicode("deploy", str(corridor), "--to", str(tmp_path / "robot"), "--python", sys.executable) == 0
        command = [str(tmp_path / "robot" / "run")]
    else:
        command = [sys.executable, "-m", "vicode", "run", str(corridor), "--real-time"]
    command += ["--world", "hall:WatchedHall", "--watch", f"unix:{address}", "--control", "--hold-after", "0"]
    # The robot takes its code from the folder of the deployment.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH" or not is_deployed}
    with subprocess.Popen([*command, "--trace", str(tmp_path / "robot.jsonl")], env=environment) as robot:
        try:
            with attached(address) as ask:
                ask({"token": ""}, "robots")
                ask({"robot": "Patrol", "do": "break", "places": [["Patrol", "Wait"]]})
                # The server answers this itself: it has the request before.
                ask({"robot": "nobody", "id": 2}, "answer")
                (tmp_path / "go").touch()
                assert ask({}, "paused")["tree"][0]["state"] == "Wait"
                ask({"robot": "Patrol", "do": "resume", "id": 3}, "answer")
                assert robot.wait(LIMIT_S) == 0
        finally:
            robot.kill()
    assert vicode("run", str(corridor), "--world", "hall:Hall", "--trace", str(tmp_path / "plain.jsonl")) == 0
    watched, summary = read_trace(tmp_path / "robot.jsonl")
    assert watched == read_trace(tmp_path / "plain.jsonl")[0]
    assert summary["world"] == {"holds": 2}
