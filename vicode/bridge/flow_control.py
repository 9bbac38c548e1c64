"""Flow control of commands: when the next ones may be sent, and how old the obeyed ones are. No I/O.

What was sent once lies in buffers of the system and of the robot's program, where nothing can replace it. A line that
the robot sends does not prove that it has read anything: its sensors may have a thread of their own. So the next
commands wait until the robot has acknowledged those before; a robot that acknowledges nothing gets them at a low rate.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from vicode.bridge.frames import FrameError

DEFAULT_COMMAND_RATE_HZ = 4.0
_KEPT = 64
"""So many unacknowledged messages are remembered; a robot that never acknowledges leaves all of them."""
_NS_PER_MS = 1_000_000
_LONG_NS = 1_000_000_000


@dataclass(frozen=True, slots=True)
class _Sent:
    """A message of commands.

    Attributes:
        lines: The number of command lines with this message, since the connection began.
        time_ms: When the commands were computed, in milliseconds since then.
        made_ns: The same on the clock of the bridge.
    """

    lines: int
    time_ms: int
    made_ns: int


class FlowControl:
    """The commands on their way to one robot.

    Args:
        now_ns: When the connection began, on any clock that never goes back; further times are of the same clock.
        rate_hz: How many lines per second a robot gets that acknowledges nothing.
    """

    __slots__ = (
        "_begin_ns",
        "_due_ns",
        "_lines",
        "_newest",
        "_obeyed_ns",
        "_period_ns",
        "_waiting",
        "is_acknowledging",
    )

    def __init__(self, now_ns: int, rate_hz: float = DEFAULT_COMMAND_RATE_HZ) -> None:
        self._begin_ns, self._period_ns = now_ns, round(1e9 / rate_hz)
        self._waiting: deque[_Sent] = deque(maxlen=_KEPT)
        self._newest: _Sent | None = None
        self._lines = 0
        self.is_acknowledging = False
        """Whether the robot has ever acknowledged commands, or said with 0 that it will."""
        self._due_ns = now_ns
        self._obeyed_ns: int | None = None

    def may_send(self, now_ns: int) -> bool:
        if self.is_acknowledging:
            return not self._waiting
        return now_ns >= self._due_ns

    def add(self, lines: int, made_ns: int, now_ns: int) -> float:
        """Note a message of so many lines that is sent now; return its time in seconds, which acknowledges it."""
        self._lines += lines
        self._due_ns = now_ns + lines * self._period_ns
        # Commands may be from before the connection, of a robot that has connected again.
        time_ms = max(0, round((made_ns - self._begin_ns) / _NS_PER_MS))
        self._newest = _Sent(self._lines, time_ms, made_ns)
        self._waiting.append(self._newest)
        return time_ms / 1000

    def acknowledge_lines(self, lines: int, now_ns: int) -> int | None:
        """The robot has read so many command lines since the connection began.

        Returns:
            The age of the newest of these commands in ns; None if they were acknowledged before.

        Raises:
            FrameError: Not so many were sent.
        """
        if not 0 <= lines <= self._lines:
            raise FrameError(f"ACK says {lines} command lines were read, but {self._lines} were sent")
        return self._acknowledge(lambda sent: sent.lines <= lines, now_ns)

    def acknowledge_time(self, time_ns: int, now_ns: int) -> int | None:
        """The robot has read the commands up to those with this time.

        Returns:
            The age of the newest of these commands in ns; None if they were acknowledged before.

        Raises:
            FrameError: The newest ones are older.
        """
        time_ms = round(time_ns / _NS_PER_MS)
        if time_ms > (self._newest.time_ms if self._newest else 0):
            raise FrameError(f"ack is {time_ms / 1000:g}, but {_describe_newest(self._newest)}")
        return self._acknowledge(lambda sent: sent.time_ms <= time_ms, now_ns)

    def age_ns(self, now_ns: int) -> int | None:
        """The age of the commands that the robot obeys: at least that of those which it has not acknowledged yet.

        None for a robot that has acknowledged nothing.
        """
        if not self.is_acknowledging:
            return None
        return max(self._pending_ns(now_ns), self._obeyed_ns or 0)

    def is_overdue(self, now_ns: int) -> bool:
        """Whether a robot that acknowledges commands has not done so for long."""
        return self.is_acknowledging and self._pending_ns(now_ns) > _LONG_NS

    def _pending_ns(self, now_ns: int) -> int:
        """The age of the oldest commands that are not acknowledged."""
        return now_ns - self._waiting[0].made_ns if self._waiting else 0

    def _acknowledge(self, is_read: Callable[[_Sent], bool], now_ns: int) -> int | None:
        self.is_acknowledging, newest = True, None
        while self._waiting and is_read(self._waiting[0]):
            newest = self._waiting.popleft()
        if newest is None:
            return None
        self._obeyed_ns = max(0, now_ns - newest.made_ns)
        return self._obeyed_ns


def _describe_newest(newest: _Sent | None) -> str:
    return f"the newest commands have the time {newest.time_ms / 1000:g}" if newest else "no commands were sent"
