"""Whatever is sent to the live server, the robot goes on, others are served, and nothing piles up."""

import contextlib
import gc
import json
import random
import socket
import threading
import tracemalloc
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.bica.cpp_robot import AnyRobot, any_control, any_robot, cpp_control, cpp_program, cpp_robot
from tests.bica.live_robot import Background, Eyes, Viewer, close_connections, control, is_iteration, root
from vicode.bica import Root, live_feed, live_viewer
from vicode.bica.live_server import LiveServer

__all__ = [
    "any_control",
    "any_robot",
    "close_connections",
    "control",
    "cpp_control",
    "cpp_program",
    "cpp_robot",
    "root",
]

FLOOD_LINE = b'{"focus":"x"}\n'
FRAMES_PER_CONNECTION = 50
MAX_GROWTH_BYTES = 50_000
# What may be on its way to a viewer that does not read.
MAX_BUFFERED_BYTES = 2_000_000
REQUESTS = ("pause", "resume", "step", "break", "set", "unset", "enter", "raise", "frequency", "tune", "release", "?")
FIELDS: dict[str, tuple[Any, ...]] = {
    "robot": ("Lamp", "Lamp", "Lamp", "Nobody", None, []),
    "component": ("Lamp", "Eyes", "Arms", "", 3, {}),
    "name": ("distance", "side", "count", "_secret", "__class__", "root", None),
    "value": (0, 1.5, "Side.left", "nan", True, None, [], {"a": {}}, 10**300, float("nan")),
    "state": ("Dark", "Lit", "Broken", 1),
    "count": (1, 10**6, 10**30, -1, True, "1"),
    "hz": (50, 1e-9, 1e300, float("inf"), "fast"),
    "places": ([], [["Lamp", "Lit"]], [["Lamp", "", "Lit", None]], [["", "error"]], [[]], [["Lamp", []]], "all", {}),
    "hold": (True, False, "yes"),
    "message": ("x", "x" * 5000, 7),
    "focus": ("Lamp", "Nobody", None, []),
    "id": (1, None, "a", {"deep": [[[]]]}, 10**40),
}


