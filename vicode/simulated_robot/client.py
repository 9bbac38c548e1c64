"""The robot's end of a connection to a bridge, in JSON lines or in the lines of JXI."""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Mapping, Sequence
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

Sensors = Mapping[str, Sequence[float]]
_ANSWER_TIMEOUT_S = 30.0


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
        errors: What went wrong in the tick: exceptions, and values that could not be read.
    """

    commands: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    active: tuple[tuple[str, str], ...] | None = None
    age_ms: float | None = None
    errors: tuple[str, ...] = ()


class RobotConnection:
    """A connection of one robot. Use `connect` to open it."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, *, is_jxi: bool) -> None:
        self._reader, self._writer, self._is_jxi = reader, writer, is_jxi

    @staticmethod
    async def connect(host: str, port: int, hello: HelloMessage, *, is_jxi: bool = False) -> "RobotConnection":
        """Connect and say hello.

        Raises:
            OSError: Nothing listens there.
            BridgeError: The server is no bridge, or it refuses the robot.
        """
        reader, writer = await asyncio.open_connection(host, port, limit=2 * MAX_LINE_BYTES)
        connection = RobotConnection(reader, writer, is_jxi=is_jxi)
        try:
            await connection._greet(hello)
        except BaseException:
            writer.close()
            raise
        return connection

    async def _greet(self, hello: HelloMessage) -> None:
        greeting = await self._read_line()
        if greeting != GREETING:
            raise BridgeError(f"the server is no bridge: it greets with {greeting[:40]!r}")
        self._writer.write(hello.to_jxi() if self._is_jxi else hello.to_json())
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
            line = await self._read_line()
            answer = _read_jxi(line) if self._is_jxi else _read_json(line)
            if answer is not None:
                return answer

    async def answers(self) -> AsyncIterator[Answer]:
        """All further messages, until the bridge closes the connection."""
        while line := await _read_or_end(self._reader):
            answer = _read_jxi(line) if self._is_jxi else _read_json(line)
            if answer is not None:
                yield answer

    async def drain(self) -> None:
        """Wait until the bridge has room for more messages; a closed connection is reported by reading."""
        with contextlib.suppress(ConnectionError):
            await self._writer.drain()

    async def close(self) -> None:
        self._writer.close()
        # The bridge may have closed first.
        with contextlib.suppress(OSError):
            await self._writer.wait_closed()

    async def _read_line(self) -> bytes:
        try:
            async with asyncio.timeout(_ANSWER_TIMEOUT_S):
                line = await _read_or_end(self._reader)
        except TimeoutError:
            raise BridgeError(f"the bridge did not answer for {_ANSWER_TIMEOUT_S:g} s") from None
        if not line:
            raise BridgeError("the bridge closed the connection")
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


def _read_json(line: bytes) -> Answer | None:
    message = _decode(line)
    if not message.keys() & {"tick", "commands", "state", "errors"}:
        return None
    active = message.get("state", {}).get("active")
    return Answer(
        commands={name: tuple(values) for name, values in message.get("commands", {}).items()},
        active=None if active is None else tuple((option, state) for option, state in active),
        age_ms=message.get("age_ms"),
        errors=tuple(map(str, message.get("errors", ()))),
    )


def _read_jxi(line: bytes) -> Answer | None:
    """A line of JXI; unknown ones are ignored, as JXI does."""
    try:
        target, parameters = decode_jxi(line)
        return Answer(commands={target: tuple(float(each) for each in split_parameters(parameters))})
    except (FrameError, ValueError):
        return None
