"""Connecting to robots: addresses, and why a connection is refused."""

import asyncio
import contextlib
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from vicode.bica import Component, Root, SimulatedClock
from vicode.robots import AttachError, Hello, RobotAddress, connect, parse_address


class Idle(Component):
    """A component without states."""


def try_address(text: str, token: str = "") -> Hello:
    async def connect_once() -> Hello:
        transport, hello = await connect(parse_address(text), token)
        transport.close()
        await transport.wait_closed()
        return hello

    return asyncio.run(connect_once())


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("7070", RobotAddress(host="127.0.0.1", port=7070)),
        ("robot:7070", RobotAddress(host="robot", port=7070)),
        (":7070", RobotAddress(host="127.0.0.1", port=7070)),
        ("[::1]:7070", RobotAddress(host="::1", port=7070)),
        ("unix:/run/robot.sock", RobotAddress(path="/run/robot.sock")),
    ],
)
def test_addresses(text: str, address: RobotAddress) -> None:
    assert parse_address(text) == address


@pytest.mark.parametrize("text", ["", "robot", "unix:", "robot:port", "0", "70700", "a:-1"])
def test_what_is_no_address(text: str) -> None:
    with pytest.raises(AttachError, match="write PORT, HOST:PORT or unix:PATH"):
        parse_address(text)


def test_a_robot_describes_itself(tmp_path: Path) -> None:
    with Root(Idle, clock=SimulatedClock()) as root:
        server = root.watch(token="right", control=True, without_hold=True)
        hello = try_address(server.address, "right")
        assert hello.control
        assert [(robot.name, list(robot.components)) for robot in hello.robots] == [("Idle", ["Idle"])]
        for token in ("wrong", ""):
            with pytest.raises(AttachError, match="token") as caught:
                try_address(server.address, token)
            assert caught.value.is_final
    with Root(Idle, clock=SimulatedClock()) as root:
        root.watch(f"unix:{tmp_path / 'robot.sock'}")
        assert try_address(f"unix:{tmp_path / 'robot.sock'}").robots


def test_nobody_listens(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    for address in (str(port), f"unix:{tmp_path / 'none.sock'}"):
        with pytest.raises(AttachError, match="no robot listens") as caught:
            try_address(address)
        assert not caught.value.is_final


@contextlib.contextmanager
def answering(line: bytes) -> Iterator[str]:
    """A server that answers each connection with a line."""
    server = socket.create_server(("127.0.0.1", 0))

    def answer() -> None:
        with contextlib.suppress(OSError):
            while True:
                connection, _address = server.accept()
                connection.sendall(line)
                connection.recv(1000)
                connection.close()

    threading.Thread(target=answer, daemon=True).start()
    try:
        yield str(server.getsockname()[1])
    finally:
        server.shutdown(socket.SHUT_RDWR)
        server.close()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (b"HTTP/1.1 400 Bad Request\r\n", "no vicode robot answers"),
        (b"[]\n", "no vicode robot answers"),
        (b"{}\n", "no vicode robot answers"),
        (b'{"vicode-live": 1, "robots": [3]}\n', "no vicode robot answers"),
        (b'{"vicode-live": 2, "robots": []}\n', "version 2 of the protocol"),
    ],
)
def test_another_program_answers(line: bytes, words: str) -> None:
    with answering(line) as address, pytest.raises(AttachError, match=words):
        try_address(address)
