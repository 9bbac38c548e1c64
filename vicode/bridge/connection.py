"""A connection of the server: bytes of one client to its robot, and commands back. Never waits, never buffers much."""

import asyncio
import hmac
import socket
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from vicode.bridge.behaviors import BehaviorError
from vicode.bridge.dialects import Dialect, JoinRequest, JsonDialect, JxiDialect, Pace, RefusedError
from vicode.bridge.flow_control import FlowControl
from vicode.bridge.frames import GREETING, FrameError, LineDecoder, is_json, shorten, show_bytes
from vicode.bridge.parameters import Raw
from vicode.bridge.robot import Robot

if TYPE_CHECKING:
    from vicode.bridge.server import BridgeServer

_READ_BYTES = 32_768
TURN_S = 0.002
"""So long a connection handles lines before others get their turn."""
_MAX_UNSENT_BYTES = 65_536
_ERROR_BURST, _ERRORS_PER_S = 5, 1.0
_CLOSE_S = 1.0
_KEEP_ALIVE_S = 10
_DRIFT = 10_000
_GREATEST_DELAY_NS = 5_000_000_000


class Connection(asyncio.BufferedProtocol):
    """One client. It becomes a robot with its first line, unless a token is missing."""

    def __init__(self, server: "BridgeServer") -> None:
        self.server = server
        self.robot: Robot | None = None
        self.pace: Pace = "clock"
        self.is_admitted = not server.options.token
        self.tick_ms = shorten(server.options.tick_ns / 1e6)
        self.peer = "?"
        self.connected_s = time.monotonic()
        self._buffer = memoryview(bytearray(_READ_BYTES))
        self._decoder = LineDecoder()
        self._lines: deque[bytes] = deque()
        self._dialect: Dialect | None = None
        self._flow = FlowControl(time.monotonic_ns(), server.options.command_rate_hz)
        self._sends_state = False
        self._error_credit, self._error_s, self._hidden_errors = float(_ERROR_BURST), self.connected_s, 0
        self._clock_offset = ClockOffset()
        self._tick_ns: int | None = None
        self._sent_ticks = 0
        self._is_unread = False
        self._has_new_values = False
        self.turn_s = TURN_S
        self.is_working = False
        """Whether lines wait for the next turn."""
        self._transport: asyncio.Transport

    # asyncio

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        self._transport = transport
        keep_alive(transport)
        peer = transport.get_extra_info("peername")
        self.peer = f"{peer[0]}:{peer[1]}" if isinstance(peer, tuple) else "?"
        transport.write(GREETING)
        if not self.server.add(self):
            self.refuse("too many connections")

    def get_buffer(self, sizehint: int) -> memoryview:  # noqa: ARG002 - of asyncio
        return self._buffer

    def buffer_updated(self, nbytes: int) -> None:
        if self._dialect is None:
            self._dialect = JsonDialect() if is_json(bytes(self._buffer[:1])) else JxiDialect()
        self._lines += self._decoder.feed(bytes(self._buffer[:nbytes]))
        if self._lines and not self.is_working:
            self._work()

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - of asyncio
        self._lines.clear()
        self.server.remove(self)

    def pause_writing(self) -> None:
        # A client that does not read the answers to its ticks gets no more of them.
        self._is_unread = True
        self._update_reading()

    def resume_writing(self) -> None:
        self._is_unread = False
        self._update_reading()

    def _update_reading(self) -> None:
        if self.is_working or (self._is_unread and self.pace == "client"):
            self._transport.pause_reading()
        else:
            self._transport.resume_reading()

    # Lines

    def _work(self) -> None:
        """Handle lines for a while; the rest waits until other connections and ticks had their turn."""
        end_s, lines = time.perf_counter() + self.turn_s, self._lines
        while lines:
            self._handle(lines.popleft())
            if self._transport.is_closing():
                lines.clear()
            if time.perf_counter() >= end_s:
                break
        if self._has_new_values and self.pace == "message":
            self._has_new_values = False
            self.server.tick_by_message(self)
        self.flush()
        was_working, self.is_working = self.is_working, bool(lines)
        if lines:
            asyncio.get_running_loop().call_soon(self._work)
        if lines or was_working:
            self._update_reading()

    def _handle(self, line: bytes) -> None:
        assert self._dialect is not None
        try:
            self._dialect.handle(line, self)
        except FrameError as error:
            counts = self.robot.data.counts if self.robot is not None else self.server.counts
            counts.malformed += not isinstance(error, UnknownTargetError)
            if self.complain(str(error)):
                self.server.on_event(self.robot.name if self.robot is not None else self.peer, str(error))
        except RefusedError as error:
            self.refuse(str(error))

    # What lines do

    def admit(self, token: str) -> None:
        expected = self.server.options.token
        # JSON can contain surrogates, which UTF-8 cannot.
        if expected and not hmac.compare_digest(token.encode(errors="replace"), expected.encode()):
            raise RefusedError("wrong token" if token else "this server needs a token")
        self.is_admitted = True

    def join(self, hello: JoinRequest) -> str:
        if self.robot is not None:
            raise FrameError("the robot has its name already; name it before the first sensor")
        self.pace, self._sends_state = hello.pace, hello.sends_state
        self.robot = self.server.join(hello, self)
        self.robot.data.flow = None if self.pace == "client" else self._flow
        return self.robot.name

    def select(self, behavior: str) -> str:
        robot = self._require_robot()
        name = behavior or robot.behavior_name or self.server.catalog.default
        if not name:
            raise FrameError(f"choose a behavior: {', '.join(self.server.catalog.names)}")
        if name != robot.behavior_name:
            try:
                self.server.start_behavior(robot, name)
            except BehaviorError as error:
                raise FrameError(str(error)) from error
        return name

    def receive(self, target: str, raw: Raw, time_ns: int | None = None) -> None:
        robot = self._require_robot()
        if not robot.data.receive(target, raw, self._to_server_time(time_ns)):
            shown = show_bytes(target.encode("ascii", "replace"))
            raise UnknownTargetError(f"no sensor or event {shown}; the world has {', '.join(robot.data.targets)}")
        self._has_new_values = True
        if robot.behavior is None:
            self.select("")

    @property
    def awaited(self) -> list[str]:
        return [] if self.robot is None else self.robot.awaited

    def acknowledge(self, *, lines: int | None = None, time_ns: int | None = None) -> None:
        if self.pace == "client":
            raise FrameError("in lock step, commands are not acknowledged; leave out ack")
        now_ns, age_ns = time.monotonic_ns(), None
        if lines is not None:
            age_ns = self._flow.acknowledge_lines(lines, now_ns)
        if time_ns is not None:
            age_ns = self._flow.acknowledge_time(time_ns, now_ns)
        if age_ns is not None and self.robot is not None:
            self.robot.command_ages.add(age_ns)

    def tick(self, time_ns: int) -> None:
        robot = self._require_robot()
        if self.pace != "client":
            raise FrameError('a tick needs {"hello": {"pace": "client"}}')
        if self._tick_ns is not None and time_ns < self._tick_ns:
            raise FrameError(f"tick {time_ns / 1e9:g} is before tick {self._tick_ns / 1e9:g}")
        self._tick_ns = time_ns
        self.server.tick(robot, at_ns=time_ns, now_ns=time_ns)
        more: dict[str, Any] = {"tick": shorten(time_ns / 1e9)} | self._describe(robot)
        if reports := robot.take_reports():
            more["errors"] = reports
        if notices := robot.data.take_notices():
            more["notices"] = notices
            for line in notices:
                self.server.on_event(robot.name, line)
        assert self._dialect is not None
        self.send(self._dialect.encode_commands(robot.data.commands.take(), more))

    def _require_robot(self) -> Robot:
        if self.robot is None:
            self.join(JoinRequest())
        assert self.robot is not None
        return self.robot

    def _to_server_time(self, time_ns: int | None) -> int:
        """When a value was sent, on the clock of the ticks: that of the server, or of a client that ticks."""
        if self.pace == "client":
            return time_ns if time_ns is not None else self._tick_ns or 0
        now_ns = time.monotonic_ns()
        return now_ns if time_ns is None else self._clock_offset.convert(time_ns, now_ns)

    # Lines to the client

    def send(self, line: bytes) -> None:
        self._transport.write(line)

    def flush(self) -> None:
        """Send the commands that wait, if the robot has read those before, and at once if they stop it."""
        robot = self.robot
        if robot is None or self.pace == "client":
            return
        if not self._may_send(robot.data.commands.is_urgent):
            if self._flow.is_overdue(time.monotonic_ns()):
                robot.data.notices.add("newer commands wait: the previous ones have not been acknowledged for 1 s")
            return
        ticks = robot.data.counts.ticks
        if robot.data.commands.has_waiting or (self._sends_state and ticks != self._sent_ticks):
            self._sent_ticks = ticks
            self._send_commands(robot)

    def _send_commands(self, robot: Robot) -> None:
        assert self._dialect is not None
        commands, more, now_ns = robot.data.commands.take(), self._describe(robot), time.monotonic_ns()
        if (age_ns := self._flow.age_ns(now_ns)) is not None:
            more["command_age_ms"] = round(age_ns / 1e6, 3)
        lines = len(commands) if isinstance(self._dialect, JxiDialect) else 1
        more["time"] = self._flow.add(lines, robot.ticked_ns, now_ns)
        self.send(self._dialect.encode_commands(commands, more))

    def stop(self) -> None:
        """Send the commands that stop the robot, and close the connection."""
        if self.robot is not None and self._dialect is not None and not self._transport.is_closing():
            self.send(self._dialect.encode_commands(self.robot.data.commands.stop(), {}))
        self.close()

    def complain(self, text: str) -> bool:
        """Send an error, unless there were many; return whether it is one of the few."""
        now_s = time.monotonic()
        self._error_credit = min(_ERROR_BURST, self._error_credit + (now_s - self._error_s) * _ERRORS_PER_S)
        self._error_s = now_s
        is_rare = self._error_credit >= 1
        # A client that ticks waits for one answer to each line.
        is_wanted = is_rare or self.pace == "client"
        if self._dialect is None or not is_wanted or self._transport.get_write_buffer_size() > _MAX_UNSENT_BYTES:
            self._hidden_errors += 1
            return False
        self._error_credit -= is_rare
        hidden = f" (and {self._hidden_errors} other errors)" if self._hidden_errors else ""
        self._hidden_errors = 0
        self.send(self._dialect.encode_error(text + hidden))
        return is_rare

    def notify(self, text: str) -> None:
        """Send a notice; each of them is rare."""
        if self._dialect is not None and self._transport.get_write_buffer_size() <= _MAX_UNSENT_BYTES:
            self.send(self._dialect.encode_notice(text))

    def refuse(self, text: str) -> None:
        """Send an error and close the connection."""
        if not self._transport.is_closing():
            self.send((self._dialect or JxiDialect()).encode_error(text))
            self.close()

    def close(self) -> None:
        """Close the connection when everything is sent, or soon."""
        self._transport.close()
        asyncio.get_running_loop().call_later(_CLOSE_S, self._transport.abort)

    def _may_send(self, is_urgent: bool) -> bool:
        is_free = is_urgent or self._flow.may_send(time.monotonic_ns())
        return is_free and not self._transport.get_write_buffer_size() and not self._transport.is_closing()

    def _describe(self, robot: Robot) -> dict[str, Any]:
        """What a message has in addition to commands: age of the data, active states if requested."""
        more: dict[str, Any] = {}
        if (age_ns := robot.data.readings.age_ns) is not None:
            more["age_ms"] = round(age_ns / 1e6, 3)
        if self._sends_state and robot.behavior is not None:
            more["state"] = {"active": robot.behavior.active_states()}
        return more


