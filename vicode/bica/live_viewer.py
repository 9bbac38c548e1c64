"""A connection of the live server. What it may send is limited: the thread that reads it takes time of the robot."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import socket

    from .live_feed import Feed

MAX_LINE_BYTES = 65_536
DEFAULT_RATE_HZ = 30.0
LINES_PER_S, MAX_LINES_AT_ONCE = 100.0, 100
"""Python threads take turns: a viewer that sends more lines would delay the iterations of the robot."""
FLOOD_S = 5.0
"""A viewer that sends more than it may for so long is disconnected."""
_BYTES_PER_S = 32_768.0
_RECEIVED_BYTES = 4_096
_LINES_PER_TURN = 8


class FloodError(ConnectionAbortedError):
    """A viewer sent more than it may for too long."""


class Allowance:
    """An amount that grows with time, up to a limit.

    Args:
        per_s: How much is added per second.
        most: The limit, and the amount at first.
    """

    __slots__ = ("_at_s", "_left", "_most", "_per_s")

    def __init__(self, per_s: float, most: float) -> None:
        self._per_s, self._most, self._left, self._at_s = per_s, most, most, time.monotonic()

    def use(self, amount: float) -> None:
        """Use an amount, also more than is left."""
        self._left -= amount

    def wait_s(self, now_s: float) -> float:
        """Seconds until at least 1 is left; 0 if it is."""
        self._left = min(self._most, self._left + (now_s - self._at_s) * self._per_s)
        self._at_s = now_s
        return max(0.0, (1.0 - self._left) / self._per_s)


class Viewer:
    """A connection; `seen` are the numbers of the last message, iteration and state change sent, by robot.

    `focus` is the robot that it looks at; others are sent less often. Until `resume_s`, nothing is received.
    """

    __slots__ = (
        "_bytes",
        "_has_received_all",
        "_limited_since_s",
        "_lines",
        "_received",
        "connected_s",
        "connection",
        "due_s",
        "focus",
        "greeted",
        "has_control",
        "is_admitted",
        "period_s",
        "rest_due_s",
        "resume_s",
        "seen",
        "unsent",
    )

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self.connected_s = time.monotonic()
        self.unsent, self._received = bytearray(), bytearray()
        self.is_admitted = self.has_control = False
        self.period_s = 1 / DEFAULT_RATE_HZ
        self.due_s = self.rest_due_s = 0.0
        self.focus = ""
        self.greeted: list[tuple[Feed, int]] = []
        self.seen: dict[Feed, tuple[int, int, int]] = {}
        self.resume_s: float | None = None
        self._limited_since_s: float | None = None
        self._has_received_all = True
        self._lines = Allowance(LINES_PER_S, MAX_LINES_AT_ONCE)
        self._bytes = Allowance(_BYTES_PER_S, MAX_LINE_BYTES + _RECEIVED_BYTES)

    def looks_at(self, feed: Feed) -> bool:
        return not self.focus or feed.name == self.focus

    def receive(self) -> None:
        """Receive some bytes.

        Raises:
            OSError: The connection has ended.
            ValueError: The line is too long.
        """
        data = self.connection.recv(_RECEIVED_BYTES)
        if not data:
            raise ConnectionResetError
        self._has_received_all = len(data) < _RECEIVED_BYTES
        self._bytes.use(len(data))
        self._received += data
        if len(self._received) > MAX_LINE_BYTES and b"\n" not in self._received:
            raise ValueError("the line is too long")

    def take_lines(self) -> list[bytes]:
        """The lines that may be handled now; sets `resume_s`, after which to call it again.

        Raises:
            FloodError: The viewer has sent more than it may for too long.
        """
        now_s, lines = time.monotonic(), list[bytes]()
        while len(lines) < _LINES_PER_TURN and not self._lines.wait_s(now_s):
            end = self._received.find(b"\n")
            if end < 0:
                break
            lines.append(bytes(self._received[:end]))
            del self._received[: end + 1]
            self._lines.use(1)
        waiting_s = self._bytes.wait_s(now_s)
        has_more = b"\n" in self._received
        if has_more:
            waiting_s = max(waiting_s, self._lines.wait_s(now_s))
        self.resume_s = now_s + waiting_s if has_more or waiting_s else None
        if self.resume_s is None and self._has_received_all:
            self._limited_since_s = None
        elif waiting_s and self._limited_since_s is None:
            self._limited_since_s = now_s
        if self._limited_since_s is not None and now_s - self._limited_since_s > FLOOD_S:
            raise FloodError
        return lines
