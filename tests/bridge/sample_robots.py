"""Behaviors and a world for the tests of the bridge, and a client in this process without a network."""

import asyncio
import contextlib
import json
import math
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any

from vicode.bica import Component, Root, State
from vicode.bridge import Command, Event, Sensor, World
from vicode.bridge.behaviors import DesignCatalog
from vicode.bridge.connection import Connection
from vicode.bridge.server import BridgeOptions, BridgeServer

TICK_NS = 50_000_000


class SampleWorld(World):
    """Without a watchdog, as tests of a server take time on a slow machine."""

    max_age = None
    published = ("speed_wish",)
    range_ahead = Sensor("AHEAD", float, initial=9.0)
    pose = Sensor("INS", float, fields=("x", "y", "yaw"), range=(-1000, 1000))
    laser = Sensor("LASER", float, length=3)
    mode = Sensor("MODE", str)
    whistle = Event("WHISTLE")
    button = Event("BUTTON", int, initial=-1)
    drive = Command("DRIVE", "speed", "turn")
    lamp = Command("LAMP", "brightness", stop=None, rate=10)

    @property
    def speed_wish(self) -> float:
        return float(self.range_ahead) / 10


class WatchedWorld(SampleWorld):
    """The watchdog stops the robot; a test with this world must set the time itself."""

    max_age = World.max_age


class AgingWorld(SampleWorld):
    """Values become stale; a test with this world must set the time itself."""

    range_ahead = Sensor("AHEAD", float, max_age=0.5, initial=9.0)


class Follow(Component):
    """Drives faster if there is more room, and blinks after a whistle."""

    world: SampleWorld

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.whistles = 0
        self._set_states(State("Going", self._in_going), State("Near", self._in_near))

    def _in_going(self, decide: bool = True) -> None:
        self.whistles += bool(self.world.whistle)
        if decide and self.world.range_ahead < 1:
            self._change_to("Near")
            return
        self.world.drive(speed=self.world.speed_wish)

    def _in_near(self, decide: bool = True) -> None:
        if decide and self.world.range_ahead >= 1:
            self._change_to("Going")
            return
        self.world.drive(speed=0.0, turn=30.0)


class Failing(Component):
    """Raises in each tick, in one way or another."""

    world: SampleWorld

    def work(self) -> None:
        if self.world.range_ahead > 5:
            raise SystemExit
        raise RuntimeError("no idea")


class Crossing(Component):
    """Enters a state that has room for one robot."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._set_states(State("Waiting", self._in_waiting), State("Crossing", self._in_crossing, capacity=1))

    def _in_waiting(self, decide: bool = True) -> None:
        if decide:
            self._change_to("Crossing")

    def _in_crossing(self, decide: bool = True) -> None:
        self._stay() if decide else None


def make_catalog(default: str = "follow") -> DesignCatalog:
    names = {"follow": "Follow", "failing": "Failing", "crossing": "Crossing"}
    return DesignCatalog(classes={key: f"{__name__}:{name}" for key, name in names.items()}, default=default)


def make_server(
    options: BridgeOptions | None = None, default: str = "follow", world: type[World] = SampleWorld
) -> BridgeServer:
    return BridgeServer(make_catalog(default), world, options or BridgeOptions(port=0, tick_ns=TICK_NS))


class RecordingTransport(asyncio.Transport):
    """A transport that keeps what is written; `unsent` says how much of it waits."""

    def __init__(self) -> None:
        super().__init__()
        self.written = b""
        self.unsent = 0
        self.is_closed = self.is_paused = False

    def write(self, data: bytes) -> None:
        assert not self.is_closed
        self.written += data

    def get_extra_info(self, name: str, default: Any = None) -> Any:
        return ("192.0.2.1", 4711) if name == "peername" else default

    def get_write_buffer_size(self) -> int:
        return self.unsent

    def is_closing(self) -> bool:
        return self.is_closed

    def close(self) -> None:
        self.is_closed = True

    def abort(self) -> None:
        self.is_closed = True

    def pause_reading(self) -> None:
        self.is_paused = True

    def resume_reading(self) -> None:
        self.is_paused = False


class Client:
    """A client whose bytes go to the connection directly; use it inside a running event loop.

    Its lines are handled at once, or in turns of some seconds.
    """

    def __init__(self, server: BridgeServer, turn_s: float = math.inf) -> None:
        self.transport = RecordingTransport()
        self.connection = Connection(server)
        self.connection.turn_s = turn_s
        self.connection.connection_made(self.transport)

    def send(self, data: bytes | dict[str, Any]) -> None:
        """Send bytes, or a JSON line, in pieces that fit the buffer."""
        rest = json.dumps(data).encode() + b"\n" if isinstance(data, dict) else data
        while rest and not self.transport.is_closed:
            buffer = self.connection.get_buffer(-1)
            size = min(len(buffer), len(rest))
            buffer[:size] = rest[:size]
            self.connection.buffer_updated(size)
            rest = rest[size:]

    async def settle(self) -> None:
        """Wait until all lines are handled: many of them are handled in turns."""
        while self.connection.is_working:
            await asyncio.sleep(0)

    def lines(self) -> list[str]:
        """The lines that were written since the last call."""
        written, self.transport.written = self.transport.written, b""
        return written.decode().splitlines()

    def answers(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.lines() if line.startswith("{")]

    def leave(self) -> None:
        self.transport.is_closed = True
        self.connection.connection_lost(None)


def commands(lines: Sequence[str]) -> list[str]:
    return [line for line in lines if not line.startswith(("ERROR", "Robot"))]


def in_event_loop(test: Callable[[], object]) -> Callable[[], None]:
    """Run a test inside an event loop, which connections need to give way and to close."""

    @wraps(test)
    def run() -> None:
        async def call() -> None:
            test()

        asyncio.run(call())

    return run


def tick(server: BridgeServer, number: int = 1) -> None:
    """Tick all robots as the clock does; where it gives way to connections, which a slow machine makes it do, go on."""
    ticking = server.tick_all(number * TICK_NS)
    with contextlib.suppress(StopIteration):
        while True:
            ticking.send(None)
