"""Runs a design with a component in another process, and finds robots by name."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.bica import Component, Root

ROOT = Path(__file__).parents[2]
PROJECT = """\
vicode: 1
project: Search
enumerations: {Side: [left, right]}
components:
  Perception:
    implementation: sim:Perception
    parameters: {seek: {type: Side, default: Side.left}}
    outputs: {found: bool, side: {type: Side, initial: Side.left}, is_alive: {type: bool, initial: true}}
profiles:
  split: {components: {Perception: {remote: camera/Perception, max_age: 30}, Approach: {remote: legs/Approach}}}
"""
SEARCHER = """\
vicode: 1
component: Searcher
uses: {perception: Perception, approach: Approach}
initial: Look
states:
  Look:
    modulates: {perception: {seek: Side.right}}
    transitions: [{to: Go, when: perception.is_alive and perception.found and perception.side == Side.right}]
  Go: {modulates: {approach: {speed: 2}}, transitions: [{to: End, when: done(approach)}]}
  End: {final: true}
"""
APPROACH = """\
vicode: 1
component: Approach
parameters: {speed: {type: float, default: 0}}
initial: Walk
states:
  Walk: {transitions: [{to: There, when: speed > 1}]}
  There: {final: true}
"""
SIM = """\
from search.declarations import Side
from vicode.bica import Component


class Perception(Component):
    def __init__(self, root):
        super().__init__(root)
        self.found, self.side, self.is_alive = False, Side.left, True

    def modulate(self, *, seek=Side.left):
        self.side = seek

    def work(self):
        self.found = True
"""

Start = Callable[..., None]


@pytest.fixture
def search(tmp_path: Path, net_port: str, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in (
        ("project.yaml", PROJECT),
        ("searcher.yaml", SEARCHER),
        ("approach.yaml", APPROACH),
        ("sim.py", SIM),
    ):
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def start() -> Iterator[Start]:
    processes: list[subprocess.Popen[bytes]] = []

    def start(*arguments: str) -> None:
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        processes.append(subprocess.Popen([sys.executable, "-m", *arguments], env=environment))

    yield start
    for process in processes:
        process.terminate()
    for process in processes:
        process.wait()


def test_components_work_in_other_processes(search: Path, start: Start, capfd: pytest.CaptureFixture[str]) -> None:
    assert vicode("gen", ".", "--out", "out") == 0
    start("vicode.bica", "sim:Perception", "--net", "camera", "--real-time", "--path", ".", "--path", "out/python")
    start("vicode", "run", "approach.yaml", "--net", "legs", "--on-call", "--real-time", "--plain")
    run = ("run", "searcher.yaml", "--profile", "split", "--real-time", "--until-done", "--seconds", "60", "--plain")
    assert vicode(*run) == 0
    printed = capfd.readouterr().out
    assert "Searcher: Look → Go" in printed
    assert "stopped: done, last state: End" in printed


def test_a_missing_extra_is_one_line(search: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (search / "zenoh.py").write_text("raise ImportError\n")
    assert vicode("run", "searcher.yaml", "--profile", "split", "--ticks", "1") == 2
    printed = capfd.readouterr().err
    assert "zenoh, which is not installed: pip install 'vicode-fsm[net]'" in printed
    assert "Traceback" not in printed


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--net", "r1"), "--net needs --real-time"),
        (("--team", "blue"), "--team has no effect without --net"),
        (("--on-call",), "--on-call has no effect without --net"),
        (("--net", "a b", "--real-time"), "'a b' is no name of a robot"),
    ],
)
def test_wrong_options_are_one_line(
    search: Path, capfd: pytest.CaptureFixture[str], options: tuple[str, ...], message: str
) -> None:
    assert vicode("run", "approach.yaml", "--ticks", "1", *options) == 2
    assert message in capfd.readouterr().err


class Lamp(Component):
    """Does nothing."""


def test_robots_are_found_by_name(net_port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with Root(Lamp) as robot, Root(Lamp) as other:
        assert vicode("attach", "--find") == 1
        assert "no robot was found" in capsys.readouterr().err
        server = robot.watch()
        robot.connect("r1")
        other.connect("r2")
        second = other.watch()
        assert vicode("attach", "--find") == 0
        assert capsys.readouterr().out == f"r1  {server.address}\nr2  {second.address}\n"
        assert vicode("attach", "r2", "--token", "wrong", "--print") == 2
        assert f"{second.address} " in capsys.readouterr().err
        assert vicode("attach", "r3") == 2
        assert "there is no robot 'r3'; the robots are r1, r2" in capsys.readouterr().err


def test_the_name_of_a_robot_elsewhere_says_how_to_reach_it(
    net_port: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with Root(Lamp) as robot, monkeypatch.context() as elsewhere:
        elsewhere.setattr("socket.gethostname", lambda: "nao-3")
        robot.connect("r1")
        server = robot.watch()
        elsewhere.undo()
        monkeypatch.setenv("VICODE_NET_PORT", net_port)
        assert vicode("attach", "r1") == 2
    port = server.address.rpartition(":")[2]
    assert f"ssh -L {port}:127.0.0.1:{port} nao-3, then attach to {port}" in capsys.readouterr().err


def test_attach_needs_a_robot(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("attach") == 2
    assert "--find" in capsys.readouterr().err
