"""The connection to a server of running robots, which is opened again when it ends."""

import asyncio
import contextlib
from collections.abc import Mapping
from enum import StrEnum
from typing import Any

from vicode.robots import (
    AttachError,
    Hello,
    RobotAddress,
    SocketTransport,
    connect,
    decode_hello,
    decode_line,
    encode,
    parse_address,
)
from vicode.services.running_robots.watched_robot import WatchedRobot
from vicode.simulation import ProtocolError
from vicode.subscribers import Subscribers

NO_CONTROL = "The robot may only be watched. To control it, start it with --control or VICODE_WATCH_CONTROL=1."
ANY_ERROR = ""
"""In place of a component: the breakpoint at errors of any component, whose only place is ERROR_PLACE."""
ERROR_PLACE = ("error",)
_ANSWER_LIMIT_S = 5.0
_FIRST_RETRY_S, _MAX_RETRY_S = 0.5, 5.0
_LEAVE_DELAY_S = 2.0

Place = tuple[str | None, ...]
"""A breakpoint: a state, or source, target and id of a transition."""


class LinkStatus(StrEnum):
    """The status of the connection."""

    CLOSED = "closed"
    CONNECTING = "connecting"
    CONNECTED = "connected"
    LOST = "lost"
    REFUSED = "refused"


class RobotRequestError(Exception):
    """A robot did not do what was asked; the message says why."""


