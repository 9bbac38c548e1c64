"""The robot's end of a connection to a bridge, in JSON lines or in the lines of JXI."""

import asyncio
import contextlib
import ssl
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from vicode.bridge.frames import (
    GREETING,
    MAX_LINE_BYTES,
    FrameError,
    decode_json,
    decode_jxi,
    encode_json,
    encode_jxi,
    split_parameters,
)
from vicode.simulated_robot.faults import Sensors

_ANSWER_TIMEOUT_S = 30.0
_TLS_ALERT = b"\x15\x03"
_NO_GREETING = "the bridge closed the connection without a greeting; if it has a certificate, add --tls or --ca"


class BridgeError(Exception):
    """The bridge refused, broke the protocol or closed the connection; the text says what happened."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HelloMessage:
    """What a robot says first.

    Attributes:
        robot: Its name.
        behavior: The agent or design that drives it, "" for the default of the bridge.
        token: The secret of the bridge, if it has one.
        is_lock_step: Whether the robot's messages are the clock.
        team: Robots with the same behavior and the same team coordinate.
        priority: Its priority in the team.
    """

    robot: str
    behavior: str = ""
    token: str = ""
    is_lock_step: bool = False
    team: str = ""
    priority: int = 0

    def to_json(self) -> bytes:
        hello: dict[str, Any] = {"robot": self.robot, "state": True, "pace": "client" if self.is_lock_step else "clock"}
        hello |= {"behavior": self.behavior} if self.behavior else {}
        hello |= {"token": self.token} if self.token else {}
        hello |= {"team": self.team} if self.team else {}
        hello |= {"priority": self.priority} if self.priority else {}
        return encode_json({"hello": hello})

    def to_jxi(self) -> bytes:
        lines = [encode_jxi("TOKEN", [self.token])] if self.token else []
        lines.append(encode_jxi("ROBOT", [self.robot]))
        lines += [encode_jxi("BEHAVIOR", [self.behavior])] if self.behavior else []
        return b"".join(lines)


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """A message of the bridge.

    Attributes:
        commands: New parameters by command.
        active: Active options or components with their states, the root first; None if the message does not say.
        age_ms: Age of the oldest sensor value that the behavior read.
        command_age_ms: Age of the commands that the robot obeyed before.
        errors: What went wrong in the tick: exceptions, and values that could not be read.
        notices: What the bridge reports that is no error, such as commands at rest.
    """

    commands: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    active: tuple[tuple[str, str], ...] | None = None
    age_ms: float | None = None
    command_age_ms: float | None = None
    errors: tuple[str, ...] = ()
    notices: tuple[str, ...] = ()


class RobotConnection:
    """A connection of one robot. Use `connect` to open it."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, *, is_jxi: bool) -> None:
        self._reader, self._writer, self._is_jxi = reader, writer, is_jxi
        self._lines = 0

    @staticmethod
    async def connect(
        host: str, port: int, hello: HelloMessage, *, is_jxi: bool = False, tls: ssl.SSLContext | None = None
    ) -> "RobotConnection":
        """Connect and say hello.

        Raises:
            OSError: Nothing listens there.
            BridgeError: The server is no bridge, or it refuses the robot.
        """
        try:
            reader, writer = await asyncio.open_connection(host, port, limit=2 * MAX_LINE_BYTES, ssl=tls)
        except ssl.SSLCertVerificationError as error:
            raise BridgeError(
                f"the certificate of the bridge is not trusted: {error.verify_message}; add --ca with its certificate"
            ) from None
        except ssl.SSLError:
            raise BridgeError("the bridge does not use TLS; leave out --tls and --ca") from None
        connection = RobotConnection(reader, writer, is_jxi=is_jxi)
        try:
            await connection._greet(hello)
        except BaseException:
            writer.close()
            raise
        return connection

    async def _greet(self, hello: HelloMessage) -> None:
        # Before the greeting: a server with TLS sends none, but it answers what is no handshake.
        self._writer.write(hello.to_jxi() if self._is_jxi else hello.to_json())
        greeting = await self._read_line(_NO_GREETING)
        if greeting.startswith(_TLS_ALERT):
            raise BridgeError(_NO_GREETING)
        if greeting != GREETING:
            raise BridgeError(f"the server is no bridge: it greets with {greeting[:40]!r}")
        if self._is_jxi:
            self._writer.write(encode_jxi("ACK", [0]))
        if not self._is_jxi:
            welcome = _decode(await self._read_line())
            if "welcome" not in welcome:
                raise BridgeError(f"expected a welcome of the bridge, found {welcome}")

    def send(self, sensors: Sensors, *, time_s: float) -> None:
        """Send sensor values without waiting for an answer."""
        if self._is_jxi:
            self._writer.write(b"".join(encode_jxi(target, values) for target, values in sensors.items()))
        else:
            self._writer.write(encode_json({"time": time_s, **sensors}))

    def send_tick(self, sensors: Sensors, *, time_s: float) -> None:
        """In lock step, send sensor values and let the behavior run; `read` returns the answer."""
        self._writer.write(encode_json({"time": time_s, **sensors, "tick": time_s}))

    async def read(self) -> Answer:
        """Read the next message.

        Raises:
            BridgeError: It is an error, or none comes.
        """
        while True:
            answer = self._take(await self._read_line())
            if answer is not None:
                return answer

    async def answers(self) -> AsyncIterator[Answer]:
        """All further messages, until the bridge closes the connection."""
        while line := await _read_or_end(self._reader):
            answer = self._take(line)
            if answer is not None:
                yield answer

    def _take(self, line: bytes) -> Answer | None:
        """Decode a line and acknowledge its commands; None if it has none."""
        if self._is_jxi:
            command = _decode_jxi(line)
            if command is not None and command[0] == "NOTICE":
                return Answer(notices=(command[1].decode(errors="replace").strip(),))
            if command is not None:
                self._lines += 1
                self._writer.write(encode_jxi("ACK", [self._lines]))
            return _read_jxi(command) if command is not None else None
        message = _decode(line)
        if "time" in message:
            self._writer.write(encode_json({"ack": message["time"]}))
        return _read_json(message)

    async def drain(self) -> None:
        """Wait until the bridge has room for more messages; a closed connection is reported by reading."""
        with contextlib.suppress(ConnectionError):
            await self._writer.drain()

    async def close(self) -> None:
        self._writer.close()
        # The bridge may have closed first.
        with contextlib.suppress(OSError):
            await self._writer.wait_closed()

    async def _read_line(self, end: str = "the bridge closed the connection") -> bytes:
        """Read a line; `end` says what happened if there is none."""
        try:
            async with asyncio.timeout(_ANSWER_TIMEOUT_S):
                line = await _read_or_end(self._reader)
        except TimeoutError:
            raise BridgeError(f"the bridge did not answer for {_ANSWER_TIMEOUT_S:g} s") from None
        if not line:
            raise BridgeError(end)
        return line


