"""The live view: viewers see a running root, may control it if it allows that, and never slow it down."""

import contextlib
import json
import random
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator
from enum import Enum
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar

import pytest

from vicode.bica import Component, Root, SimulatedClock, State
from vicode.bica.live_server import MAX_VIEWERS, LiveServer

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
def _close_connections() -> Iterator[None]:
    yield
    while Viewer.open:
        Viewer.open.pop().close()


def advance(root: Root) -> None:
    root.step()
    assert isinstance(root.clock, SimulatedClock)
    root.clock.advance(20_000_000)


def make_root() -> Root:
    return Root(Lamp, clock=SimulatedClock())


@pytest.fixture
def root() -> Iterator[Root]:
    with make_root() as made:
        yield made


def is_iteration(line: dict[str, Any]) -> bool:
    return "iteration" in line


def test_a_viewer_sees_the_activation_tree(root: Root) -> None:
    viewer = Viewer(root.watch(), root)
    hello = viewer.get(lambda line: "vicode-live" in line)
    (robot,) = hello["robots"]
    assert (robot["name"], robot["root"], hello["control"]) == ("Lamp", "Lamp", False)
    assert robot["components"]["Lamp"]["states"] == ["Dark", "Lit"]
    assert len(robot["components"]["Lamp"]["code"]) == 64
    line = viewer.get(is_iteration)
    steps = {step["component"]: step for step in line["tree"]}
    assert steps["Lamp"]["state"] == "Dark"
    assert steps["Eyes"]["values"] == {"distance": 5.0, "side": "Side.left"}
    assert steps["Lamp"]["step_ns"] >= steps["Eyes"]["step_ns"] > 0


def test_state_changes_between_two_lines_are_told(root: Root) -> None:
    viewer = Viewer(root.watch(), root, rate_hz=5)
    viewer.get(is_iteration)
    eyes = root.component(Eyes)
    for number in range(10):
        eyes.distance = 0.0 if number % 2 == 0 else 5.0
        advance(root)
    changes = viewer.get(lambda line: is_iteration(line) and line["changes"])["changes"]
    assert [(change["source"], change["target"]) for change in changes[:2]] == [("Dark", "Lit"), ("Lit", "Dark")]
    assert [change["number"] for change in changes] == list(range(1, 11))


def test_nothing_is_replaced_before_and_after_a_visit(root: Root) -> None:
    server = root.watch()
    advance(root)
    assert "step" not in vars(root.main)
    viewer = Viewer(server, root)
    viewer.get(is_iteration)
    assert "step" in vars(root.main)
    viewer.socket.close()
    for _step in range(MOST_STEPS):
        advance(root)
        if "step" not in vars(root.main):
            break
    assert "step" not in vars(root.main)
    assert "modulate" not in vars(root.main)
    count = root.component(Lamp).count
    advance(root)
    assert root.component(Lamp).count == count + 1


def test_several_robots_share_a_server() -> None:
    with make_root() as one, make_root() as other:
        server = one.watch(name="one")
        other._closing.callback(server.remove, server.add(other, "one"))
        viewer = Viewer(server, one)
        names = {
            robot["name"] for robot in viewer.get(lambda line: "robots" in line and len(line["robots"]) == 2)["robots"]
        }
        assert names == {"one", "one 2"}
        with Background(other):
            assert viewer.get(lambda line: line.get("robot") == "one 2")["tree"]


@pytest.mark.parametrize("first", [{"token": "wrong"}, {"token": None}, {"token": ["x"]}, {"token": "ä"}])
def test_a_wrong_token_ends_the_connection(root: Root, first: dict[str, Any]) -> None:
    viewer = Viewer(root.watch(), **first)
    with pytest.raises(ConnectionResetError):
        viewer.get(bool)


def test_a_unix_socket_needs_no_token_and_is_private(root: Root, tmp_path: Path) -> None:
    path = tmp_path / "robot.sock"
    root.watch(f"unix:{path}")
    assert path.stat().st_mode & 0o777 == 0o600
    with socket.socket(socket.AF_UNIX) as connection:
        connection.settimeout(LIMIT_S)
        connection.connect(str(path))
        connection.sendall(b"{}\n")
        assert b"vicode-live" in connection.recv(4096)
    root.close()
    assert not path.exists()


