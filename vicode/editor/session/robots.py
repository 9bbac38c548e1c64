"""Running robots that the editor is attached to: one connection for all windows, which is opened again when it ends."""

import asyncio
import contextlib
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from vicode.editor.session.subscribers import Subscribers
from vicode.robots import (
    AttachError,
    Hello,
    RobotAddress,
    RobotDescription,
    SocketTransport,
    connect,
    decode_hello,
    decode_line,
    encode,
    parse_address,
)
from vicode.simulation import IterationResult, ProtocolError
from vicode.simulation.messages import decode_iteration

if TYPE_CHECKING:
    from vicode.runs import Recording

_ANSWER_LIMIT_S = 5.0
_FIRST_RETRY_S, _MAX_RETRY_S = 0.5, 5.0
_LEAVE_DELAY_S = 2.0
_MAX_SEEDED = 600
_RATE_WINDOW = 60

Adapt = Callable[[IterationResult], IterationResult]
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


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenStep:
    """The latest step of a component, and when it arrived."""

    step: Mapping[str, Any]
    iteration: int
    received_s: float


@dataclass(eq=False, kw_only=True)
class WatchedRobot:
    """One robot of a server, and what was received of it."""

    description: RobotDescription
    iteration: IterationResult | None = None
    received_s: float = 0.0
    is_paused: bool = False
    error_count: int = 0
    missed: int = 0
    steps: dict[str, SeenStep] = field(default_factory=dict)
    """The latest step of each component."""
    held: dict[tuple[str, str], Any] = field(default_factory=dict)
    """Values that this editor holds, by component and name."""
    tuned: dict[str, Any] = field(default_factory=dict)
    """Constants that were tuned from here."""
    written: dict[tuple[str, str], tuple[str, str]] = field(default_factory=dict)
    """Values that were written into the files from here: the texts before and after, by component and name."""
    frequencies_hz: dict[str, float] = field(default_factory=dict)
    """Frequencies of components that were changed from here."""
    _recordings: dict[str, tuple["Recording", Adapt]] = field(default_factory=dict)
    _times: deque[tuple[int, int]] = field(default_factory=lambda: deque(maxlen=_RATE_WINDOW))

    @property
    def name(self) -> str:
        return self.description.name

    @property
    def root_state(self) -> str:
        return self.iteration.state if self.iteration else ""

    @property
    def iteration_hz(self) -> float:
        """Iterations per second in the time of the robot; 0 if unknown."""
        (first, first_ns), (last, last_ns) = (self._times[0], self._times[-1]) if self._times else ((0, 0), (0, 0))
        return (last - first) * 1e9 / (last_ns - first_ns) if last_ns > first_ns else 0.0

    @property
    def longest_recording(self) -> "Recording | None":
        """The recording of the most iterations; which component it is for does not matter for a replay."""
        return max((recording for recording, _adapt in self._recordings.values()), key=len, default=None)

    def recording(self, component: str, adapt: Adapt) -> "Recording":
        """The recording for the view of a component, which begins with what other views have recorded.

        Args:
            component: The component.
            adapt: Makes an iteration describe the component; the latest one given is used.
        """
        # An editor that is not attached starts without the simulation.
        from vicode.runs import Recording  # noqa: PLC0415

        known = self._recordings.get(component)
        recording = known[0] if known else Recording()
        self._recordings[component] = (recording, adapt)
        if known is None and len(self._recordings) > 1:
            source = next(iter(self._recordings.values()))[0]
            for number in range(max(1, len(source) - _MAX_SEEDED), len(source) + 1):
                iteration = source.iteration(number)
                if iteration is not None:
                    recording.add(adapt(iteration), {})
        return recording

    def add(self, message: Mapping[str, Any]) -> None:
        """Add a message with an iteration.

        Raises:
            ProtocolError: It is no iteration.
        """
        iteration = replace(decode_iteration(message), changes=list(message.get("changes", ())))
        before, self.iteration, self.received_s = self.iteration, iteration, time.monotonic()
        self.is_paused = message.get("paused") is True
        self.error_count = int(message.get("errors_total", 0))
        self.missed += int(message.get("missed", 0))
        if before is not None and iteration.iteration == before.iteration:
            return
        if before is not None and iteration.iteration < before.iteration:
            # The robot was started again.
            self._recordings.clear()
            self._times.clear()
            self.steps.clear()
            self.tuned.clear()
            self.written.clear()
            self.frequencies_hz.clear()
        self._times.append((iteration.iteration, iteration.time_ns))
        for step in iteration.tree:
            seen = SeenStep(step=step, iteration=iteration.iteration, received_s=self.received_s)
            self.steps[str(step["component"])] = seen
        for recording, adapt in self._recordings.values():
            recording.make_room()
            recording.add(adapt(iteration), {})

    def remember_written(self, key: tuple[str, str], before: str, after: str) -> None:
        """Remember that the robot has a value that was written into its file, which had another one."""
        known = self.written.get(key)
        first = known[0] if known is not None and known[1] == before else before
        self.written[key] = (first, after)

    def release_all(self) -> None:
        """Forget the held values: they ended with the connection. Constants of the robot stay as they are."""
        self.written = {key: texts for key, texts in self.written.items() if key not in self.held}
        self.held.clear()

    def frequency_hz(self, component: str) -> float | None:
        """The frequency of a component; None if it works in each iteration."""
        described = self.description.components.get(component)
        return self.frequencies_hz.get(component) or (described.frequency_hz if described else None)

    def is_active(self, component: str) -> bool:
        """Whether the component was stepped in the newest iteration."""
        seen = self.steps.get(component)
        return seen is not None and self.iteration is not None and seen.iteration == self.iteration.iteration


class RobotLink:
    """The connection of the editor to a server of robots, shared by its windows.

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
        self._breakpoints: dict[str, tuple[Place, ...]] = {}
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
        number = self._last_id
        self._answers[number] = answer = asyncio.get_running_loop().create_future()
        try:
            await self._transport.send(encode({"id": number, "robot": self.followed, "do": do, **fields}))
            return await asyncio.wait_for(answer, _ANSWER_LIMIT_S)
        except TimeoutError:
            raise RobotRequestError("the robot did not answer: it does not step, or its step takes long") from None
        except ConnectionError as error:
            raise RobotRequestError("the connection ended") from error
        finally:
            self._answers.pop(number, None)

    async def set_breakpoints(self, component: str, places: tuple[Place, ...]) -> None:
        """Replace the breakpoints of a component; those at states that the robot does not have are left out.

        Raises:
            RobotRequestError: It was not done.
        """
        if self._breakpoints.get(component, ()) != places:
            self._breakpoints[component] = places
            await self._send_breakpoints()

    async def _send_breakpoints(self) -> None:
        known = self.robot.description.components if self.robot else {}
        places = [
            [component, *place]
            for component, places in self._breakpoints.items()
            for place in places
            if component in known and {*place[:2]} <= {"", *known[component].states}
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
        if self.control and any(self._breakpoints.values()):
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