@pytest.fixture(autouse=True)
def quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the lines of the log, which the test would keep."""
    monkeypatch.setattr(live_feed, "print_error", lambda *_words, **_kind: None)


@pytest.fixture
def measured() -> Iterator[Callable[[], int]]:
    """Returns the memory in use."""
    tracemalloc.start()

    def read() -> int:
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    yield read
    tracemalloc.stop()


def make_frame(chance: random.Random) -> bytes:
    """A request with random fields, a damaged one, or no request at all."""
    names = chance.sample(sorted(FIELDS), chance.randrange(len(FIELDS)))
    request = {"robot": "Lamp", "do": chance.choice(REQUESTS), **{name: chance.choice(FIELDS[name]) for name in names}}
    frame = bytearray(json.dumps(request).encode())
    match chance.randrange(6):
        case 0:
            return chance.randbytes(chance.randrange(200)) + b"\n"
        case 1:
            frame[chance.randrange(len(frame))] = chance.randrange(256)
        case 2:
            del frame[chance.randrange(len(frame)) :]
        case 3 if not chance.randrange(20):
            frame = bytearray(b"[" * chance.randrange(70_000))
        case _:
            pass
    return bytes(frame) + b"\n"


def attack(server: LiveServer, chance: random.Random) -> None:
    """One connection: it sends frames, reads now and then, and ends within a frame."""
    host, _colon, port = server.address.rpartition(":")
    with contextlib.suppress(OSError), socket.create_connection((host, int(port)), timeout=10) as connection:
        if chance.randrange(10):
            connection.sendall(json.dumps({"token": server.token, "rate_hz": 200}).encode() + b"\n")
        for _frame in range(FRAMES_PER_CONNECTION):
            frame = make_frame(chance)
            parts = (frame[:3], frame[3:]) if chance.randrange(2) else (frame,)
            for part in parts:
                connection.sendall(part)
        connection.settimeout(0.001)
        with contextlib.suppress(TimeoutError):
            connection.recv(65_536)
        connection.sendall(b'{"robot":"La')


def expect_newer(viewer: Viewer, iteration: int) -> None:
    assert viewer.get(lambda line: is_iteration(line) and line["iteration"] > iteration)


@pytest.mark.parametrize("frames", [1_000, pytest.param(100_000, marks=pytest.mark.nightly)])
def test_random_frames_harm_nobody(root: Root, frames: int, measured: Callable[[], int]) -> None:
    server = root.watch(control=True)
    good = Viewer(server)
    threads = threading.active_count()
    chance = random.Random(frames)
    root.component(Eyes)
    memory = 0
    with Background(root):
        good.get(is_iteration)
        connections = frames // FRAMES_PER_CONNECTION
        for number in range(connections):
            attack(server, chance)
            expect_newer(good, root.iteration)
            if number == connections // 2:
                memory = measured()
        assert measured() - memory < MAX_GROWTH_BYTES
        assert threading.active_count() == threads + 1
    assert not server.is_closed


def test_a_flood_is_limited_and_then_disconnected(root: Root, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_viewer, "FLOOD_S", 0.5)
    handled: list[bytes] = []
    read_line = LiveServer._read_line
    monkeypatch.setattr(LiveServer, "_read_line", lambda *call: (handled.append(call[2]), read_line(*call)))
    server = root.watch()
    good, flooding = Viewer(server), Viewer(server)
    sent: list[int] = []
    with Background(root):
        with pytest.raises(ConnectionError):
            flood(flooding, sent)
        expect_newer(good, root.iteration)
    assert len(handled) < sum(sent) / len(FLOOD_LINE)


def flood(viewer: Viewer, sent: list[int]) -> None:
    """Send lines until the connection ends; `sent` gets the numbers of bytes."""
    viewer.socket.settimeout(0.05)
    for _round in range(2_000):
        with contextlib.suppress(TimeoutError):
            sent.append(viewer.socket.send(FLOOD_LINE * 5_000))


def test_a_busy_viewer_is_not_disconnected(any_robot: AnyRobot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_viewer, "FLOOD_S", 0.0)
    viewer = any_robot.viewer()
    for _round in range(3):
        places = [["Lamp", "Lit"]] * 100
        assert "done" in viewer.ask(do="break", places=places)
        for _request in range(25):
            viewer.ask(do="unset")


def test_an_allowance_grows_up_to_its_limit() -> None:
    allowance = live_viewer.Allowance(10.0, 5.0)
    begin_s = allowance._at_s
    allowance.use(5)
    assert allowance.wait_s(begin_s) == pytest.approx(0.1)
    assert allowance.wait_s(begin_s + 0.2) == 0
    allowance.use(22)
    assert allowance.wait_s(begin_s + 0.2) == pytest.approx(2.1)
    assert allowance.wait_s(begin_s + 100) == 0
    allowance.use(5)
    assert allowance.wait_s(begin_s + 100) == pytest.approx(0.1)


@pytest.mark.parametrize("line", [b"[" * 1000, b'{"focus":' + b"[]," * 300 + b"0}", b'{"focus":' + b"[" * 900])
def test_requests_with_many_values_are_refused_unread(any_control: Viewer, line: bytes) -> None:
    any_control.socket.sendall(line + b"\n")
    with pytest.raises(ConnectionError):
        any_control.get(lambda _line: False)


def test_a_busy_viewer_is_not_disconnected_in_any_language(any_control: Viewer) -> None:
    for _round in range(3):
        assert "done" in any_control.ask(do="break", places=[["Lamp", "Lit"]] * 100)
        for _request in range(25):
            any_control.ask(do="unset")


def test_a_flood_and_a_viewer_that_never_reads_do_not_stop_the_robot(root: Root, measured: Callable[[], int]) -> None:
    root.component(Eyes).note = "x" * 50_000  # type: ignore[attr-defined]
    server = root.watch(control=True)
    slow, good = Viewer(server), Viewer(server)
    line = json.dumps({"id": 1, "robot": "Lamp", "do": "unset"}).encode() + b"\n"
    with Background(root):
        good.get(is_iteration)
        before = measured()
        for _round in range(20):
            with contextlib.suppress(OSError):
                flooding = Viewer(server)
                flooding.socket.settimeout(0.05)
                flooding.socket.sendall(line * 20_000)
            expect_newer(good, root.iteration)
            flooding.socket.close()
        assert measured() - before < MAX_BUFFERED_BYTES
    slow.socket.close()