async def _read_or_end(reader: asyncio.StreamReader) -> bytes:
    """The next line, empty at the end of the connection."""
    try:
        return await reader.readline()
    except ConnectionError:
        return b""


def _decode(line: bytes) -> dict[str, Any]:
    try:
        message = decode_json(line)
    except FrameError as error:
        raise BridgeError(str(error)) from None
    if "error" in message:
        raise BridgeError(f"the bridge reports: {message['error']}")
    return message


def _read_json(message: Mapping[str, Any]) -> Answer | None:
    if not message.keys() & {"tick", "commands", "state", "errors", "notice"}:
        return None
    active = message.get("state", {}).get("active")
    return Answer(
        commands={name: tuple(values) for name, values in message.get("commands", {}).items()},
        active=None if active is None else tuple((option, state) for option, state in active),
        age_ms=message.get("age_ms"),
        command_age_ms=message.get("command_age_ms"),
        errors=tuple(map(str, message.get("errors", ()))),
        notices=(*map(str, message.get("notices", ())), *([str(message["notice"])] if "notice" in message else [])),
    )


def _decode_jxi(line: bytes) -> tuple[str, bytes] | None:
    """The target and the parameters of a command; None for a line that is no command."""
    try:
        target, parameters = decode_jxi(line)
    except FrameError:
        return None
    if target == "ERROR":
        raise BridgeError(f"the bridge reports: {parameters.decode(errors='replace').strip()}")
    return target, parameters


def _read_jxi(command: tuple[str, bytes]) -> Answer | None:
    """A command; one whose parameters are no numbers is ignored."""
    target, parameters = command
    try:
        return Answer(commands={target: tuple(float(each) for each in split_parameters(parameters))})
    except ValueError:
        return None
