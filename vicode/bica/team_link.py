"""Exchanges the messages and shared values of the robots of a team."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any
from zlib import crc32

from .errors import print_error
from .net_values import convert, decode, encode
from .team import StateKey, TeamMessage

if TYPE_CHECKING:
    from .base_root import BaseRoot
    from .net_session import NetSession

ANSWER_TICKS = 4
"""Iterations until the others have answered, if they iterate as often as this robot."""
MAX_MESSAGE_AGE_S = 1.0
START_S = 1.0
"""So long a robot that has just connected enters no cooperative state, because it may not have heard the others yet."""
_NEVER = 2**62
_MAX_ROBOTS, _MAX_STATES, _MAX_TEXT = 64, 64, 200
_MAX_PRIORITY = 2**53


class TeamRobot:
    """Another robot of the team: its shared values as attributes, which it keeps when it ends.

    Attributes:
        values: The values by name; `robot.x` is `robot.values["x"]`.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.values: dict[str, Any] = {}
        self.is_connected = False
        self._message = TeamMessage()
        self._received_s = -float("inf")

    def __getattr__(self, name: str) -> Any:
        """Return a shared value.

        Raises:
            AttributeError: The robot has not sent it.
        """
        values: Mapping[str, Any] = self.__dict__.get("values", {})
        if name in values:
            return values[name]
        raise AttributeError(f"robot {self.__dict__.get('name')} has not shared '{name}'")

    @property
    def data_age(self) -> float:
        """Seconds since the newest message was received."""
        return time.monotonic() - self._received_s

    @property
    def is_alive(self) -> bool:
        """Whether the program of the robot runs and has sent a message in the last second."""
        return self.is_connected and self.data_age <= MAX_MESSAGE_AGE_S


class TeamLink:
    """The team of one root: `hear` before each iteration, `tell` after it."""

    def __init__(self, root: BaseRoot, session: NetSession, name: str, team: str, fields: Sequence[str]) -> None:
        self.robots: dict[str, TeamRobot] = {}
        self._root, self._name, self._fields = root, name, tuple(fields)
        self._sender = session.sender(f"vicode/{name}/team/{team}")
        self._receiver = session.receive(f"vicode/*/team/{team}")
        self._alive = session.watch_alive("vicode/*/alive/*")
        self._reported: set[str] = set()
        # Robots with equal priority yield to each other.
        root.team.priority = root.team.priority or crc32(name.encode()) + 1
        self._ticks = root.team.ticks or ANSWER_TICKS
        root.team.ticks = _NEVER
        self._start_s = time.monotonic()

    def hear(self) -> None:
        """Read the newest message of each robot; those of robots that have ended no longer count."""
        newest = {}
        for key, payload in self._receiver.take_all():
            newest[key.split("/")[1]] = payload
        for name, payload in newest.items():
            if name != self._name:
                self._read(name, payload)
        if self._root.team.ticks == _NEVER and time.monotonic() - self._start_s >= START_S:
            self._root.team.ticks = self._ticks
        self._root.team.prepare()
        connected = {key.split("/")[1] for key in self._alive.read()}
        for robot in self.robots.values():
            robot.is_connected = robot.name in connected
            if robot.is_alive:
                self._root.team.hear(robot._message)

    def tell(self) -> None:
        message = self._root.team.tell()
        world = self._root.world
        self._sender.put(
            encode(
                {
                    "fields": {name: getattr(world, name) for name in self._fields if hasattr(world, name)},
                    "priority": message.priority,
                    "executed": message.executed,
                    "entering": message.entering,
                    "near": message.near,
                }
            )
        )

    def close(self) -> None:
        self._receiver.close()

    def _read(self, name: str, payload: bytes) -> None:
        try:
            plain = decode(payload)
            message = _decode_team_message(plain)
            values = self._convert_fields(plain["fields"])
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            self._report(name, f"sends a wrong message: {error}")
            return
        robot = self.robots.get(name)
        if robot is None:
            if len(self.robots) >= _MAX_ROBOTS:
                return
            robot = self.robots[name] = TeamRobot(name)
        robot.values.update(values)
        robot._message, robot._received_s = message, time.monotonic()

    def _convert_fields(self, plain: Mapping[str, object]) -> dict[str, Any]:
        """Convert values to the types that the world of this robot has for them; others are ignored."""
        values = {}
        for name, value in plain.items():
            own = getattr(self._root.world, name, None) if name in self._fields else None
            if own is not None:
                is_float = isinstance(value, float) and type(own) is int
                values[name] = convert(value, 0.0 if is_float else own)
        return values

    def _report(self, name: str, message: str) -> None:
        if name not in self._reported and len(self._reported) < _MAX_ROBOTS:
            self._reported.add(name)
            print_error(f"robot {name} of the team {message} (reported once)", kind="warning")


def _decode_team_message(plain: Mapping[str, Any]) -> TeamMessage:
    priority = plain["priority"]
    if type(priority) is not int or abs(priority) > _MAX_PRIORITY:
        raise ValueError("priority is no int")
    states = {name: _decode_states(plain[name]) for name in ("executed", "entering", "near")}
    return TeamMessage(priority, **states)


def _decode_states(plain: object) -> tuple[StateKey, ...]:
    if not isinstance(plain, list) or len(plain) > _MAX_STATES:
        raise ValueError("no list of states")
    return tuple(_decode_state(pair) for pair in plain)


def _decode_state(pair: object) -> StateKey:
    if not (isinstance(pair, list) and len(pair) == 2 and all(isinstance(text, str) for text in pair)):
        raise ValueError("no component and state")
    return pair[0][:_MAX_TEXT], pair[1][:_MAX_TEXT]
