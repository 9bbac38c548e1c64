"""Team messages: each arrives after 0.1 or 0.2 s, or not at all."""

from dataclasses import dataclass
from random import Random

from vicode.bica import TeamMessage

LOST = 0.1
"""The part of the messages that is lost."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Packet:
    """The message of a robot about its states, and values that it shares; all in the view of its team."""

    sender: int
    sent_s: float
    states: TeamMessage
    x: float
    y: float
    ball: complex
    ball_distance: float
    ball_age: float


class Radio:
    """The channel of a team, by number of the robots."""

    def __init__(self, seed: str, robots: int) -> None:
        self._noise = Random(seed)
        self._inboxes: dict[int, list[tuple[float, Packet]]] = {number: [] for number in range(1, robots + 1)}

    def send(self, packet: Packet) -> None:
        for number, inbox in self._inboxes.items():
            lost, late = self._noise.random() < LOST, self._noise.random() < 0.5
            if number != packet.sender and not lost:
                inbox.append((packet.sent_s + (0.2 if late else 0.1), packet))

    def receive(self, number: int, now_s: float) -> list[Packet]:
        """Take the packets that have arrived."""
        inbox = self._inboxes[number]
        arrived = [packet for due_s, packet in inbox if due_s <= now_s + 1e-6]
        self._inboxes[number] = [each for each in inbox if each[0] > now_s + 1e-6]
        return arrived
