"""The bridge: the age of the data that behaviors act on, and round trips against a bare asyncio echo.

Run it with `python -m benchmarks.bridge`. Servers run in processes of their own; all times are taken in this one, which
plays the robots, so that they contain the whole way.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import select
import socket
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator

from vicode.bica import Component
from vicode.bridge import Command, Sensor, World
from vicode.bridge.behaviors import DesignCatalog
from vicode.bridge.frames import decode_json, encode_json, encode_jxi
from vicode.bridge.server import BridgeOptions, BridgeServer

TICK_S = 0.05
TIMES_FASTER = 10
WINDOWS = 12
LASER = [round(0.1 * number, 2) for number in range(181)]
FLOOD_LINES = 200_000


class EchoWorld(World):
    """Two sensors and a command with the values that were acted on."""

    stamp = Sensor("STAMP", float)
    laser = Sensor("LASER", float, length=181)
    echo = Command("ECHO", "stamp", "least")


class Echo(Component):
    """Sends the stamp that it acts on, and the minimum of the laser."""

    world: EchoWorld

    def work(self) -> None:
        self.world.echo(self.world.stamp, min(self.world.laser))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="of the fast producer")
    parser.add_argument("--round-trip-seconds", type=float, default=5.0)
    parser.add_argument("--serve", choices=SERVERS, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.serve:
        asyncio.run(SERVERS[options.serve]())
        return
    print(f"A producer {TIMES_FASTER} times faster than the ticks ({1 / TICK_S:g} Hz): age of the data acted on, in s")
    for name in ("queue", "bridge"):
        with serving(name) as port:
            print_ages(name, measure_ages(port, options.seconds), options.seconds)
    print(f"Round trips of {len(make_message(0, 0))} bytes in lock step")
    for robots in (1, 100):
        for name in ("echo", "bridge"):
            with serving(name) as port:
                times = asyncio.run(measure_round_trips(name, port, robots, options.round_trip_seconds))
            print_round_trips(name, robots, times, options.round_trip_seconds)
    print(f"Flood of {FLOOD_LINES} short lines of one robot")
    for name in ("echo", "bridge"):
        with serving(name) as port:
            print(f"  {name:7}{measure_flood(port):12,.0f} lines/s")


# Servers


async def serve_bridge() -> None:
    options = BridgeOptions(port=0, tick_ns=round(TICK_S * 1e9))
    server = BridgeServer(DesignCatalog(classes={"echo": "benchmarks.bridge:Echo"}, default="echo"), EchoWorld, options)
    await server.start()
    print(server.port, flush=True)
    assert server.ticker is not None
    await server.ticker


async def serve_echo() -> None:
    """The least that an asyncio server does: it returns what it gets."""

    class EchoProtocol(asyncio.Protocol):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            assert isinstance(transport, asyncio.Transport)
            self.transport = transport

        def data_received(self, data: bytes) -> None:
            self.transport.write(data)

    server = await asyncio.get_running_loop().create_server(EchoProtocol, "127.0.0.1", 0)
    print(server.sockets[0].getsockname()[1], flush=True)
    await server.serve_forever()


async def serve_queue() -> None:
    """A program as that of the thesis: it handles one line in each step, in the order of their arrival."""

    async def handle(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while line := await reader.readline():
            if line.startswith(b"STAMP"):
                writer.write(b"ECHO:" + line.partition(b":")[2].strip() + b",0\n")
                await asyncio.sleep(TICK_S)

    server = await asyncio.start_server(handle, "127.0.0.1", 0)
    print(server.sockets[0].getsockname()[1], flush=True)
    await server.serve_forever()


SERVERS: dict[str, Callable[[], object]] = {"bridge": serve_bridge, "echo": serve_echo, "queue": serve_queue}


@contextlib.contextmanager
def serving(name: str) -> Iterator[int]:
    """Run a server in a process; yield its port."""
    command = [sys.executable, "-m", "benchmarks.bridge", "--serve", name]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield int(process.stdout.readline())
        finally:
            process.kill()


# Ages


def measure_ages(port: int, seconds: float) -> list[tuple[float, float]]:
    """Send stamps at the rate of the producer; return times and ages of those that come back."""
    ages: list[tuple[float, float]] = []
    begin_s = time.monotonic()
    with socket.create_connection(("127.0.0.1", port)) as connection:
        reader = threading.Thread(target=_read_stamps, args=(connection, begin_s, begin_s + seconds, ages))
        reader.start()
        period_s = TICK_S / TIMES_FASTER
        for number in range(round(seconds / period_s)):
            time.sleep(max(0.0, begin_s + number * period_s - time.monotonic()))
            if time.monotonic() - begin_s > seconds:
                # A server that hardly reads has held it up.
                break
            connection.sendall(encode_jxi("LASER", LASER) + encode_jxi("STAMP", [time.monotonic()]))
        reader.join()
    return ages


def _read_stamps(connection: socket.socket, begin_s: float, end_s: float, ages: list[tuple[float, float]]) -> None:
    rest = b""
    while time.monotonic() < end_s:
        if not select.select([connection], [], [], 0.1)[0]:
            continue
        *lines, rest = (rest + connection.recv(65_536)).split(b"\n")
        now_s = time.monotonic()
        stamps = [float(line[5:].split(b",")[0]) for line in lines if line.startswith(b"ECHO:")]
        ages += [(now_s - begin_s, now_s - stamp_s) for stamp_s in stamps if stamp_s]


def print_ages(name: str, ages: list[tuple[float, float]], seconds: float) -> None:
    windows = [
        max((age for at, age in ages if int(at / seconds * WINDOWS) == window), default=0.0)
        for window in range(WINDOWS)
    ]
    series = " ".join(f"{age:.3f}" if age < 1 else f"{age:.1f}" for age in windows)
    values = sorted(age for _at, age in ages)
    print(f"  {name:7}oldest in each {seconds / WINDOWS:g} s: {series}")
    most = values[-1]
    print(f"  {'':7}median {statistics.median(values):.4f}, at most {most:.4f} = {most / TICK_S:.2f} ticks")


# Round trips


async def measure_round_trips(name: str, port: int, robots: int, seconds: float) -> list[float]:
    """Times of all round trips of robots that wait for each answer."""
    loop = asyncio.get_running_loop()
    end_s = time.perf_counter() + seconds
    protocols = []
    for number in range(robots):
        _transport, protocol = await loop.create_connection(
            lambda number=number: _LockStepRobot(number, end_s, is_bridge=name == "bridge"), "127.0.0.1", port
        )
        protocols.append(protocol)
    await asyncio.gather(*(protocol.done for protocol in protocols))
    return [spent_s for protocol in protocols for spent_s in protocol.times]


class _LockStepRobot(asyncio.Protocol):
    def __init__(self, number: int, end_s: float, *, is_bridge: bool) -> None:
        self.number, self.end_s = number, end_s
        self.times: list[float] = []
        self.done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self.waiting = 2 if is_bridge else 0
        self.is_bridge = is_bridge
        self.text = b""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        self.transport = transport
        if self.is_bridge:
            transport.write(encode_json({"hello": {"pace": "client"}}))
        else:
            self.send()

    def data_received(self, data: bytes) -> None:
        self.text += data
        while b"\n" in self.text:
            line, _newline, self.text = self.text.partition(b"\n")
            if self.waiting:
                # The greeting and the welcome.
                self.waiting -= 1
                if not self.waiting:
                    self.send()
                continue
            now_s = time.perf_counter()
            self.times.append(now_s - self.sent_s)
            assert decode_json(line)["tick"] == len(self.times)
            if now_s < self.end_s:
                self.send()
            elif not self.done.done():
                self.done.set_result(None)
                self.transport.close()

    def send(self) -> None:
        self.sent_s = time.perf_counter()
        self.transport.write(make_message(self.number, len(self.times) + 1))


def make_message(number: int, tick: int) -> bytes:
    return encode_json({"STAMP": number + tick, "LASER": [1.25, 2.5, 3.75] * 60 + [1], "tick": tick})


def print_round_trips(name: str, robots: int, times: list[float], seconds: float) -> None:
    values = sorted(1e6 * spent_s for spent_s in times)
    middle, late = values[len(values) // 2], values[len(values) * 99 // 100]
    rate = len(values) / seconds
    print(f"  {name:7}{robots:4} robots: p50 {middle:8.0f} µs, p99 {late:8.0f} µs, {rate:9,.0f} lines/s")


# Flood


def measure_flood(port: int) -> float:
    """Lines per second of a robot that never waits; the last one is answered."""
    lines = b"STAMP:1\n" * (FLOOD_LINES // 100)
    with socket.create_connection(("127.0.0.1", port)) as connection:
        begin_s = time.perf_counter()
        reader = threading.Thread(target=_read_until, args=(connection, b"77777"))
        reader.start()
        for _part in range(100):
            connection.sendall(lines)
        connection.sendall(b"STAMP:77777\n")
        reader.join()
        spent_s = time.perf_counter() - begin_s
    return FLOOD_LINES / spent_s


def _read_until(connection: socket.socket, last: bytes) -> None:
    end = b""
    while last not in end:
        end = end[-20:] + connection.recv(65_536)


if __name__ == "__main__":
    main()
