"""The two languages of the protocol: what their lines mean for a client, and how commands are written. No I/O."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from vicode.bridge.frames import (
    FrameError,
    decode_json,
    decode_jxi,
    encode_json,
    encode_jxi,
    show_bytes,
    split_parameters,
)
from vicode.bridge.parameters import Raw

Pace = Literal["clock", "client"]
RESERVED_TARGETS = frozenset({"TOKEN", "ROBOT", "BEHAVIOR", "ERROR", "hello", "time", "tick"})
_NS_PER_S = 1_000_000_000
_LATEST_S = 1e9
_GREATEST_PRIORITY = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class JoinRequest:
    """How a client becomes a robot.

    Attributes:
        name: "" for one that the server chooses.
        pace: Whether the server's clock or the client ticks.
        sends_state: Whether the client wants to know the active states.
        team: Robots with the same team and behavior coordinate.
        priority: In the team; by default, who came first has the highest.
    """

    name: str = ""
    pace: Pace = "clock"
    sends_state: bool = False
    team: str = ""
    priority: int | None = None


class RefusedError(Exception):
    """The connection must end; the text is the last line to the client."""


class Client(Protocol):
    """What the lines of a client do; a connection implements it."""

    is_admitted: bool
    tick_ms: float

    def admit(self, token: str) -> None:
        """Check the token.

        Raises:
            RefusedError: It is wrong.
        """

    def join(self, hello: JoinRequest) -> str:
        """Become a robot, a new one or one that was here before; return its name.

        Raises:
            RefusedError: There are too many robots.
        """

    def select(self, behavior: str) -> str:
        """Start a behavior, "" for the default; return its name.

        Raises:
            FrameError: There is no such behavior.
        """

    def receive(self, target: str, raw: Raw, time_ns: int | None = None) -> None:
        """Take a value or event that was sent at this time on the clock of the robot."""

    def tick(self, time_ns: int) -> None:
        """Run the behavior and answer.

        Raises:
            FrameError: The time is before that of the last tick.
        """

    def send(self, line: bytes) -> None:
        """Send an answer."""


class Dialect(Protocol):
    """A language of the protocol."""

    def handle(self, line: bytes, client: Client) -> None:
        """Do what a line says.

        Raises:
            FrameError: It cannot be done; the connection stays open.
            RefusedError: The connection ends.
        """

    def encode_commands(self, commands: Mapping[str, tuple[Any, ...]], more: Mapping[str, Any], /) -> bytes:
        """Write commands; `more` is what only JSON can say."""

    def encode_error(self, text: str) -> bytes: ...


class JxiDialect:
    """Lines of JXI: `TARGET:p1,p2,…`; `TOKEN`, `ROBOT` and `BEHAVIOR` are no sensors."""

    def handle(self, line: bytes, client: Client) -> None:
        target, raw = decode_jxi(line)
        if target == "TOKEN":
            client.admit(_text(raw))
        elif not client.is_admitted:
            raise RefusedError("this server needs a token; send TOKEN:… first")
        elif target == "ROBOT":
            client.join(JoinRequest(name=_text(raw)))
        elif target == "BEHAVIOR":
            client.select(_text(raw))
        else:
            client.receive(target, raw)

    def encode_commands(self, commands: Mapping[str, tuple[Any, ...]], _more: Mapping[str, Any]) -> bytes:
        return b"".join(encode_jxi(target, parameters) for target, parameters in commands.items())

    def encode_error(self, text: str) -> bytes:
        return f"ERROR: {' '.join(text.split())}\n".encode(errors="replace")


class JsonDialect:
    """JSON lines: first a `hello`, then objects of targets, with `time` and `tick`."""

    def __init__(self) -> None:
        self._has_joined = False

    def handle(self, line: bytes, client: Client) -> None:
        message = decode_json(line)
        if not self._has_joined:
            self._greet(message.pop("hello", {}), client)
        time_ns, tick_ns = _take_time(message, "time"), _take_time(message, "tick")
        if tick_ns is not None and time_ns is None:
            time_ns = tick_ns
        for target, value in message.items():
            client.receive(target, value if isinstance(value, list) else [value], time_ns)
        if tick_ns is not None:
            client.tick(tick_ns)

    def _greet(self, hello: Any, client: Client) -> None:
        if not isinstance(hello, dict):
            raise RefusedError('hello is an object, such as {"hello": {"robot": "r1"}}')
        client.admit(_get(hello, "token"))
        try:
            robot = client.join(_read_hello(hello))
            behavior = client.select(_get(hello, "behavior"))
        except FrameError as error:
            raise RefusedError(str(error)) from None
        self._has_joined = True
        client.send(encode_json({"welcome": {"robot": robot, "behavior": behavior, "tick_ms": client.tick_ms}}))

    def encode_commands(self, commands: Mapping[str, tuple[Any, ...]], more: Mapping[str, Any], /) -> bytes:
        return encode_json({**more, "commands": commands})

    def encode_error(self, text: str) -> bytes:
        return encode_json({"error": text})


def _text(raw: bytes) -> str:
    parameters = split_parameters(raw)
    return parameters[0] if parameters else ""


def _get(hello: dict[str, Any], key: str) -> str:
    value = hello.get(key, "")
    if not isinstance(value, str):
        raise RefusedError(f"hello: {key} is {_show(value)}, expected a text")
    return value


def _read_hello(hello: dict[str, Any]) -> JoinRequest:
    pace, priority = _get(hello, "pace") or "clock", hello.get("priority")
    if pace not in ("clock", "client"):
        raise RefusedError(f"hello: pace is {_show(pace)}, expected clock or client")
    if priority is not None and (type(priority) is not int or abs(priority) > _GREATEST_PRIORITY):
        raise RefusedError(f"hello: priority is {_show(priority)}, expected an integer")
    return JoinRequest(
        name=_get(hello, "robot"),
        pace="client" if pace == "client" else "clock",
        sends_state=hello.get("state") is True,
        team=_get(hello, "team"),
        priority=priority,
    )


def _show(value: object) -> str:
    return show_bytes(
        value.encode(errors="replace") if isinstance(value, str) else repr(value).encode(errors="replace")
    )


def _take_time(message: dict[str, Any], key: str) -> int | None:
    """Remove a time in seconds from a message; return it in nanoseconds."""
    if key not in message:
        return None
    seconds = message.pop(key)
    if isinstance(seconds, bool) or not isinstance(seconds, int | float):
        raise FrameError(f"{key} is {_show(seconds)}, expected seconds")
    # Also false if it is not a number; an int may have more digits than a float.
    if not abs(seconds) <= _LATEST_S:
        raise FrameError(f"{key} is not a number of seconds up to {_LATEST_S:g}")
    return round(seconds * _NS_PER_S)
