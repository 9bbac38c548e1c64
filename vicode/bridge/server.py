"""The server: accepts robots, runs their behaviors at each tick, keeps their state for a while after they left."""

import asyncio
import ipaddress
import re
import ssl
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from vicode.bica.errors import USER_ERRORS
from vicode.bica.loader import describe_user_error
from vicode.bridge.ages import AgeFigures, merge_ages
from vicode.bridge.behaviors import BehaviorCatalog
from vicode.bridge.connection import Connection
from vicode.bridge.dialects import JoinRequest, RefusedError
from vicode.bridge.flow_control import DEFAULT_COMMAND_RATE_HZ
from vicode.bridge.robot import Robot, TeamKey, TeamRound
from vicode.bridge.world import Counts, World

DEFAULT_PORT = 7001
DEFAULT_TICK_MS = 50.0
MAX_CONNECTIONS = 1000
MAX_STRANGERS = 64
"""So many connections may owe the token; the oldest of more is closed, so that they lock no robot out."""
_HANDSHAKE_S = 5.0
_STOP_S = 2.0
_TURN_S = 0.005
"""So long robots are stepped before connections get their turn."""
_SILENT_TICKS = 2
"""A robot whose messages tick is ticked by the clock if none came for so many ticks."""
_SILENCE = TeamRound()
_ROBOT_NAME = re.compile(r"[\w.-]{1,64}")


class ListenError(Exception):
    """The server must not or cannot listen at an address; the text is one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeOptions:
    """How a server runs.

    Attributes:
        token: What clients must send first, if not empty.
        grace_s: How long the state of a robot that left is kept.
        tls: Certificate and key, None for plain TCP.
        command_rate_hz: How often a robot that acknowledges no commands gets some.
    """

    host: str = "127.0.0.1"
    port: int = DEFAULT_PORT
    tick_ns: int = round(DEFAULT_TICK_MS * 1e6)
    token: str = ""
    grace_s: float = 10.0
    tls: ssl.SSLContext | None = None
    command_rate_hz: float = DEFAULT_COMMAND_RATE_HZ


@dataclass(slots=True)
class _Seat:
    """A robot with its connection, or with the time when it left."""

    robot: Robot
    connection: Connection | None
    is_named: bool
    left_s: float = 0.0


@dataclass(slots=True)
class TickCounts:
    """Ticks of the server's clock: those that ran, and those that were skipped because others took too long."""

    run: int = 0
    skipped: int = 0


