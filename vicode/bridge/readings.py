"""What a robot has sent: the newest value of each sensor, and the queue of events."""

import math
from collections import deque
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from vicode.bridge.declarations import Event, Sensor
from vicode.bridge.frames import FrameError
from vicode.bridge.parameters import Raw

if TYPE_CHECKING:
    from vicode.bridge.world import Counts

MAX_EVENTS = 64
_NEVER_NS = -(1 << 62)


class _Reading:
    """The newest value of a sensor: `raw` until it is read."""

    __slots__ = ("initial", "raw", "raw_ns", "value", "value_ns")

    def __init__(self, sensor: Sensor) -> None:
        self.raw: Raw | None = None
        self.raw_ns = self.value_ns = _NEVER_NS
        self.value: Any = sensor.initial
        self.initial = self.value


class Readings:
    """The newest value of each sensor; a value is converted when it is read, once."""

    __slots__ = ("_by_target", "_counts", "_now_ns", "_oldest_ns", "problems")

    def __init__(self, sensors: Iterable[Sensor], counts: "Counts") -> None:
        self._by_target = {sensor.target: _Reading(sensor) for sensor in sensors}
        self._counts = counts
        self._now_ns = 0
        self._oldest_ns: int | None = None
        self.problems: list[str] = []

    def put(self, target: str, raw: Raw, at_ns: int) -> bool:
        """Replace the value of a sensor; return whether there is such a sensor."""
        reading = self._by_target.get(target)
        if reading is None:
            return False
        if reading.raw is not None:
            self._counts.dropped += 1
        reading.raw, reading.raw_ns = raw, at_ns
        return True

    def begin_tick(self, now_ns: int) -> None:
        self._now_ns, self._oldest_ns = now_ns, None

    @property
    def age_ns(self) -> int | None:
        """The age of the oldest value that was read in this tick and not stale; None if none was read."""
        return None if self._oldest_ns is None else max(0, self._now_ns - self._oldest_ns)

    def read(self, sensor: Sensor) -> Any:
        """The value of a sensor, that of `initial` before the first line and if it is stale."""
        reading = self._newest(sensor)
        value_ns = reading.value_ns
        if value_ns == _NEVER_NS or self._now_ns - value_ns > sensor.max_age_ns:
            return reading.initial
        if self._oldest_ns is None or value_ns < self._oldest_ns:
            self._oldest_ns = value_ns
        return reading.value

    def age_s(self, sensor: Sensor) -> float:
        """Seconds since the value of a sensor was sent; infinite before the first line."""
        value_ns = self._newest(sensor).value_ns
        return math.inf if value_ns == _NEVER_NS else max(0, self._now_ns - value_ns) / 1e9

    def is_stale(self, sensor: Sensor) -> bool:
        value_ns = self._newest(sensor).value_ns
        return value_ns == _NEVER_NS or self._now_ns - value_ns > sensor.max_age_ns

    def _newest(self, sensor: Sensor) -> _Reading:
        reading = self._by_target[sensor.target]
        raw = reading.raw
        if raw is not None:
            reading.raw = None
            self._counts.late += self._now_ns - reading.raw_ns > sensor.max_age_ns
            try:
                reading.value, reading.value_ns = sensor.parameters.convert(raw), reading.raw_ns
            except FrameError as error:
                # The value before it stays, and ages.
                self._counts.malformed += 1
                self.problems.append(f"{sensor.target}: {error}")
        return reading


class EventQueue:
    """Events in the order of their arrival; each is visible in one tick, at most one of each target."""

    __slots__ = ("_by_target", "_counts", "_queue", "_visible", "problems")

    def __init__(self, events: Iterable[Event], counts: "Counts") -> None:
        self._by_target = {event.target: event for event in events}
        self._counts = counts
        self._queue: deque[tuple[Event, Raw]] = deque()
        self._visible: dict[str, Any] = {}
        self.problems: list[str] = []

    def put(self, target: str, raw: Raw) -> bool:
        """Append an event, and drop the oldest if there are too many; return whether it is declared."""
        event = self._by_target.get(target)
        if event is None:
            return False
        if len(self._queue) >= MAX_EVENTS:
            self._queue.popleft()
            self._counts.events_dropped += 1
        self._queue.append((event, raw))
        return True

    def begin_tick(self) -> None:
        """Make the next events visible, up to the second one of a target."""
        visible: dict[str, Any] = {}
        while self._queue and self._queue[0][0].target not in visible:
            event, raw = self._queue.popleft()
            try:
                visible[event.target] = event.parameters.convert(raw) if event.has_value else True
            except FrameError as error:
                self._counts.malformed += 1
                self.problems.append(f"{event.target}: {error}")
        self._visible = visible

    def read(self, event: Event) -> Any:
        return self._visible.get(event.target, event.initial)
