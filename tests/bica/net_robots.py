"""Robots that are connected, in this process or in another; run as a program, a robot that has eyes.

python net_robots.py NAME PORT Eyes|Blocker connects as NAME and steps the component; a blocker is ready when it blocks.
"""

import os
import sys
import time
from collections.abc import Callable
from enum import Enum

from vicode.bica import Component, Root, State
from vicode.bica.remote import RemoteComponent

MakeRoot = Callable[..., Root]
LIMIT_S = 30.0


class Side(Enum):
    left = 0
    right = 1


class Eyes(Component):
    """Counts its steps; the parameters can be seen in the outputs."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.steps = 0
        self.starts = 0
        self.distance = 5.0
        self.seen = False
        self.side = Side.right
        self.history: list[float] = []

    def modulate(self, *, zoom: float = 1, seek: Side = Side.left) -> None:
        if zoom == 13:
            raise RuntimeError("unlucky")
        self.distance, self.side = zoom, seek

    def restart(self) -> None:
        self.starts += 1

    def work(self) -> None:
        self.steps += 1
        self.history.append(self.distance)


class Watch(Component):
    """A design that is done after its second step."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._set_states(State("Begin", self._in_begin), State("End", self._in_end, final=True))

    def _in_begin(self, decide: bool = True) -> None:
        if decide:
            self._change_to("End")

    def _in_end(self, decide: bool = True) -> None:
        pass


class RemoteEyes(RemoteComponent):
    """What is generated for `Eyes: {remote: striker/Eyes}`."""

    REMOTE = "striker/Eyes"
    RELIABLE = False
    MAX_AGE = 30.0

    def __init__(self, root: Root) -> None:
        super().__init__(root, self.REMOTE, reliable=self.RELIABLE, max_age=self.MAX_AGE)
        self.zoom = 1.0
        self.seek = Side.left
        self.distance = 0.0
        self.steps = 0
        self.seen = True
        self.side = Side.left

    def modulate(self, *, zoom: float = 1.0, seek: Side = Side.left) -> None:
        self.zoom, self.seek = zoom, seek


class ReliableEyes(RemoteEyes):
    RELIABLE = True


class RemoteWatch(RemoteComponent):
    def __init__(self, root: Root) -> None:
        super().__init__(root, "striker/Watch")


class Idle(Component):
    """Steps nothing."""


class Blocker(Component):
    """Enters a state that has room for one robot."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._set_states(State("Wait", self._in_wait), State("Block", self._in_block, capacity=1))

    def _in_wait(self, decide: bool = True) -> None:
        if decide:
            self._change_to("Block")

    def _in_block(self, decide: bool = True) -> None:
        if decide:
            self._stay()


class Field:
    """A world that shares its place."""

    team_fields = ("x", "role", "path")

    def __init__(self, x: float = 0, role: str = "") -> None:
        self.x, self.role, self.path, self.secret = x, role, [x], 1
        self.robots: dict[str, object] = {}


def step_until(condition: Callable[[], object], *roots: Root) -> None:
    """Step roots until a condition holds; fails only if it never does."""
    end = time.monotonic() + LIMIT_S
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        for root in roots:
            root.step()
        time.sleep(0.001)


def main(name: str, port: str, component: str) -> None:
    os.environ["VICODE_NET_PORT"] = port
    with Root({"Eyes": Eyes, "Blocker": Blocker}[component]) as root:
        root.connect(name, team="blue")
        step_until(lambda: root.main.state in ("", "Block"), root)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        while True:
            root.step()
            time.sleep(0.002)


if __name__ == "__main__":
    main(*sys.argv[1:])
