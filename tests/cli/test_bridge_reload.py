"""`vicode bridge --reload`: changes reach robots that are connected, and errors leave the old code."""

import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LIMIT_S = 60
AGENTS = ("generated/xabsl/rescue/agents.xabsl", "--world", "arena.bridge:RescueWorld", "--path", "rescue")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Copies of the rescue project and of its XABSL code."""
    ignore = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "designs" / "rescue", tmp_path / "rescue", ignore=ignore)
    shutil.copytree(ROOT / "generated" / "xabsl" / "rescue", tmp_path / "generated" / "xabsl" / "rescue")
    return tmp_path


class Output:
    """The lines of a command, of which a test waits for one."""

    def __init__(self, process: "subprocess.Popen[str]") -> None:
        self._process, self._text = process, ""

    def wait_for(self, words: str) -> str:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._text += line
            if words in line:
                return line
        raise AssertionError(f"{words} is missing in:\n{self._text}")


@contextmanager
def running(folder: Path, *arguments: str) -> Iterator[Output]:
    command = [sys.executable, "-m", "vicode", "bridge", *arguments, "--port", "0", "--plain", "--reload"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        limit = threading.Timer(LIMIT_S, process.kill)
        limit.start()
        try:
            yield Output(process)
        finally:
            limit.cancel()
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=LIMIT_S)


@contextmanager
def driven_robot(port: int) -> Iterator[None]:
    """A robot that sends its heading until the block ends."""
    with socket.create_connection(("127.0.0.1", port), timeout=LIMIT_S) as robot:
        ended = threading.Event()

        def send() -> None:
            while not ended.wait(0.02):
                robot.sendall(b"INS:0,0,0\n")

        robot.sendall(b"ROBOT:nao\n")
        thread = threading.Thread(target=send)
        thread.start()
        try:
            yield
        finally:
            ended.set()
            thread.join()


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    # A change within the resolution of the file system would not be seen.
    time.sleep(0.05)


def test_a_changed_design_is_exchanged_and_one_with_errors_is_not(folder: Path) -> None:
    design = folder / "rescue" / "drive_circle.yaml"
    with running(folder, str(design)) as output:
        port = int(output.wait_for("listening at").split(";")[0].rpartition(":")[2])
        with driven_robot(port):
            output.wait_for("nao: runs drive_circle")
            change(design, "speed: 0.1", "speed: 0.3")
            output.wait_for("nao: reloaded rescue, rescue.drive_circle")
            change(design, "to: stop", "to: nowhere")
            output.wait_for("unknown state 'nowhere'")
            output.wait_for("vicode: not reloaded; the old code keeps running")


def test_changed_agents_of_xabsl_start_anew(folder: Path) -> None:
    agents = folder / AGENTS[0]
    with running(folder, *AGENTS, "--behavior", "robot1") as output:
        port = int(output.wait_for("listening at").split(";")[0].rpartition(":")[2])
        with driven_robot(port):
            output.wait_for("nao: runs robot1")
            (option,) = agents.parent.rglob("drive_circle.xabsl")
            change(option, "0.1", "0.3")
            output.wait_for("nao: runs robot1")
