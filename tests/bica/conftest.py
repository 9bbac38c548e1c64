"""Robots that are connected over the network of this test process."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.bica import net_robots
from tests.bica.net_robots import MakeRoot
from vicode.bica import Component, Root


@pytest.fixture
def make_root(net_port: str) -> Iterator[MakeRoot]:
    roots: list[Root] = []

    def make(component: type[Component], name: str = "", *, team: str = "", world: object = None) -> Root:
        root = Root(component, world=world)
        roots.append(root)
        if name:
            root.connect(name, team=team)
        return root

    yield make
    for root in roots:
        root.close()


@pytest.fixture
def start_robot(net_port: str) -> Iterator[Callable[..., "subprocess.Popen[str]"]]:
    processes: list[subprocess.Popen[str]] = []

    def start(name: str, component: str = "Eyes") -> "subprocess.Popen[str]":
        environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
        command = [sys.executable, net_robots.__file__, name, net_port, component]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
        processes.append(process)
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        return process

    yield start
    for process in processes:
        process.kill()
        process.communicate()
