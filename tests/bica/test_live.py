"""The live view: viewers see a running root, may control it if it allows that, and never slow it down."""

import contextlib
import json
import random
import socket
from pathlib import Path
from typing import Any

import pytest

from tests.bica.cpp_robot import AnyRobot, CppRobot, any_robot, cpp_program, cpp_robot
from tests.bica.live_robot import (
    LIMIT_S,
    MOST_STEPS,
    Background,
    Lamp,
    Viewer,
    advance,
    close_connections,
    control,
    is_iteration,
    make_root,
    root,
)
from vicode.bica import Root, live_server
from vicode.bica.live_server import MAX_VIEWERS, LiveServer

__all__ = ["any_robot", "close_connections", "control", "cpp_program", "cpp_robot", "root"]


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


def test_state_changes_between_two_lines_are_told(any_robot: AnyRobot) -> None:
    viewer = any_robot.viewer(rate_hz=1)
    viewer.get(is_iteration)
    control = any_robot.viewer()
    for number in range(10):
        control.ask(do="set", component="Eyes", name="distance", value=5 * (number % 2))
        state = "Dark" if number % 2 else "Lit"
        control.get(lambda line, state=state: is_iteration(line) and line["tree"][0]["state"] == state)
    changes: list[dict[str, Any]] = []
    while len(changes) < 10:
        changes += viewer.get(lambda line: is_iteration(line) and line["changes"])["changes"]
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


def test_a_server_that_stays_open_shows_the_robots_that_come_and_go() -> None:
    server = LiveServer(stays_open=True)
    try:
        with make_root() as one:
            server.add(one, "one")
            viewer = Viewer(server, one)
            assert [each["name"] for each in viewer.get(lambda line: "vicode-live" in line)["robots"]] == ["one"]
        with make_root() as other:
            server.add(other, "other")
            viewer.root = other
            hello = viewer.get(lambda line: "vicode-live" in line and line["robots"])
            assert [each["name"] for each in hello["robots"]] == ["other"]
            assert viewer.get(is_iteration)["robot"] == "other"
    finally:
        server.close()


def test_several_robots_share_a_server() -> None:
    with make_root() as one, make_root() as other:
        server = one.watch(name="one")
        server.add(other, "one")
        viewer = Viewer(server, one)
        names = {
            robot["name"] for robot in viewer.get(lambda line: "robots" in line and len(line["robots"]) == 2)["robots"]
        }
        assert names == {"one", "one 2"}
        with Background(other):
            assert viewer.get(lambda line: line.get("robot") == "one 2")["tree"]


def test_robots_that_a_viewer_does_not_look_at_are_sent_less_often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_server, "_REST_PERIOD_S", 1e6)
    with make_root() as one, make_root() as other:
        server = one.watch(name="one")
        feed = server.add(other, "other")
        other._closing.callback(server.remove, feed)
        viewer = Viewer(server, one)
        viewer.send({"focus": "one"})
        viewer.get(is_iteration)
        with Background(other):
            robots = [viewer.get(is_iteration)["robot"] for _number in range(30)]
            assert robots.count("other") <= 2
            assert robots.count("one") >= 28
            assert "values" not in feed.newest[1]["tree"][0]
            viewer.send({"focus": "other"})
            assert viewer.get(lambda line: line.get("robot") == "other" and "values" in line["tree"][0])


@pytest.mark.parametrize("first", [{"token": "wrong"}, {"token": None}, {"token": ["x"]}, {"token": "ä"}])
def test_a_wrong_token_ends_the_connection(any_robot: AnyRobot, first: dict[str, Any]) -> None:
    viewer = any_robot.viewer(**first)
    assert viewer.get(bool) == {"error": "wrong token"}
    with pytest.raises(ConnectionResetError):
        viewer.get(bool)


def expect_private_socket(path: Path) -> None:
    assert path.stat().st_mode & 0o777 == 0o600
    with socket.socket(socket.AF_UNIX) as connection:
        connection.settimeout(LIMIT_S)
        connection.connect(str(path))
        connection.sendall(b"{}\n")
        assert b"vicode-live" in connection.recv(4096)


def test_a_unix_socket_needs_no_token_and_is_private(root: Root, tmp_path: Path) -> None:
    path = tmp_path / "robot.sock"
    root.watch(f"unix:{path}")
    expect_private_socket(path)
    root.close()
    assert not path.exists()


def test_a_unix_socket_in_cpp_is_private_too(cpp_program: Path, tmp_path: Path) -> None:
    path = tmp_path / "robot.sock"
    robot = CppRobot(cpp_program, "--watch", f"unix:{path}")
    expect_private_socket(path)
    robot.end()
    assert not path.exists()


def test_a_viewer_that_does_not_read_misses_iterations_but_never_the_newest(root: Root) -> None:
    root.component(Lamp).note = "x" * 60_000  # type: ignore[attr-defined]
    viewer = Viewer(root.watch(), root, rate_hz=200)
    viewer.get(is_iteration)
    for _step in range(2_000):
        advance(root)
    last = root.iteration
    assert viewer.get(lambda line: is_iteration(line) and line["iteration"] >= last)["iteration"] >= last


def test_random_bytes_harm_nobody(any_robot: AnyRobot, capsys: pytest.CaptureFixture[str]) -> None:
    server = any_robot.server
    good = any_robot.viewer()
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
    before = good.get(is_iteration)["iteration"]
    assert good.get(lambda line: is_iteration(line) and line["iteration"] > before)
    assert "live view ended" not in capsys.readouterr().err


@pytest.mark.parametrize("rate_hz", [1e-300, 5e-324, 0, -1, 10**400, float("nan"), "fast", None])
def test_an_odd_rate_does_not_end_the_server(any_robot: AnyRobot, rate_hz: object) -> None:
    good = any_robot.viewer()
    any_robot.viewer(rate_hz=rate_hz).get(is_iteration)
    good.get(is_iteration)
    for _step in range(20):
        good.get(is_iteration)


def test_a_viewer_that_never_reads_its_answers_is_disconnected(any_robot: AnyRobot) -> None:
    viewer = Viewer(any_robot.server)
    # On a busy machine the server takes longer to answer so many requests.
    viewer.socket.settimeout(6 * LIMIT_S)
    with pytest.raises(OSError, match=r"reset|Broken pipe"):
        viewer.socket.sendall(b'{"robot": 1}\n' * 5_000_000)
    assert any_robot.viewer().get(is_iteration)


def test_strangers_do_not_keep_viewers_out(any_robot: AnyRobot) -> None:
    port = int(any_robot.server.address.rpartition(":")[2])
    with contextlib.ExitStack() as strangers:
        for _number in range(MAX_VIEWERS):
            strangers.enter_context(socket.create_connection(("127.0.0.1", port)))
        assert any_robot.viewer().get(is_iteration)


def test_a_root_is_watched_once(root: Root) -> None:
    root.watch()
    with pytest.raises(OSError, match="watched already"):
        root.watch()


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