class RobotLink:
    """The connection of a console, or of the editor and all its windows, to a server of robots.

    It is opened again after it was lost, until it is closed or the server refuses it.
    """

    def __init__(self) -> None:
        self.address, self.token = "", ""
        self.status = LinkStatus.CLOSED
        self.problem = ""
        """Why there is no connection."""
        self.control = False
        self.robots: dict[str, WatchedRobot] = {}
        self.followed = ""
        """The name of the robot that the windows show."""
        self.changes: Subscribers[[]] = Subscribers()
        """Called after each message and each change of the status."""
        self.messages: Subscribers[[Mapping[str, Any]]] = Subscribers()
        """Called with each iteration of a robot, as it was received."""
        self._breakpoints: dict[str, dict[str, tuple[Place, ...]]] = {}
        """The breakpoints of each component by robot."""
        self._transport: SocketTransport | None = None
        self._task: asyncio.Task[None] | None = None
        self._answers: dict[int, asyncio.Future[str]] = {}
        self._last_id = 0

    @property
    def is_open(self) -> bool:
        """Whether the editor is, or wants to be, attached."""
        return self.status is not LinkStatus.CLOSED

    @property
    def robot(self) -> WatchedRobot | None:
        """The robot that is shown."""
        return self.robots.get(self.followed)

    @property
    def breakpoints(self) -> Mapping[str, tuple[Place, ...]]:
        """The breakpoints of the followed robot by component."""
        return self._breakpoints.get(self.followed, {})

    def open(self, address: str, token: str) -> None:
        """Attach to another address; `start` connects.

        Raises:
            AttachError: It is no address.
        """
        parsed = parse_address(address)
        self.close()
        self.address, self.token = str(parsed), token
        self.status, self.problem = LinkStatus.CONNECTING, ""
        self.changes.notify()

    def start(self) -> None:
        """Connect in the running event loop, unless that is under way."""
        if self.is_open and self._task is None:
            self._task = asyncio.get_running_loop().create_task(self._run(parse_address(self.address)), name="robots")

    def close(self) -> None:
        """Disconnect; robots continue."""
        if self._task is not None:
            self._task.cancel()
            self._task = None
        self._end_connection()
        self.robots, self.followed, self.control = {}, "", False
        self.status, self.problem = LinkStatus.CLOSED, ""
        self.changes.notify()

    def leave(self) -> None:
        """Disconnect soon if no window is left, so that nothing stays paused or held; a new window connects again."""

        def disconnect() -> None:
            if not self.changes and self._task is not None:
                self._task.cancel()
                self._task = None
                self._end_connection()
                self.status = LinkStatus.CONNECTING

        # A window that shows another design leaves and comes back.
        with contextlib.suppress(RuntimeError):
            asyncio.get_running_loop().call_later(_LEAVE_DELAY_S, disconnect)

    def follow(self, robot: str) -> None:
        if robot in self.robots and robot != self.followed:
            self.followed = robot
            self.robots[robot].missed = 0
            self._send_focus()
            self.changes.notify()

    async def request(self, do: str, **fields: Any) -> str:
        """Ask the shown robot for something; returns what was done.

        Raises:
            RobotRequestError: It was not done.
        """
        if self._transport is None:
            raise RobotRequestError("not connected to a robot")
        self._last_id += 1
        number, robot = self._last_id, self.robot
        self._answers[number] = answer = asyncio.get_running_loop().create_future()
        try:
            await self._transport.send(encode({"id": number, "robot": self.followed, "do": do, **fields}))
            done: str = await asyncio.wait_for(answer, _ANSWER_LIMIT_S)
        except TimeoutError:
            raise RobotRequestError("the robot did not answer: it does not step, or its step takes long") from None
        except ConnectionError as error:
            raise RobotRequestError("the connection ended") from error
        finally:
            self._answers.pop(number, None)
        if robot is not None:
            robot.note_request(do, fields)
        return done

    async def set_breakpoints(self, component: str, places: tuple[Place, ...]) -> None:
        """Replace the breakpoints of a component; those at states that the robot does not have are left out.

        Raises:
            RobotRequestError: It was not done.
        """
        if self.breakpoints.get(component, ()) != places:
            self._breakpoints.setdefault(self.followed, {})[component] = places
            await self._send_breakpoints()

    async def _send_breakpoints(self) -> None:
        known = self.robot.description.components if self.robot else {}
        places = [
            [component, *place]
            for component, places in self.breakpoints.items()
            for place in places
            if component == ANY_ERROR or (component in known and {*place[:2]} <= {"", *known[component].states})
        ]
        await self.request("break", places=places)

    async def _run(self, address: RobotAddress) -> None:
        wait_s, was_connected = _FIRST_RETRY_S, False
        while True:
            try:
                self._transport, hello = await connect(address, self.token)
                was_connected, wait_s = True, _FIRST_RETRY_S
                await self._follow_server(self._transport, hello)
                problem = "the robot closed the connection"
            except AttachError as error:
                problem = str(error)
                if error.is_final and not was_connected:
                    self._set_status(LinkStatus.REFUSED, problem)
                    return
            finally:
                self._end_connection()
            self._set_status(LinkStatus.LOST, problem)
            await asyncio.sleep(wait_s)
            wait_s = min(_MAX_RETRY_S, wait_s * 2)

    async def _follow_server(self, transport: SocketTransport, hello: Hello) -> None:
        self._greet(hello)
        for robot in self.robots.values():
            robot.release_all()
        self._set_status(LinkStatus.CONNECTED)
        restoring = asyncio.create_task(self._restore_breakpoints())
        try:
            # A line that is too long, or no JSON, ends the connection.
            with contextlib.suppress(ValueError):
                while line := await transport.receive():
                    self._take(decode_line(line))
        finally:
            restoring.cancel()

    async def _restore_breakpoints(self) -> None:
        # Those of other robots have ended with the connection.
        self._breakpoints = {self.followed: dict(self.breakpoints)}
        if self.control and any(self.breakpoints.values()):
            with contextlib.suppress(RobotRequestError):
                await self._send_breakpoints()

    def _greet(self, hello: Hello) -> None:
        self.control = hello.control
        if not hello.robots:
            # The program ends: what was received stays visible.
            return
        known, self.robots = self.robots, {}
        for description in hello.robots:
            robot = known.get(description.name) or WatchedRobot(description=description)
            robot.description = description
            self.robots[description.name] = robot
        if self.followed not in self.robots:
            self.followed = next(iter(self.robots), "")
        self._send_focus()

    def _send_focus(self) -> None:
        """Ask for each iteration of the shown robot; the others are sent less often."""
        if self._transport is not None:
            self._transport.send_soon(encode({"focus": self.followed}))

    def _take(self, message: Mapping[str, Any]) -> None:
        if "answer" in message:
            self._take_answer(message)
            return
        if "vicode-live" in message:
            self._greet(decode_hello(message))
        elif "tree" in message:
            robot = self.robots.get(str(message.get("robot")))
            with contextlib.suppress(ProtocolError, TypeError):
                if robot is not None:
                    robot.add(message)
                    self.messages.notify(message)
        self.changes.notify()

    def _take_answer(self, message: Mapping[str, Any]) -> None:
        number = message["answer"]
        waiting = self._answers.get(number) if isinstance(number, int) else None
        if waiting is None or waiting.done():
            return
        if "error" in message:
            waiting.set_exception(RobotRequestError(str(message["error"])))
        else:
            waiting.set_result(str(message.get("done", "")))

    def _end_connection(self) -> None:
        if self._transport is not None:
            self._transport.close()
            self._transport = None
        for waiting in self._answers.values():
            if not waiting.done():
                waiting.set_exception(RobotRequestError("the connection ended"))

    def _set_status(self, status: LinkStatus, problem: str = "") -> None:
        self.status, self.problem = status, problem
        self.changes.notify()
