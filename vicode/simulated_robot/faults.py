"""Faults of a robot in real time: it reads or sends slowly, loses a sensor, or delays its messages. No I/O."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random

Sensors = Mapping[str, Sequence[float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """A fault of a robot.

    Attributes:
        name: Its name on pages.
        doc: What happens.
        read_pause_s: So long the robot waits after each message that it reads.
        period_s: The least time between two messages that it sends.
        lost: A sensor that it does not send for a while.
        lost_s: From when to when, in seconds of the run.
        jitter_s: Messages arrive up to so late, in their order.
    """

    name: str
    doc: str
    read_pause_s: float = 0.0
    period_s: float = 0.0
    lost: str = ""
    lost_s: tuple[float, float] = (0.0, 0.0)
    jitter_s: float = 0.0


NO_FAULT = Fault(name="none", doc="The robot reads at once and sends 200 messages per second.")
FAULTS = (
    NO_FAULT,
    Fault(name="slow reader", doc="It reads one message per 100 ms.", read_pause_s=0.1),
    Fault(name="slow sender", doc="It sends one message per 400 ms.", period_s=0.4),
    Fault(name="lost sensor", doc="It sends no laser from 5 to 8 s.", lost="LASER", lost_s=(5.0, 8.0)),
    Fault(name="jitter", doc="Its messages arrive 0 to 200 ms late.", jitter_s=0.2),
)


class FaultySender:
    """Decides which messages of a robot are sent, and when.

    Args:
        fault: What is wrong.
        seed: Of the jitter.
    """

    def __init__(self, fault: Fault, seed: int = 1) -> None:
        self._fault, self._random = fault, Random(seed)
        self._waiting: deque[tuple[float, float, Sensors]] = deque()
        self._next_s = self._due_s = float("-inf")

    def put(self, now_s: float, sensors: Sensors) -> None:
        """Take what the robot measures now."""
        fault = self._fault
        if now_s < self._next_s:
            return
        self._next_s = now_s + fault.period_s
        if fault.lost and fault.lost_s[0] <= now_s < fault.lost_s[1]:
            sensors = {target: values for target, values in sensors.items() if target != fault.lost}
        self._due_s = max(self._due_s, now_s + self._random.uniform(0.0, fault.jitter_s))
        self._waiting.append((self._due_s, now_s, sensors))

    def take(self, now_s: float) -> list[tuple[float, Sensors]]:
        """The messages to send now, each with the time at which it was measured."""
        messages = []
        while self._waiting and self._waiting[0][0] <= now_s:
            _due_s, measured_s, sensors = self._waiting.popleft()
            messages.append((measured_s, sensors))
        return messages
