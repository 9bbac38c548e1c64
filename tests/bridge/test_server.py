"""The server over real sockets: many robots, disconnects, TLS, stop."""

import asyncio
import json
import ssl
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from tests.bridge.certificates import make_certificate
from tests.bridge.sample_robots import make_server
from vicode.bridge import server as server_module
from vicode.bridge.behaviors import DesignCatalog
from vicode.bridge.server import BridgeOptions, BridgeServer, ListenError

LIMIT_S = 20.0
FAST = BridgeOptions(port=0, tick_ns=5_000_000)
Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]


class Network:
    """A server and its clients, which are closed at the end."""

    def __init__(self, server: BridgeServer) -> None:
        self.server = server
        self._writers: list[asyncio.StreamWriter] = []

    async def connect(self, first: bytes = b"", tls: ssl.SSLContext | None = None) -> Streams:
        reader, writer = await asyncio.open_connection("127.0.0.1", self.server.port, ssl=tls)
        self._writers.append(writer)
        assert await reader.readline() == b"Robot connection accepted\n"
        writer.write(first)
        return reader, writer

    async def close(self) -> None:
        for writer in self._writers:
            writer.transport.abort()
        await self.server.stop()
        await asyncio.sleep(0)


@asynccontextmanager
async def running(server: BridgeServer) -> AsyncIterator[Network]:
    await server.start()
    network = Network(server)
    try:
        async with asyncio.timeout(LIMIT_S):
            yield network
    finally:
        await network.close()


async def wait_until(holds: Callable[[], object]) -> None:
    while not holds():
        await asyncio.sleep(0.002)


def run(test: Callable[[], Awaitable[None]]) -> None:
    async def call() -> None:
        await test()

    asyncio.run(call())


def test_a_hundred_robots_in_one_process() -> None:
    async def talk() -> None:
        async with running(make_server(FAST)) as network:
            robots = [await network.connect(f"ROBOT:r{number}\nAHEAD:{number}\n".encode()) for number in range(2, 102)]
            answers = [(await reader.readline()).decode() for reader, _writer in robots]
            assert answers == [f"DRIVE:{number / 10:g},0\n" for number in range(2, 102)]
            assert len(network.server.robots) == 100
            for _reader, writer in robots:
                writer.close()
            await wait_until(lambda: not network.server.robots)

    run(talk)


def test_at_the_end_robots_get_their_stop_commands() -> None:
    async def talk() -> None:
        async with running(make_server(FAST)) as network:
            jxi_reader, _writer = await network.connect(b"AHEAD:5\n")
            json_reader, _writer = await network.connect(b'{"hello": {"pace": "client"}, "tick": 0}\n')
            assert await jxi_reader.readline() == b"DRIVE:0.5,0\n"
            await json_reader.readline()
            await json_reader.readline()
            await network.server.stop()
            assert await jxi_reader.read() == b"DRIVE:0,0\n"
            assert json.loads(await json_reader.read()) == {"commands": {"DRIVE": [0, 0]}}

    run(talk)


def test_clients_that_misbehave_do_not_disturb_a_robot() -> None:
    async def talk() -> None:
        async with running(make_server(FAST)) as network:
            reader, writer = await network.connect(b"ROBOT:good\nAHEAD:5\n")
            await reader.readline()
            silent = await network.connect()
            half = await network.connect(b"AHE")
            _reader, flood = await network.connect(b"ROBOT:flood\n")
            _reader, deaf = await network.connect(b'{"hello": {"pace": "client"}}\n')
            huge = await network.connect(b"A" * 1_000_000)
            failing = await network.connect(b"BEHAVIOR:failing\nAHEAD:1\n")
            good = next(robot for robot in network.server.robots if robot.name == "good")
            ticks = good.data.counts.ticks
            for number in range(20):
                flood.write(b"AHEAD:1\n" * 10_000)
                deaf.write(b'{"tick": %d}\n' % number * 500)
                writer.write(b"AHEAD:%d\n" % (number + 6))
                assert (await reader.readline()).startswith(b"DRIVE:")
            for _reader, other in (silent, half, huge, failing):
                other.transport.abort()
            await wait_until(lambda: good.data.counts.ticks > ticks + 20)
            assert good.data.counts.errors == good.data.counts.malformed == 0

    run(talk)


@pytest.mark.parametrize("token", ["secret", ""])
def test_silent_connections_lock_no_robot_out(token: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, "MAX_STRANGERS", 8)
    monkeypatch.setattr(server_module, "MAX_CONNECTIONS", 12)
    first = f"TOKEN:{token}\n" if token else ""

    async def talk() -> None:
        async with running(make_server(replace(FAST, token=token))) as network:
            early, _writer = await network.connect(f"{first}ROBOT:early\nAHEAD:5\n".encode())
            assert await early.readline() == b"DRIVE:0.5,0\n"
            silent = [await network.connect() for _number in range(30)]
            late, _writer = await network.connect(f"{first}ROBOT:late\nAHEAD:6\n".encode())
            assert await late.readline() == b"DRIVE:0.6,0\n"
            assert [robot.name for robot in network.server.robots] == ["early", "late"]
            assert b"too many connections" in await silent[0][0].readline()

    run(talk)


def test_robots_are_not_closed_for_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, "MAX_CONNECTIONS", 2)

    async def talk() -> None:
        async with running(make_server(FAST)) as network:
            for number in (5, 6):
                reader, _writer = await network.connect(f"ROBOT:r{number}\nAHEAD:{number}\n".encode())
                assert await reader.readline() == f"DRIVE:0.{number},0\n".encode()
            reader, _writer = await network.connect()
            assert b"too many connections" in await reader.readline()
            assert len(network.server.robots) == 2

    run(talk)


def test_tls(tmp_path: Path) -> None:
    certificate = make_certificate(tmp_path)
    if certificate is None:
        return  # nothing here can make a certificate

    async def talk() -> None:
        context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
        context.load_cert_chain(certificate)
        server = make_server(BridgeOptions(port=0, tick_ns=5_000_000, tls=context))
        async with running(server) as network:
            trusting = ssl.create_default_context(cafile=str(certificate))
            reader, writer = await network.connect(b"AHEAD:5\n", trusting)
            assert await reader.readline() == b"DRIVE:0.5,0\n"
            writer.transport.abort()
            with pytest.raises(ssl.SSLError):
                await network.connect(tls=ssl.create_default_context())

    run(talk)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (BridgeOptions(host="0.0.0.0", port=0), "other machines could connect to 0.0.0.0; add --token"),
        (BridgeOptions(host="robot.example", port=0), "other machines could connect to robot.example"),
        (BridgeOptions(host="::", port=0), "other machines could connect to ::"),
        (BridgeOptions(host="192.0.2.1", port=0, token="secret"), "cannot listen at 192.0.2.1:0"),
    ],
)
def test_addresses_that_are_refused(options: BridgeOptions, message: str) -> None:
    server = BridgeServer(DesignCatalog(classes={}), lambda: None, options)  # type: ignore[arg-type, return-value]
    with pytest.raises(ListenError, match=message):
        asyncio.run(server.start())


def test_a_world_that_cannot_be_created_refuses_the_robot() -> None:
    def fail() -> None:
        raise OSError("no calibration")

    async def talk() -> None:
        async with running(BridgeServer(make_server().catalog, fail, FAST)) as network:  # type: ignore[arg-type]
            reader, _writer = await network.connect(b"AHEAD:1\n")
            answer = (await reader.read()).decode()
            assert answer.startswith("ERROR: the world cannot be created: OSError: no calibration")

    run(talk)