def test_control_needs_permission(root: Root) -> None:
    viewer = Viewer(root.watch(), root)
    assert "may only be watched" in viewer.ask(do="pause")["error"]
    advance(root)


@pytest.fixture
def control(root: Root) -> Viewer:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    return viewer


def test_values_are_set_and_held(root: Root, control: Viewer) -> None:
    assert control.ask(do="set", component="Eyes", name="distance", value=0)["done"] == "set Eyes.distance = 0.0"
    assert root.main.state == "Lit"
    control.ask(do="set", component="Eyes", name="side", value="Side.right", hold=True)
    eyes = root.component(Eyes)
    eyes.side = Side.left
    advance(root)
    assert eyes.side is Side.right
    control.ask(do="unset", component="Eyes", name="side")
    eyes.side = Side.left
    advance(root)
    assert eyes.side is Side.left


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        ({"do": "set", "component": "Eyes", "name": "_secret", "value": 2}, "no value '_secret'"),
        ({"do": "set", "component": "Eyes", "name": "__class__", "value": 2}, "no value '__class__'"),
        ({"do": "set", "component": "Eyes", "name": "root", "value": 2}, "no value 'root'"),
        ({"do": "set", "component": "Eyes", "name": "distance", "value": "far"}, "type float"),
        ({"do": "set", "component": "Eyes", "name": "distance", "value": True}, "type float"),
        ({"do": "set", "component": "Eyes", "name": "side", "value": "Side.up"}, "Side.left, Side.right"),
        ({"do": "enter", "component": "Lamp", "state": "Broken"}, "no state 'Broken'"),
        ({"do": "break", "places": [["Lamp", "Broken"]]}, "no state 'Broken'"),
        ({"do": "break", "places": "all"}, "list of"),
        ({"do": "step", "count": -1}, "whole number"),
        ({"do": "frequency", "component": "Eyes", "hz": 0}, "greater than 0"),
        ({"do": "tune", "name": "os", "value": 1}, "no component uses"),
        ({"do": "dance"}, "unknown request"),
        ({"do": "raise", "component": "Arms"}, "no component 'Arms'"),
    ],
)
def test_requests_that_cannot_be_done_say_why(control: Viewer, request_: dict[str, Any], words: str) -> None:
    assert words in control.ask(**request_)["error"]


def test_a_state_is_entered_and_an_error_injected(
    root: Root, control: Viewer, capsys: pytest.CaptureFixture[str]
) -> None:
    assert control.ask(do="enter", component="Lamp", state="Lit")["done"] == "Lamp: Dark → Lit"
    control.ask(do="raise", component="Lamp", message="no light")
    advance(root)
    assert root.errors.total() == 1
    err = capsys.readouterr().err
    assert "InjectedError: no light" in err
    assert "control: Lamp: Lamp: Dark → Lit" in err


def test_frequencies_change_at_run_time(root: Root, control: Viewer) -> None:
    control.ask(do="frequency", component="Eyes", hz=10)
    eyes = root.component(Eyes)
    advance(root)
    worked = eyes._worked_ns
    advance(root)
    assert eyes._worked_ns == worked
    for _step in range(5):
        advance(root)
    assert eyes._worked_ns == worked + 100_000_000


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


def test_a_breakpoint_pauses_and_steps_go_on(root: Root) -> None:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    viewer.ask(do="break", places=[["Lamp", "Lit"]])
    root.component(Eyes).distance = 0.0
    viewer.root = None
    with Background(root):
        line = viewer.get(lambda line: line.get("paused"))
        assert line["tree"][0]["state"] == "Lit"
        iteration = line["iteration"]
        viewer.send({"id": 1, "robot": "Lamp", "do": "step"})
        following = viewer.get(lambda line: is_iteration(line) and line["iteration"] > iteration)
        assert following["iteration"] == iteration + 1
        time.sleep(0.1)
        assert root.main._stepped_in == iteration + 1
        viewer.send({"id": 2, "robot": "Lamp", "do": "break", "places": []}, {"id": 3, "robot": "Lamp", "do": "resume"})
        assert viewer.get(lambda line: is_iteration(line) and not line["paused"])


