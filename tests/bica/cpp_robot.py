"""The robot of live_robot.py in C++: a program that is compiled once per session, and its processes."""

import os
import re
import subprocess
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import pytest

from tests.bica.live_robot import Background, Viewer
from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_project
from vicode.bica import Root

LAMP = Path(__file__).with_name("cpp_lamp")
SECONDS = 20


@pytest.fixture(scope="session")
def cpp_program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The compiled program; CXXFLAGS may add sanitizers."""
    folder = tmp_path_factory.mktemp("lamp")
    package = write_project(LAMP, folder)
    flags = (*STANDARD, *WARNINGS, "-DBICA_LIVE", *os.environ.get("CXXFLAGS", "-O1").split())
    sources = [f"{package}_unit.cpp", str(LAMP / "main.cpp")]
    program = folder / "lamp"
    outputs([start([find_gpp(), *flags, "-I.", *sources, "-pthread", "-o", str(program)], folder / "cpp")])
    return program


class CppRobot:
    """A running program; `address` and `token` are those that it prints."""

    def __init__(self, program: Path, *arguments: str, **environment: str) -> None:
        self.process = subprocess.Popen(
            [program, *arguments],
            env={**os.environ, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.address = self.token = ""
        if "--watch" in arguments:
            assert self.process.stderr is not None
            line = self.process.stderr.readline()
            found = re.fullmatch(r"watch: vicode attach (\S+)(?: --token (\w+))?\n", line)
            assert found is not None, line
            self.address, self.token = found[1], found[2] or ""

    def end(self) -> tuple[str, str]:
        """End the program; return what it printed and logged."""
        printed = self.process.communicate(timeout=SECONDS)
        assert self.process.returncode == 0, printed
        return printed


@pytest.fixture
def cpp_robot(cpp_program: Path) -> Iterator[CppRobot]:
    robot = CppRobot(cpp_program, "--watch", "0", "--control")
    yield robot
    robot.process.kill()
    robot.process.communicate()


@pytest.fixture
def cpp_control(cpp_robot: CppRobot) -> Viewer:
    viewer = Viewer(cpp_robot)
    viewer.get(lambda line: "iteration" in line)
    return viewer


@pytest.fixture(params=["python", "cpp"])
def any_control(request: pytest.FixtureRequest) -> Viewer:
    """A viewer that controls a robot in each language; the one in Python is stepped by the viewer."""
    viewer: Viewer = request.getfixturevalue("control" if request.param == "python" else "cpp_control")
    return viewer


class AnyRobot:
    """A robot that may be controlled, in Python (stepped by its viewers or in the background) or in C++."""

    def __init__(self, server: Any, root: Root | None) -> None:
        self.server, self.root = server, root

    def viewer(self, **first: Any) -> Viewer:
        return Viewer(self.server, self.root, **first)

    def running(self) -> AbstractContextManager[None]:
        """The robot without steps by viewers."""
        running = Background(self.root) if self.root is not None else nullcontext()
        self.root = None
        return running


@pytest.fixture(params=["python", "cpp"])
def any_robot(request: pytest.FixtureRequest) -> AnyRobot:
    if request.param == "cpp":
        return AnyRobot(request.getfixturevalue("cpp_robot"), None)
    root: Root = request.getfixturevalue("root")
    return AnyRobot(root.watch(control=True), root)