def keep_alive(transport: asyncio.Transport) -> None:
    """Let the system find out that a silent client has gone."""
    connection = transport.get_extra_info("socket")
    if connection is not None and connection.family in (socket.AF_INET, socket.AF_INET6):
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        if hasattr(socket, "TCP_KEEPIDLE"):
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, _KEEP_ALIVE_S)


class UnknownTargetError(FrameError):
    """A target that the world does not declare: counted apart, as it is no fault of the line."""


class ClockOffset:
    """Converts times of a robot to those of the server: the message that was fastest on its way has age 0."""

    __slots__ = ("_now_ns", "_offset_ns", "_robot_ns")

    def __init__(self) -> None:
        self._offset_ns: int | None = None
        self._now_ns = self._robot_ns = 0

    def convert(self, robot_ns: int, now_ns: int) -> int:
        offset_ns = now_ns - robot_ns
        # A clock that was set back by more than messages are late has nothing to do with the one before.
        if self._offset_ns is not None and robot_ns > self._robot_ns - _GREATEST_DELAY_NS:
            # The clocks may drift apart by this much.
            known_ns = self._offset_ns + (now_ns - self._now_ns) // _DRIFT
            offset_ns = min(offset_ns, known_ns)
        self._offset_ns, self._now_ns, self._robot_ns = offset_ns, now_ns, robot_ns
        return robot_ns + offset_ns
