"""Runs a simulated world whose robots are driven by behaviors behind a bridge, in lock step or in real time."""

import asyncio
import ssl
from collections.abc import Callable, Sequence
from contextlib import AsyncExitStack
from dataclasses import dataclass, field
from functools import partial
from itertools import count, pairwise

from vicode.simulated_robot.arena import Arena, SimulatedRobot
from vicode.simulated_robot.client import Answer, BridgeError, HelloMessage, RobotConnection
from vicode.simulated_robot.faults import NO_FAULT, Fault, FaultySender, Sensors
from vicode.simulated_robot.robot_model import RobotModel
from vicode.simulated_robot.world_map import Point

TICK_S = 0.05
"""The pace of the robots: 20 Hz."""

_KEPT_ERRORS = 10


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeAddress:
    """Where the bridge listens, and how robots talk to it; `name` is followed by the number of the robot."""

    host: str = "127.0.0.1"
    port: int = 7001
    behavior: str = ""
    token: str = ""
    is_jxi: bool = False
    name: str = "robot"
    team: str = ""
    tls: ssl.SSLContext | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackPoint:
    """What one robot did at one tick; `state` is that of the root, `active` are all."""

    time_s: float
    at: Point
    yaw: float
    active: tuple[tuple[str, str], ...] = ()
    age_ms: float | None = None
    command_age_ms: float | None = None

    @property
    def state(self) -> str:
        return self.active[0][1] if self.active else ""


@dataclass(slots=True, eq=False)
class RobotTrack:
    """A robot with everything it did."""

    robot: SimulatedRobot
    points: list[TrackPoint] = field(default_factory=list)
    active: tuple[tuple[str, str], ...] = ()
    age_ms: float | None = None
    command_age_ms: float | None = None
    ranges: Sequence[float] = ()
    errors: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)

    @property
    def state(self) -> str:
        return self.active[0][1] if self.active else ""

    @property
    def state_changes(self) -> int:
        states = [point.state for point in self.points]
        return sum(before != after for before, after in pairwise(states))

    def take(self, answer: Answer, model: RobotModel) -> None:
        """Follow an answer of the bridge."""
        model.obey(self.robot, answer.commands)
        if answer.active is not None and answer.active != self.active:
            # Equal states share one tuple, of which the points of a long run keep many.
            self.active = answer.active
        self.errors += answer.errors[: _KEPT_ERRORS - len(self.errors)]
        self.notices += answer.notices[: _KEPT_ERRORS - len(self.notices)]
        self.age_ms = answer.age_ms if answer.age_ms is not None else self.age_ms
        if answer.command_age_ms is not None:
            self.command_age_ms = answer.command_age_ms


