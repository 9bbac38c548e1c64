"""Connects to running robots (docs/live.md): a transport over a socket, and the messages of the live protocol."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

PROTOCOL_VERSION = 1
TOKEN_VARIABLE = "VICODE_WATCH_TOKEN"  # noqa: S105 - the name of a variable
_UNIX = "unix:"
_MAX_LINE_BYTES = 16_000_000
_CONNECT_LIMIT_S = 5.0
_RATE_HZ = 30.0
_NAMES_OF_HOST = ("localhost", "127.0.0.1", "::1")


class AttachError(OSError):
    """No robot can be watched there; the message says why. `is_final`: trying again would not help."""

    def __init__(self, message: str, *, is_final: bool = False) -> None:
        super().__init__(message)
        self.is_final = is_final


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotAddress:
    """Where robots listen: a TCP port of a host, or the path of a Unix socket."""

    host: str = ""
    port: int = 0
    path: str = ""

    def __str__(self) -> str:
        return f"{_UNIX}{self.path}" if self.path else f"{self.host}:{self.port}"


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentDescription:
    """A component of a robot; `code` is the SHA-256 of the file that defines it."""

    design: str = ""
    code: str = ""
    states: tuple[str, ...] = ()
    frequency_hz: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotDescription:
    """A robot and the components of its root, by name; `shared` are hashes of modules that designs share, by file.

    `language` is that of the files.
    """

    name: str
    root: str
    language: str = "python"
    components: Mapping[str, ComponentDescription] = field(default_factory=dict)
    shared: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Hello:
    """The first message of a server: its robots, and whether viewers may control them."""

    control: bool
    robots: tuple[RobotDescription, ...]


class SocketTransport:
    """Carries lines over a socket (a `Transport` of simulations)."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader, self._writer = reader, writer

    async def send(self, line: bytes) -> None:
        """Send a line.

        Raises:
            ConnectionError: The robot has ended.
        """
        self._writer.write(line)
        await self._writer.drain()

    def send_soon(self, line: bytes) -> None:
        """Send a line without waiting; it is lost if the robot has ended."""
        self._writer.write(line)

    async def receive(self) -> bytes:
        """Receive a line; empty after the connection has ended.

        Raises:
            ValueError: The line is too long.
        """
        try:
            line = await self._reader.readline()
        except OSError:
            return b""
        return line if line.endswith(b"\n") else b""

    async def interrupt(self) -> str:
        """Nothing: a robot is never stopped by its viewers."""
        return ""

    async def explain_end(self) -> tuple[str, tuple[str, ...]]:
        return "The robot closed the connection", ()

    def close(self) -> None:
        self._writer.close()

    async def wait_closed(self) -> None:
        with contextlib.suppress(OSError):
            await self._writer.wait_closed()


def parse_address(text: str) -> RobotAddress:
    """Parse PORT, HOST:PORT or unix:PATH.

    Raises:
        AttachError: It is none of them.
    """
    text = text.strip()
    if text.startswith(_UNIX) and text != _UNIX:
        return RobotAddress(path=text.removeprefix(_UNIX))
    host, _colon, port = text.rpartition(":")
    if not port.isdecimal() or not 0 < int(port) < 2**16:
        raise AttachError(f"'{text}' is no address of a robot; write PORT, HOST:PORT or unix:PATH", is_final=True)
    return RobotAddress(host=host.strip("[]") or "127.0.0.1", port=int(port))


