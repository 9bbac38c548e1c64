"""What a robot has sent: its sensors, folded between ticks, and the queue of events."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from vicode.bridge.declarations import Event, Sensor
from vicode.bridge.frames import FrameError
from vicode.bridge.notices import Notices
from vicode.bridge.parameters import Raw

if TYPE_CHECKING:
    from vicode.bridge.world import Counts

MAX_EVENTS = 64
MAX_KEPT = 1024
"""So many values of a sensor or event with fold="all" are kept for a tick."""
_NEVER_NS = -(1 << 62)
_COMBINE: Mapping[str, Callable[[Any, Any], Any]] = {
    "sum": lambda before, value: before + value,
    "minimum": min,
    "maximum": max,
}


class _Reading:
    """The value of a sensor.

    Attributes:
        raw: The newest value until it is read; only if that is what counts.
        kept: The parameters of the values since the last tick, if they are folded: one list of the folded ones, or all.
    """

    __slots__ = ("initial", "kept", "raw", "raw_ns", "sensor", "value", "value_ns")

    def __init__(self, sensor: Sensor) -> None:
        self.sensor = sensor
        self.raw: Raw | None = None
        self.kept: deque[list[Any]] = deque(maxlen=MAX_KEPT if sensor.fold == "all" else 1)
        self.raw_ns = self.value_ns = _NEVER_NS
        self.value: Any = sensor.initial
        self.initial = self.value

    def fold(self, values: list[Any]) -> bool:
        """Add a value to those since the last tick; return whether another one was dropped for it."""
        combine = _COMBINE.get(self.sensor.fold)
        if combine is not None and self.kept:
            values = list(map(combine, self.kept[0], values))
        is_full = combine is None and len(self.kept) == MAX_KEPT
        self.kept.append(values)
        return is_full

    def begin_tick(self) -> None:
        """Let the tick see what was folded since the last one."""
        kept, shape, fold = self.kept, self.sensor.parameters.shape, self.sensor.fold
        if fold == "all":
            self.value = tuple(map(shape, kept))
        elif kept:
            self.value = shape(kept[0])
        elif fold == "sum":
            self.value = self.sensor.parameters.default()
        kept.clear()


class Readings:
    """The values of all sensors. The newest one is converted when it is read, once; folded ones when they arrive."""

    __slots__ = ("_by_target", "_counts", "_folded", "_notices", "_now_ns", "_oldest_ns", "_watched", "problems")

    def __init__(self, sensors: Iterable[Sensor], counts: "Counts", notices: Notices) -> None:
        self._by_target = {sensor.target: _Reading(sensor) for sensor in sensors}
        self._folded = [each for each in self._by_target.values() if each.sensor.fold != "newest"]
        self._watched = [
            each for each in self._by_target.values() if each.sensor.watchdog and each.sensor.max_age_ns != math.inf
        ]
        self._counts, self._notices = counts, notices
        self._now_ns = 0
        self._oldest_ns: int | None = None
        self.problems: list[str] = []

    def put(self, target: str, raw: Raw, at_ns: int) -> bool:
        """Take a value of a sensor; return whether there is such a sensor."""
        reading = self._by_target.get(target)
        if reading is None:
            return False
        if reading.sensor.fold != "newest":
            self._fold(reading, raw, at_ns)
            return True
        if reading.raw is not None:
            self._counts.dropped += 1
        reading.raw, reading.raw_ns = raw, at_ns
        return True

    def begin_tick(self, now_ns: int) -> None:
        self._now_ns, self._oldest_ns = now_ns, None
        for reading in self._folded:
            reading.begin_tick()

    @property
    def age_ns(self) -> int | None:
        """The age of the oldest value that was read in this tick and not stale; None if none was read."""
        return None if self._oldest_ns is None else max(0, self._now_ns - self._oldest_ns)

    @property
    def awaited(self) -> list[str]:
        """Targets of required sensors of which nothing has arrived."""
        readings = self._by_target.items()
        return [target for target, each in readings if each.sensor.required and each.raw_ns == _NEVER_NS]

    @property
    def stale(self) -> list[Sensor]:
        """Sensors of the watchdog whose value is too old, of those that have sent one or are required."""
        return [
            each.sensor
            for each in self._watched
            if (each.raw_ns != _NEVER_NS or each.sensor.required) and self._is_old(each)
        ]

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

    def _is_old(self, reading: _Reading) -> bool:
        """Whether a value is stale; converts a new one only if the one before does not answer that."""
        if self._now_ns - reading.value_ns <= reading.sensor.max_age_ns:
            return False
        return self.is_stale(reading.sensor)

    def _fold(self, reading: _Reading, raw: Raw, at_ns: int) -> None:
        reading.raw_ns = at_ns
        try:
            values = reading.sensor.parameters.parse(raw)
        except FrameError as error:
            self._complain(reading.sensor, error)
            return
        reading.value_ns = max(reading.value_ns, at_ns)
        if reading.fold(values):
            self._counts.events_dropped += 1
            self._notices.add(f"{reading.sensor.target}: a value was dropped; {MAX_KEPT} are kept for a tick")

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
                self._complain(sensor, error)
        return reading

    def _complain(self, sensor: Sensor, error: FrameError) -> None:
        self._counts.malformed += 1
        self.problems.append(f"{sensor.target}: {error}")


class EventQueue:
    """Events in the order of their arrival; each is visible in one tick, at most one of each target, or all of them."""

    __slots__ = ("_by_target", "_counts", "_kept", "_notices", "_queue", "_visible", "problems")

    def __init__(self, events: Iterable[Event], counts: "Counts", notices: Notices) -> None:
        self._by_target = {event.target: event for event in events}
        self._counts, self._notices = counts, notices
        self._queue: deque[tuple[Event, Raw]] = deque()
        self._kept: dict[str, deque[Raw]] = {
            target: deque(maxlen=MAX_KEPT) for target, event in self._by_target.items() if event.reads_all
        }
        self._visible: dict[str, Any] = {}
        self.problems: list[str] = []

    def put(self, target: str, raw: Raw) -> bool:
        """Append an event, and drop the oldest if there are too many; return whether it is declared."""
        event = self._by_target.get(target)
        if event is None:
            return False
        if event.reads_all:
            if len(self._kept[target]) == MAX_KEPT:
                self._drop(f"{target}: an event was dropped; {MAX_KEPT} are kept for a tick")
            self._kept[target].append(raw)
            return True
        if len(self._queue) >= MAX_EVENTS:
            oldest = self._queue.popleft()[0].target
            self._drop(
                f"{oldest}: an event was dropped: a tick reads one per target, and {MAX_EVENTS} wait; "
                f'send fewer, or declare fold="all"'
            )
        self._queue.append((event, raw))
        return True

    def begin_tick(self) -> None:
        """Make the next events visible, up to the second one of a target, and all of those with `reads_all`."""
        visible: dict[str, Any] = {}
        while self._queue and self._queue[0][0].target not in visible:
            event, raw = self._queue.popleft()
            for value in self._convert(event, [raw]):
                visible[event.target] = value
        for target, kept in self._kept.items():
            event = self._by_target[target]
            values = self._convert(event, kept)
            visible[target] = tuple(values) if event.has_value else len(values)
            kept.clear()
        self._visible = visible

    def read(self, event: Event) -> Any:
        return self._visible.get(event.target, event.initial)

    def _convert(self, event: Event, raws: Iterable[Raw]) -> list[Any]:
        """The values of events; those that are malformed are left out."""
        values = []
        for raw in raws:
            try:
                values.append(event.parameters.convert(raw) if event.has_value else True)
            except FrameError as error:
                self._counts.malformed += 1
                self.problems.append(f"{event.target}: {error}")
        return values

    def _drop(self, notice: str) -> None:
        self._counts.events_dropped += 1
        self._notices.add(notice)
