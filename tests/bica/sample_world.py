"""A world for the tests of the run command: an approaching ball, observed with noise from a seed."""

from __future__ import annotations

import random


class World:
    """The run ends some time after the ball has passed."""

    def __init__(self, *, seed: int) -> None:
        self._random = random.Random(seed)
        self.ball_seen = False
        self.ball_distance = float("inf")
        self.fallen = False
        self.finished = False
        self.log: list[str] = []

    def advance(self, now_ns: int) -> None:
        self.ball_distance = 6000 - now_ns / 1e6 + self._random.uniform(-50, 50)
        self.ball_seen = self._random.random() < 0.9
        self.finished = self.ball_distance < -1000

    def snapshot(self) -> dict[str, object]:
        return {"ball_distance": self.ball_distance, "unknown": float("nan")}

    def summary(self) -> dict[str, object]:
        return {"acts": self.log.count("act")}