def test_a_pause_ends_with_the_viewer(root: Root) -> None:
    viewer = Viewer(root.watch(control=True), root)
    viewer.get(is_iteration)
    viewer.root = None
    with Background(root):
        viewer.send({"id": 1, "robot": "Lamp", "do": "pause"})
        viewer.get(lambda line: line.get("paused"))
        viewer.socket.close()


def test_a_viewer_that_does_not_read_misses_iterations_but_never_the_newest(root: Root) -> None:
    root.component(Lamp).note = "x" * 60_000  # type: ignore[attr-defined]
    viewer = Viewer(root.watch(), root, rate_hz=200)
    viewer.get(is_iteration)
    for _step in range(2_000):
        advance(root)
    last = root.iteration
    assert viewer.get(lambda line: is_iteration(line) and line["iteration"] >= last)["iteration"] >= last


def test_random_bytes_harm_nobody(root: Root, capsys: pytest.CaptureFixture[str]) -> None:
    server = root.watch(control=True)
    good = Viewer(server, root)
    source = random.Random(1)
    lines = [b"{}", b"[]", b"null", b'{"token":', b"\xff\xfe", b"{" * 5_000, b'{"robot":"Lamp","do":[]}', b"1e999"]
    for number in range(300):
        with (
            contextlib.suppress(OSError),
            socket.create_connection(("127.0.0.1", int(server.address.split(":")[1]))) as bad,
        ):
            if number % 2:
                bad.sendall(json.dumps({"token": server.token}).encode() + b"\n")
            bad.sendall(source.choice(lines) + source.randbytes(source.randrange(50)) + b"\n")
            if number % 10 == 0:
                bad.sendall(b"x" * 200_000)
    before = root.iteration
    assert good.get(lambda line: is_iteration(line) and line["iteration"] > before)
    assert "live view ended" not in capsys.readouterr().err


@pytest.mark.parametrize("rate_hz", [1e-300, 5e-324, 0, -1, 10**400, float("nan"), "fast", None])
def test_an_odd_rate_does_not_end_the_server(root: Root, rate_hz: object) -> None:
    server = root.watch()
    good = Viewer(server, root)
    Viewer(server, root, rate_hz=rate_hz).get(is_iteration)
    good.get(is_iteration)
    for _step in range(20):
        good.get(is_iteration)


def test_a_viewer_that_never_reads_its_answers_is_disconnected(root: Root) -> None:
    server = root.watch(control=True)
    viewer = Viewer(server)
    with pytest.raises(OSError, match=r"reset|Broken pipe"):
        viewer.socket.sendall(b'{"robot": 1}\n' * 5_000_000)
    assert Viewer(server, root).get(is_iteration)


def test_an_iteration_handles_a_limited_number_of_requests(root: Root, control: Viewer) -> None:
    control.send(*({"id": number, "robot": "Lamp", "do": "unset"} for number in range(2_000)))
    answers = [control.get(lambda line: "answer" in line) for _number in range(2_000)]
    refused = [answer for answer in answers if "too many requests" in answer.get("error", "")]
    assert 0 < len(refused) < len(answers)
    assert "done" in control.ask(do="unset")


def test_strangers_do_not_keep_viewers_out(root: Root) -> None:
    server = root.watch()
    port = int(server.address.rpartition(":")[2])
    with contextlib.ExitStack() as strangers:
        for _number in range(MAX_VIEWERS):
            strangers.enter_context(socket.create_connection(("127.0.0.1", port)))
        assert Viewer(server, root).get(is_iteration)


def test_only_constants_are_tuned(control: Viewer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, f"{__package__}.declarations", ModuleType("declarations"))
    assert "no component uses" in control.ask(do="tune", name="__name__", value="other")["error"]


def test_a_port_in_use_does_not_keep_a_robot_from_starting(
    root: Root, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        monkeypatch.setenv("VICODE_WATCH", str(taken.getsockname()[1]))
        with make_root() as other:
            advance(other)
    assert "cannot be watched" in capsys.readouterr().err
    monkeypatch.setenv("VICODE_WATCH", "0")
    with make_root() as watched:
        advance(watched)
    assert "watch: vicode attach 127.0.0.1:" in capsys.readouterr().err
