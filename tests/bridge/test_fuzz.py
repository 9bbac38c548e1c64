"""Random and mutated byte streams: nothing raises, memory stays flat, and another robot is undisturbed."""

import asyncio
import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random
from typing import Any

import pytest

from tests.bridge.byte_streams import make_stream, split_stream
from tests.bridge.sample_robots import TICK_NS, Client, commands, make_server
from vicode.bridge.connection import TURN_S
from vicode.bridge.server import BridgeOptions, BridgeServer

_WARM_UP = 2_000
_MORE_BLOCKS = 3_000
"""Blocks of memory that caches may take after the warm-up; a leak of one per stream takes more."""
LIMIT_S = 60.0


def test_ten_thousand_streams() -> None:
    asyncio.run(attack(range(10_000)))


@pytest.mark.nightly
@pytest.mark.timeout(3600)
def test_a_million_streams() -> None:
    asyncio.run(attack(range(1_000_000, 2_000_000)))


async def attack(seeds: range) -> None:
    """Send a stream of each seed from a new client to one server, where another robot keeps working."""
    with no_unhandled_exceptions():
        server = make_server(BridgeOptions(port=0, grace_s=0))
        good = Client(server)
        good.send(b"ROBOT:good\n")
        blocks = 0
        for number, seed in enumerate(seeds):
            await send_stream(server, Random(seed))
            if number % 20 == 0:
                good.send(f"ACK:{number // 20}\nAHEAD:{5 + number % 9}\n".encode())
                await server.tick_all(number * TICK_NS)
                assert commands(good.lines()) == [f"DRIVE:{(5 + number % 9) / 10:g},0"]
            if number == _WARM_UP:
                blocks = count_blocks()
        assert [robot.name for robot in server.robots] == ["good"]
        robot = server.robots[0]
        assert (robot.data.counts.errors, robot.data.counts.malformed) == (0, 0)
        assert robot.data.counts.sent == len(seeds) // 20
        assert count_blocks() - blocks < _MORE_BLOCKS


async def send_stream(server: BridgeServer, random: Random) -> None:
    client = Client(server, TURN_S)
    for piece in split_stream(make_stream(random), random):
        client.send(piece)
    await client.settle()
    if random.random() < 0.3:
        await server.tick_all(random.randrange(1_000) * TICK_NS)
    client.leave()


def test_streams_over_sockets() -> None:
    async def talk() -> None:
        server = make_server(BridgeOptions(port=0, tick_ns=5_000_000, grace_s=0))
        await server.start()
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        await reader.readline()
        writer.write(b"ROBOT:good\n")
        for number in range(10):
            for seed in range(number * 20, number * 20 + 20):
                random = Random(seed)
                _reader, other = await asyncio.open_connection("127.0.0.1", server.port)
                other.writelines(split_stream(make_stream(random), random))
                other.transport.abort() if seed % 2 else other.close()
            writer.write(f"AHEAD:{5 + number}\n".encode())
            assert await reader.readline() == f"DRIVE:{(5 + number) / 10:g},0\n".encode()
        writer.close()
        await server.stop()
        assert server.robots == []

    with no_unhandled_exceptions():
        asyncio.run(asyncio.wait_for(talk(), LIMIT_S))


@contextmanager
def no_unhandled_exceptions() -> Iterator[None]:
    """Fail if the event loop reports an exception, which it would only log."""
    reported: list[dict[str, Any]] = []
    before = asyncio.base_events.BaseEventLoop.call_exception_handler

    def note(_loop: object, context: dict[str, Any]) -> None:
        reported.append(context)

    asyncio.base_events.BaseEventLoop.call_exception_handler = note  # type: ignore[assignment, method-assign]
    try:
        yield
    finally:
        asyncio.base_events.BaseEventLoop.call_exception_handler = before  # type: ignore[method-assign]
    assert reported == []


def count_blocks() -> int:
    gc.collect()
    return sys.getallocatedblocks()
