"""The two languages of the protocol: what their lines mean for a client, and how commands are written. No I/O."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol, cast, get_args

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

Pace = Literal["clock", "client", "message"]
_JXI_TARGETS = ("TOKEN", "ROBOT", "BEHAVIOR", "TEAM", "PACE", "TIME", "ACK", "ERROR", "NOTICE")
RESERVED_TARGETS = frozenset((*_JXI_TARGETS, "hello", "time", "tick", "ack"))
_NS_PER_S = 1_000_000_000
_LATEST_S = 1e9
_GREATEST_PRIORITY = 1_000_000
_MOST_DIGITS = 18
_PRIORITY_DIGITS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class JoinRequest:
    """How a client becomes a robot.

    Attributes:
        name: "" for one that the server chooses.
        pace: Whether the server's clock, the client, or each message with values ticks.
        sends_state: Whether the client wants to know the active states.
        team: Robots with the same team and behavior coordinate.
        priority: In the team; by default, who came first has the highest.
        waits: Whether a behavior by the clock starts only when values have arrived.
    """

    name: str = ""
    pace: Pace = "clock"
    sends_state: bool = False
    team: str = ""
    priority: int | None = None
    waits: bool = True


class RefusedError(Exception):
    """The connection must end; the text is the last line to the client."""


class Client(Protocol):
    """What the lines of a client do; a connection implements it."""

    is_admitted: bool
    tick_ms: float

    @property
    def awaited(self) -> list[str]:
        """What must arrive before the behavior starts: targets, or "any"."""

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

    def acknowledge(self, *, lines: int | None = None, time_ns: int | None = None) -> None:
        """Note that the robot has read so many command lines, or the commands up to a time.

        Raises:
            FrameError: They were not sent.
        """

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

    def encode_notice(self, text: str) -> bytes:
        """Write what the robot should know and what is no fault of one of its lines."""


class JxiDialect:
    """Lines of JXI: `TARGET:p1,p2,…`; those of the protocol are no sensors."""

    def __init__(self) -> None:
        self._request = JoinRequest()
        self._has_joined = False
        self._time_ns: int | None = None

    def handle(self, line: bytes, client: Client) -> None:
        target, raw = decode_jxi(line)
        if target == "TOKEN":
            client.admit(_text(raw))
        elif not client.is_admitted:
            raise RefusedError("this server needs a token; send TOKEN:… first")
        elif target in ("TEAM", "PACE", "ROBOT"):
            self._introduce(target, split_parameters(raw), client)
        elif target == "TIME":
            self._time_ns = _read_time("TIME", _number(_text(raw)))
        elif target == "ACK":
            client.acknowledge(lines=_read_count(raw))
        else:
            self._join(client)
            if target == "BEHAVIOR":
                client.select(_text(raw))
            else:
                client.receive(target, raw, self._time_ns)

    def _introduce(self, target: str, parameters: list[str], client: Client) -> None:
        """Take a line that says how the robot joins; the name is the last of them."""
        if self._has_joined:
            raise FrameError(f"the robot has already joined; send {target} before the behavior and the first sensor")
        if target == "PACE":
            self._request = replace(self._request, pace=_read_jxi_pace(parameters))
        elif target == "TEAM":
            self._request = replace(self._request, **_read_jxi_team(parameters))
        else:
            self._request = replace(self._request, name=parameters[0] if parameters else "")
            self._join(client)

    def _join(self, client: Client) -> None:
        if not self._has_joined:
            client.join(self._request)
            self._has_joined = True

    def encode_commands(self, commands: Mapping[str, tuple[Any, ...]], _more: Mapping[str, Any]) -> bytes:
        return b"".join(encode_jxi(target, parameters) for target, parameters in commands.items())

    def encode_error(self, text: str) -> bytes:
        return f"ERROR: {' '.join(text.split())}\n".encode(errors="replace")

    def encode_notice(self, text: str) -> bytes:
        return f"NOTICE: {' '.join(text.split())}\n".encode(errors="replace")


class JsonDialect:
    """JSON lines: first a `hello`, then objects of targets, with `time` and `tick`."""

    def __init__(self) -> None:
        self._has_joined = False

    def handle(self, line: bytes, client: Client) -> None:
        message = decode_json(line)
        if not self._has_joined:
            self._greet(message.pop("hello", {}), client)
        time_ns, tick_ns = _take_time(message, "time"), _take_time(message, "tick")
        if (ack_ns := _take_time(message, "ack")) is not None:
            client.acknowledge(time_ns=ack_ns)
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
        welcome = {"robot": robot, "behavior": behavior, "tick_ms": client.tick_ms}
        if hello.get("pace") != "client":
            welcome["waits_for"] = client.awaited
        client.send(encode_json({"welcome": welcome}))

    def encode_commands(self, commands: Mapping[str, tuple[Any, ...]], more: Mapping[str, Any], /) -> bytes:
        return encode_json({**more, "commands": commands})

    def encode_error(self, text: str) -> bytes:
        return encode_json({"error": text})

    def encode_notice(self, text: str) -> bytes:
        return encode_json({"notice": text})


def _text(raw: bytes) -> str:
    parameters = split_parameters(raw)
    return parameters[0] if parameters else ""


def _read_jxi_pace(parameters: list[str]) -> Pace:
    if parameters == ["message"]:
        return "message"
    if parameters == ["clock"]:
        return "clock"
    raise FrameError(f"PACE is {_show(','.join(parameters))}, expected clock or message")


def _read_jxi_team(parameters: list[str]) -> dict[str, Any]:
    """The team, and the priority in it if there is one."""
    team, *rest = parameters or [""]
    if not rest:
        return {"team": team}
    number = rest[0].removeprefix("-")
    if len(rest) > 1 or not (number.isascii() and number.isdigit()) or len(number) > _PRIORITY_DIGITS:
        raise FrameError(f"TEAM is {_show(','.join(parameters))}, expected a name, or a name and a priority")
    return {"team": team, "priority": int(rest[0])}


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _read_count(raw: bytes) -> int:
    text = _text(raw)
    if not (text.isascii() and text.isdigit() and len(text) <= _MOST_DIGITS):
        raise FrameError(f"ACK is {_show(text)}, expected the number of command lines that were read")
    return int(text)


def _get(hello: dict[str, Any], key: str) -> str:
    value = hello.get(key, "")
    if not isinstance(value, str):
        raise RefusedError(f"hello: {key} is {_show(value)}, expected a text")
    return value


def _read_hello(hello: dict[str, Any]) -> JoinRequest:
    pace, priority = _get(hello, "pace") or "clock", hello.get("priority")
    if pace not in get_args(Pace):
        raise RefusedError(f"hello: pace is {_show(pace)}, expected {' or '.join(get_args(Pace))}")
    if priority is not None and (type(priority) is not int or abs(priority) > _GREATEST_PRIORITY):
        raise RefusedError(f"hello: priority is {_show(priority)}, expected an integer")
    return JoinRequest(
        name=_get(hello, "robot"),
        pace=cast("Pace", pace),
        sends_state=hello.get("state") is True,
        team=_get(hello, "team"),
        priority=priority,
        waits=hello.get("wait") is not False,
    )


def _show(value: object) -> str:
    return show_bytes(
        value.encode(errors="replace") if isinstance(value, str) else repr(value).encode(errors="replace")
    )


def _take_time(message: dict[str, Any], key: str) -> int | None:
    """Remove a time in seconds from a message; return it in nanoseconds."""
    if key not in message:
        return None
    return _read_time(key, message.pop(key))


def _read_time(key: str, seconds: Any) -> int:
    """Return a time in seconds in nanoseconds."""
    if isinstance(seconds, bool) or not isinstance(seconds, int | float):
        raise FrameError(f"{key} is {_show(seconds)}, expected seconds")
    # Also false if it is not a number; an int may have more digits than a float.
    if not abs(seconds) <= _LATEST_S:
        raise FrameError(f"{key} is not a number of seconds up to {_LATEST_S:g}")
    return round(seconds * _NS_PER_S)