class SimulationSession:
    """One world and the connections of its robots.

    Attributes:
        arena: The world.
        tracks: What each robot did.
    """

    def __init__(
        self, arena: Arena, address: BridgeAddress, *, model: RobotModel | None = None, is_recorded: bool = True
    ) -> None:
        """Prepare a session with what the robots send and obey; only if it `is_recorded`, the tracks have points."""
        self.arena = arena
        self._model = model or RobotModel()
        self._is_recorded = is_recorded
        self.tracks = tuple(RobotTrack(robot) for robot in arena.robots)
        self._address = address
        self._links: tuple[RobotConnection, ...] = ()

    async def run_lock_step(
        self, seconds: float, *, is_over: Callable[[], bool] = lambda: False, on_tick: Callable[[], None] = lambda: None
    ) -> None:
        """Simulate as fast as the bridge answers, until the time is over or `is_over`.

        Raises:
            BridgeError: The bridge refused or closed a connection.
        """
        async with AsyncExitStack() as stack:
            await self._connect(stack, is_lock_step=True)
            for tick in count(1):
                self.arena.advance(TICK_S)
                now = round(tick * TICK_S, 6)
                for track, link in zip(self.tracks, self._links, strict=True):
                    link.send_tick(self._sense(track), time_s=now)
                for track, link in zip(self.tracks, self._links, strict=True):
                    track.take(await link.read(), self._model)
                    self._record(track)
                on_tick()
                if is_over() or now >= seconds:
                    return

    async def run_real_time(
        self,
        seconds: float,
        *,
        is_over: Callable[[], bool] = lambda: False,
        on_tick: Callable[[], None] = lambda: None,
        period_s: float = TICK_S,
        fault: Fault = NO_FAULT,
    ) -> None:
        """Simulate in real time; messages that the bridge does not take in time are not sent.

        Raises:
            BridgeError: The bridge refused or closed a connection.
        """
        async with AsyncExitStack() as stack:
            await self._connect(stack, is_lock_step=False)
            group = await stack.enter_async_context(_ReaderGroup())
            for track, link in zip(self.tracks, self._links, strict=True):
                group.follow(link, partial(track.take, model=self._model), fault.read_pause_s)
            senders = [FaultySender(fault, track.robot.number) for track in self.tracks]
            loop = asyncio.get_running_loop()
            start = due = loop.time()
            while True:
                # A late tick is not repeated: its time is simulated with the next one.
                due = max(due + period_s, loop.time())
                await asyncio.sleep(due - loop.time())
                self.arena.advance(max(0.0, due - start - self.arena.now_s))
                for track, link, sender in zip(self.tracks, self._links, senders, strict=True):
                    sender.put(self.arena.now_s, self._sense(track))
                    for measured_s, sensors in sender.take(self.arena.now_s):
                        link.send(sensors, time_s=round(measured_s, 6))
                    self._record(track)
                    await link.drain()
                on_tick()
                if is_over() or self.arena.now_s >= seconds or group.is_closed:
                    return

    async def _connect(self, stack: AsyncExitStack, *, is_lock_step: bool) -> None:
        address, links = self._address, []
        for track in self.tracks:
            hello = HelloMessage(
                robot=f"{address.name}{track.robot.number}",
                behavior=address.behavior,
                token=address.token,
                team=address.team,
                is_lock_step=is_lock_step,
                priority=len(self.tracks) - track.robot.number,
            )
            link = await RobotConnection.connect(
                address.host, address.port, hello, is_jxi=address.is_jxi, tls=address.tls
            )
            stack.push_async_callback(link.close)
            links.append(link)
        self._links = tuple(links)

    def _record(self, track: RobotTrack) -> None:
        if self._is_recorded:
            time_s, robot = round(self.arena.now_s, 6), track.robot
            track.points.append(
                TrackPoint(
                    time_s=time_s,
                    at=robot.at,
                    yaw=robot.yaw,
                    active=track.active,
                    age_ms=track.age_ms,
                    command_age_ms=track.command_age_ms,
                )
            )

    def _sense(self, track: RobotTrack) -> Sensors:
        sensors = self._model.sense(self.arena, track.robot)
        track.ranges = sensors.get("LASER", ())
        return sensors


class _ReaderGroup:
    """Tasks that read what the bridge sends; they end with the group."""

    def __init__(self) -> None:
        self._tasks: list[asyncio.Task[None]] = []

    @property
    def is_closed(self) -> bool:
        """Whether a connection has ended."""
        return any(task.done() for task in self._tasks)

    def follow(self, link: RobotConnection, take: Callable[[Answer], None], pause_s: float) -> None:
        self._tasks.append(asyncio.create_task(_follow(link, take, pause_s)))

    async def __aenter__(self) -> "_ReaderGroup":
        return self

    async def __aexit__(self, *_exception: object) -> None:
        for task in self._tasks:
            task.cancel()
        for result in await asyncio.gather(*self._tasks, return_exceptions=True):
            if isinstance(result, Exception):
                raise result


async def _follow(link: RobotConnection, take: Callable[[Answer], None], pause_s: float) -> None:
    async for answer in link.answers():
        take(answer)
        if pause_s:
            await asyncio.sleep(pause_s)
    raise BridgeError("the bridge closed the connection")