@dataclass(slots=True)
class BridgeServer:
    """A server for one catalog of behaviors.

    Args:
        catalog: The behaviors that robots can choose.
        make_world: Creates the world of a robot.
        options: Address, token, tick.
        on_start: Called when a robot starts a behavior.
        on_event: Called with the name of a robot and what happened, in one line.
    """

    catalog: BehaviorCatalog
    make_world: Callable[[], World]
    options: BridgeOptions = BridgeOptions()
    on_start: Callable[[Robot], None] = lambda _robot: None
    on_event: Callable[[str, str], None] = lambda _robot, _line: None
    counts: Counts = field(default_factory=Counts)
    """Counts of connections without a robot, and of robots that are gone."""
    ticks: TickCounts = field(default_factory=TickCounts)
    address: str = ""
    ticker: asyncio.Task[None] | None = None
    """Runs until `stop`; it ends earlier only with an exception."""
    _seats: dict[str, _Seat] = field(default_factory=dict)
    _connections: dict[Connection, None] = field(default_factory=dict)
    """The oldest first."""
    _ages: AgeFigures = field(default_factory=AgeFigures)
    _command_ages: AgeFigures = field(default_factory=AgeFigures)
    _joined: int = 0
    _listener: asyncio.Server | None = None
    _is_stopping: bool = False

    async def start(self) -> None:
        """Listen and tick.

        Raises:
            ListenError: The address is in use or invalid, or other machines could connect without a token.
        """
        options = self.options
        if not options.token and not _is_local(options.host):
            raise ListenError(f"other machines could connect to {options.host}; add --token, or use 127.0.0.1")
        loop = asyncio.get_running_loop()
        try:
            self._listener = await loop.create_server(
                lambda: Connection(self),
                options.host,
                options.port,
                ssl=options.tls,
                ssl_handshake_timeout=_HANDSHAKE_S if options.tls else None,
                backlog=512,
            )
        except OSError as error:
            raise ListenError(f"cannot listen at {options.host}:{options.port}: {error.strerror or error}") from error
        name = self._listener.sockets[0].getsockname()
        self.address = f"{name[0]}:{name[1]}"
        self.ticker = loop.create_task(self._run_ticks())

    @property
    def port(self) -> int:
        return int(self.address.rpartition(":")[2])

    @property
    def robots(self) -> list[Robot]:
        """The robots that are connected."""
        return [seat.robot for seat in self._seats.values() if seat.connection is not None]

    @property
    def all_robots(self) -> list[Robot]:
        """The robots that are connected, and those whose state is kept."""
        return [seat.robot for seat in self._seats.values()]

    def total(self) -> Counts:
        """Counts of all robots since the start."""
        return sum((seat.robot.data.counts for seat in self._seats.values()), self.counts)

    def collect_ages(self) -> AgeFigures:
        """The age of the data that behaviors read, for all robots since the start."""
        return merge_ages((self._ages, *(seat.robot.ages for seat in self._seats.values())))

    def collect_command_ages(self) -> AgeFigures:
        """The age of the commands that robots have acknowledged, of all robots since the start."""
        return merge_ages((self._command_ages, *(seat.robot.command_ages for seat in self._seats.values())))

    async def stop(self) -> None:
        """Stop all robots, close all connections, behaviors and worlds."""
        self._is_stopping = True
        if self.ticker is not None:
            self.ticker.cancel()
            await asyncio.wait([self.ticker])
        if self._listener is not None:
            self._listener.close()
        for connection in [*self._connections]:
            connection.stop()
        end_s = time.monotonic() + _STOP_S
        while self._connections and time.monotonic() < end_s:
            await asyncio.sleep(0.01)
        for seat in [*self._seats.values()]:
            self._drop(seat)

    # Called by connections

    def add(self, connection: Connection) -> bool:
        """Register a connection and return whether there is room; the oldest one that sent nothing may have to go."""
        strangers = [each for each in self._connections if not each.is_admitted]
        silent = strangers if len(strangers) >= MAX_STRANGERS else []
        if not silent and len(self._connections) >= MAX_CONNECTIONS:
            silent = strangers or [each for each in self._connections if each.robot is None]
            if not silent:
                return False
        self._connections[connection] = None
        if silent:
            silent[0].refuse("too many connections that send nothing")
            self._connections.pop(silent[0], None)
        return True

    def remove(self, connection: Connection) -> None:
        """A connection has ended: keep the state of a named robot for the grace time."""
        self._connections.pop(connection, None)
        robot = connection.robot
        seat = self._seats.get(robot.name) if robot is not None else None
        if seat is None or seat.connection is not connection:
            return
        seat.connection, seat.left_s = None, time.monotonic()
        seat.robot.leave_team()
        seat.robot.data.flow = None
        is_kept = seat.is_named and connection.pace == "clock" and self.options.grace_s > 0 and not self._is_stopping
        if not is_kept:
            self.on_event(seat.robot.name, "disconnected")
            self._drop(seat)
        else:
            self.on_event(seat.robot.name, f"disconnected; its state is kept for {self.options.grace_s:g} s")

    def join(self, hello: JoinRequest, connection: Connection) -> Robot:
        """Return the robot of this name: that which was here before, or a new one.

        Raises:
            RefusedError: The name is invalid, or there are too many robots.
        """
        name = hello.name
        if name and _ROBOT_NAME.fullmatch(name) is None:
            raise RefusedError("the name of a robot has up to 64 letters, digits, dots and dashes")
        seat = self._seats.get(name)
        if seat is None:
            return self._join_new(hello, connection)
        before, seat.connection = seat.connection, connection
        if before is not None:
            before.refuse(f"robot {name} has connected again from {connection.peer}")
        if "client" in (hello.pace, before.pace if before is not None else "clock"):
            # The times of another run are not those of this one.
            self._drop(seat)
            return self._join_new(hello, connection)
        self.on_event(name, f"connected again from {connection.peer}")
        seat.robot.data.connect_again()
        seat.robot.data.counts.connections += 1
        return seat.robot

    def _join_new(self, hello: JoinRequest, connection: Connection) -> Robot:
        if len(self._seats) >= MAX_CONNECTIONS:
            oldest = min((each for each in self._seats.values() if each.connection is None), key=_left, default=None)
            if oldest is None:
                raise RefusedError("too many robots")
            self._drop(oldest)
        self._joined += 1
        free = (f"robot{number}" for number in range(self._joined, self._joined + MAX_CONNECTIONS + 1))
        unique = hello.name or next(each for each in free if each not in self._seats)
        priority = -self._joined if hello.priority is None else hello.priority
        try:
            robot = Robot(
                unique,
                self.make_world,
                self.catalog,
                team=hello.team,
                priority=priority,
                waits=hello.waits and hello.pace != "client",
            )
        except USER_ERRORS as error:
            raise RefusedError(f"the world cannot be created: {describe_user_error(error)}") from error
        robot.data.counts.connections = 1
        self._seats[unique] = _Seat(robot, connection, is_named=bool(hello.name))
        self.on_event(unique, f"connected from {connection.peer}")
        return robot

    def start_behavior(self, robot: Robot, name: str) -> None:
        """Start a behavior of a robot.

        Raises:
            BehaviorError: There is no such behavior, or its code fails.
        """
        robot.select(name)
        awaited = robot.awaited
        starts = f" when {'a value' if awaited == ['any'] else ', '.join(awaited)} has arrived" if awaited else ""
        self.on_event(robot.name, f"runs {name}{starts}")
        self.on_start(robot)

    def tick(self, robot: Robot, *, at_ns: int, now_ns: int) -> None:
        """Run one tick of a robot, with its team."""
        robot.tick(at_ns, now_ns, self._hear(at_ns).get(robot.team_key, _SILENCE))
        for line in robot.reports:
            self.on_event(robot.name, line)

    # Ticks of the clock

    async def _run_ticks(self) -> None:
        """Tick at multiples of the tick; those that pass during a long one are skipped."""
        tick_s, start_s, number = self.options.tick_ns / 1e9, time.monotonic(), 0
        while True:
            late = int((time.monotonic() - start_s) / tick_s) - number
            self.ticks.skipped += max(0, late)
            number += 1 + max(0, late)
            await asyncio.sleep(max(0.0, start_s + number * tick_s - time.monotonic()))
            await self.tick_all(round((start_s + number * tick_s) * 1e9))
            self._end_grace_times()

    async def tick_all(self, at_ns: int) -> None:
        """Run one tick of the robots whose clock is that of the server, or that are silent."""
        self.ticks.run += 1
        teams, turn_s = self._hear(at_ns), time.monotonic() + _TURN_S
        for seat in [*self._seats.values()]:
            connection = seat.connection
            if connection is None or connection.pace == "client" or seat.robot.behavior is None:
                continue
            now_ns = time.monotonic_ns()
            if connection.pace == "message" and now_ns - seat.robot.ticked_ns < _SILENT_TICKS * self.options.tick_ns:
                continue
            self._tick_if_ready(seat.robot, connection, teams, (at_ns, now_ns))
            connection.flush()
            if time.monotonic() > turn_s:
                await asyncio.sleep(0)
                turn_s = time.monotonic() + _TURN_S

    def tick_by_message(self, connection: Connection) -> None:
        """Run one tick of a robot from which values have arrived, if that is its pace."""
        robot, now_ns = connection.robot, time.monotonic_ns()
        if robot is not None and robot.behavior is not None:
            self._tick_if_ready(robot, connection, self._hear(now_ns), (now_ns, now_ns))

    def _tick_if_ready(
        self, robot: Robot, connection: Connection, teams: Mapping[TeamKey, TeamRound], times_ns: tuple[int, int]
    ) -> None:
        at_ns, now_ns = times_ns
        if not robot.wait(at_ns):
            robot.tick(at_ns, now_ns, teams.get(robot.team_key, _SILENCE))
        for line in robot.take_reports():
            self.on_event(robot.name, line)
            connection.complain(line)
        for line in robot.data.take_notices():
            self.on_event(robot.name, line)
            connection.notify(line)

    def _hear(self, at_ns: int) -> dict[TeamKey, TeamRound]:
        """What the robots of each team hear in their ticks at this time."""
        teams: dict[TeamKey, list[Robot]] = {}
        for seat in self._seats.values():
            if seat.robot.speaks:
                teams.setdefault(seat.robot.team_key, []).append(seat.robot)
        return {key: TeamRound(robots, at_ns) for key, robots in teams.items()}

    def _end_grace_times(self) -> None:
        now_s = time.monotonic()
        for seat in [*self._seats.values()]:
            if seat.connection is None and now_s - seat.left_s > self.options.grace_s:
                self._drop(seat)
        for connection in [*self._connections]:
            if not connection.is_admitted and now_s - connection.connected_s > _HANDSHAKE_S:
                connection.refuse("no token was sent")

    def _drop(self, seat: _Seat) -> None:
        """Forget a robot."""
        if self._seats.get(seat.robot.name) is seat:
            del self._seats[seat.robot.name]
        seat.robot.close()
        self.counts += seat.robot.data.counts
        self._ages.merge(seat.robot.ages)
        self._command_ages.merge(seat.robot.command_ages)


def _left(seat: _Seat) -> float:
    return seat.left_s


def _is_local(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
