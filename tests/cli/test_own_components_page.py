"""docs/own-components.md: its example is sound, runs, and its tests pass."""

import contextlib
import json
import os
import re
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode

ROOT = Path(__file__).parents[2]
_BLOCK = re.compile(r"```(?:yaml|python)\n(?:# (?P<file>\S+\.(?:yaml|py))\n)?(?P<text>.*?)```", re.DOTALL)

_ROBOT = """\
profiles:
  robot: {world: hardware.board:Board, clock: world}
"""


@pytest.fixture
def drive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files of the page, in a folder where we are."""
    page = (ROOT / "docs" / "own-components.md").read_text(encoding="utf-8")
    for block in _BLOCK.finditer(page):
        file = tmp_path / (block["file"] or "test_road.py")
        file.parent.mkdir(exist_ok=True)
        file.write_text(block["text"], encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_example_is_sound_and_runs(drive: Path, capfd: pytest.CaptureFixture[str]) -> None:
    names = ["board.py", "car.yaml", "main.py", "project.yaml", "road.py", "test_road.py"]
    assert sorted(path.name for path in drive.rglob("*.*")) == names
    assert vicode("check", ".", "--strict") == 0
    assert vicode("run", "car.yaml", "--until-done") == 0
    out = capfd.readouterr().out
    assert "Car: Going → Standing" in out
    assert "stopped: done" in out
    assert "world: crashed False" in out


def test_its_program_steps_the_root(drive: Path) -> None:
    assert vicode("gen", ".") == 0
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(("generated/python", str(ROOT)))}
    done = subprocess.run(
        [sys.executable, "main.py"], env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    found = re.fullmatch(r"Standing after (\S+) s, (\S+) m from the wall\n", done.stdout)
    assert found is not None, done
    assert 0 < float(found[2]) < 1.5


def find_free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port: int = free.getsockname()[1]
        return port


def test_its_board_sets_the_pace(drive: Path) -> None:
    (drive / "project.yaml").write_text((drive / "project.yaml").read_text() + _ROBOT)
    ports = [find_free_port(), find_free_port()]
    board_file = drive / "hardware/board.py"
    board_file.write_text(board_file.read_text().replace("7200", f"{ports[0]}").replace("7201", f"{ports[1]}"))
    speeds: list[float] = []
    is_over = threading.Event()

    def run_board() -> None:
        distance_m, cycle = 2.0, 500
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as board:
            board.bind(("127.0.0.1", ports[1]))
            board.settimeout(0.02)
            while not is_over.is_set():
                with contextlib.suppress(TimeoutError):
                    speeds.append(float(board.recv(100)))
                distance_m, cycle = distance_m - (speeds or [0.0])[-1] * 0.01, cycle + 1
                board.sendto(f"{cycle * 10_000_000} {round(distance_m * 1000)}".encode(), ("127.0.0.1", ports[0]))

    thread = threading.Thread(target=run_board)
    thread.start()
    try:
        assert vicode("run", "car.yaml", "--profile", "robot", "--until-done", "--trace", "run.jsonl") == 0
    finally:
        is_over.set()
        thread.join()
    assert speeds[-1] == 0.0
    assert 2.0 in speeds
    lines = [json.loads(line) for line in Path("run.jsonl").read_text().splitlines()]
    assert {line["time_ns"] % 10_000_000 for line in lines[1:-1]} == {0}
    assert lines[-1]["summary"]["stopped"] == "done"


def test_its_tests_pass(drive: Path) -> None:
    code = "import test_road as t; print(len([f() for n, f in vars(t).items() if n.startswith('test_')]))"
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = [{str(drive)!r}, {str(ROOT)!r}]; {code}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "2\n"), done.stderr


def test_the_page_is_found() -> None:
    assert "(own-components.md)" in (ROOT / "docs" / "design-format.md").read_text(encoding="utf-8")
