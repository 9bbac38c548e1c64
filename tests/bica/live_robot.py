"""A robot that is watched, and its viewers."""

import contextlib
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any, ClassVar

import pytest

from vicode.bica import Component, Root, SimulatedClock, State
from vicode.bica.live_server import LiveServer

LIMIT_S = 10.0
MOST_STEPS = 20_000


class Side(Enum):
    left = 0
    right = 1


class Eyes(Component):
    frequency_hz = 50

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.distance = 5.0
        self.side = Side.left
        self._secret = 1

    def work(self) -> None:
        self.distance -= 0.0


class Lamp(Component):
    design_file = "lamp.yaml"

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.eyes = root.component(Eyes)
        self.count = 0
        self._set_states(
            State("Dark", self._in_dark, requires=(self.eyes,)), State("Lit", self._in_lit, requires=(self.eyes,))
        )

    def _in_dark(self, decide: bool = True) -> None:
        if decide and self.eyes.distance < 1:
            self._change_to("Lit")
            return
        self.count += 1

    def _in_lit(self, decide: bool = True) -> None:
        if decide and self.eyes.distance >= 1:
            self._change_to("Dark")


class Field:
    """A world that counts how often it was held."""

    def __init__(self) -> None:
        self.holds = 0

    def hold(self) -> None:
        self.holds += 1


class Viewer:
    """A connection; `get` steps the robot until a line arrives that fits."""

    open: ClassVar[list[socket.socket]] = []

    def __init__(self, server: LiveServer, root: Root | None = None, **first: Any) -> None:
        host, _colon, port = server.address.rpartition(":")
        self.socket = socket.create_connection((host, int(port)), timeout=LIMIT_S)
        self.open.append(self.socket)
        self.root = root
        self.lines: list[dict[str, Any]] = []
        self._buffer = b""
        self.send({"token": server.token, "rate_hz": 200, **first})

    def send(self, *messages: dict[str, Any]) -> None:
        self.socket.sendall(b"".join(json.dumps(message).encode() + b"\n" for message in messages))

    def get(self, fits: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
        for _attempt in range(MOST_STEPS):
            for index, line in enumerate(self.lines):
                if fits(line):
                    del self.lines[: index + 1]
                    return line
            self._receive()
        raise AssertionError("no such line")

    def ask(self, **request: Any) -> dict[str, Any]:
        self.send({"id": 7, "robot": "Lamp", **request})
        return self.get(lambda line: line.get("answer") == 7)

    def _receive(self) -> None:
        if self.root is not None:
            advance(self.root)
        self.socket.settimeout(0.001 if self.root is not None else LIMIT_S)
        with contextlib.suppress(TimeoutError):
            data = self.socket.recv(65_536)
            if not data:
                raise ConnectionResetError
            *lines, self._buffer = (self._buffer + data).split(b"\n")
            self.lines += [json.loads(line) for line in lines]


@pytest.fixture(autouse=True)
def close_connections() -> Iterator[None]:
    yield
    while Viewer.open:
        Viewer.open.pop().close()


def advance(root: Root) -> None:
    root.step()
    assert isinstance(root.clock, SimulatedClock)
    root.clock.advance(20_000_000)


def make_root() -> Root:
    return Root(Lamp, clock=SimulatedClock(), world=Field())


@pytest.fixture
def root() -> Iterator[Root]:
    with make_root() as made:
        yield made


def is_iteration(line: dict[str, Any]) -> bool:
    return "iteration" in line


@pytest.fixture
def control(root: Root) -> Viewer:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    return viewer


class Background:
    """Steps a root in a thread until it is left."""

    def __init__(self, root: Root) -> None:
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(root,), daemon=True)

    def __enter__(self) -> None:
        self._thread.start()

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        self._thread.join(LIMIT_S)
        assert not self._thread.is_alive()

    def _run(self, root: Root) -> None:
        while not self._is_over.is_set():
            advance(root)
            time.sleep(0.0001)