async def connect(address: RobotAddress, token: str = "") -> tuple[SocketTransport, Hello]:
    """Connect to robots and return their description.

    Raises:
        AttachError: Nobody listens there, the token is wrong, or it is no vicode robot.
    """
    try:
        reader, writer = await asyncio.wait_for(_open(address), _CONNECT_LIMIT_S)
    except TimeoutError:
        raise AttachError(f"{address} does not answer") from None
    except (OSError, ValueError) as error:
        raise AttachError(_explain_refusal(address, error)) from error
    transport = SocketTransport(reader, writer)
    try:
        await transport.send(encode({"token": token, "rate_hz": _RATE_HZ}))
        line = await asyncio.wait_for(transport.receive(), _CONNECT_LIMIT_S)
        plain = decode_line(line) if line else None
        hello = None if plain is None or "error" in plain else decode_hello(plain)
    except ConnectionError:
        plain = hello = None
    except AttachError:
        transport.close()
        raise
    except (TimeoutError, ValueError, KeyError, TypeError, AttributeError) as error:
        transport.close()
        raise AttachError(f"no vicode robot answers at {address}", is_final=True) from error
    if hello is None:
        transport.close()
        if plain is not None:
            raise AttachError(_explain_token(address, token), is_final=True)
        raise AttachError(f"{address} closed the connection; behind a forwarded port, no robot may be running")
    return transport, hello


def encode(message: Mapping[str, Any]) -> bytes:
    return json.dumps(message, separators=(",", ":")).encode() + b"\n"


def decode_line(line: bytes) -> dict[str, Any]:
    """Decode a line of the protocol.

    Raises:
        ValueError: It is no JSON object.
    """
    try:
        plain = json.loads(line)
    except RecursionError as error:
        raise ValueError("nested too deeply") from error
    if not isinstance(plain, dict):
        raise ValueError("not an object")  # noqa: TRY004 - of a text, its value is wrong
    return plain


def decode_hello(plain: Mapping[str, Any]) -> Hello:
    """Decode a description of robots.

    Raises:
        AttachError: It has another version.
        ValueError, KeyError, TypeError, AttributeError: It is no description.
    """
    version = plain["vicode-live"]
    if version != PROTOCOL_VERSION:
        words = f"the robot speaks version {str(version)[:20]} of the protocol, this vicode {PROTOCOL_VERSION}"
        raise AttachError(f"{words}; use the same version of vicode on both sides", is_final=True)
    return Hello(control=plain.get("control") is True, robots=tuple(_robot(each) for each in plain["robots"]))


def _robot(plain: Mapping[str, Any]) -> RobotDescription:
    components = {
        str(name): ComponentDescription(
            design=str(each.get("design", "")),
            code=str(each.get("code", "")),
            states=tuple(str(state) for state in each.get("states", ())),
            frequency_hz=float(each["frequency_hz"]) if each.get("frequency_hz") else None,
        )
        for name, each in plain["components"].items()
    }
    shared = {str(name): str(code) for name, code in plain.get("shared", {}).items()}
    language = "cpp" if plain.get("language") == "cpp" else "python"
    return RobotDescription(
        name=str(plain["name"]), root=str(plain["root"]), language=language, components=components, shared=shared
    )


async def _open(address: RobotAddress) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    if address.path:
        open_unix: Any = getattr(asyncio, "open_unix_connection", None)
        if open_unix is None:
            raise AttachError("this system has no Unix sockets; write PORT or HOST:PORT", is_final=True)
        streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] = await open_unix(
            address.path, limit=_MAX_LINE_BYTES
        )
        return streams
    return await asyncio.open_connection(address.host, address.port, limit=_MAX_LINE_BYTES)


def _explain_refusal(address: RobotAddress, error: Exception) -> str:
    if isinstance(error, ConnectionRefusedError | FileNotFoundError):
        remedy = "start the robot with --watch, Root.watch or VICODE_WATCH"
        if address.path or address.host in _NAMES_OF_HOST:
            remedy += ", or forward its port with ssh -L"
        return f"no robot listens at {address}; {remedy}"
    reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return f"cannot connect to {address}: {reason}"


def _explain_token(address: RobotAddress, token: str) -> str:
    subject = "the token is wrong" if token else "a token is needed"
    return (
        f"{address} refused the connection: {subject}; the robot prints it when it starts (--token, {TOKEN_VARIABLE})"
    )
