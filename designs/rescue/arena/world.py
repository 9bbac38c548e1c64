"""A corridor with bends and a disc-shaped robot with a differential drive and a laser scanner."""

import math
from itertools import pairwise
from random import Random

RADIUS_M = 0.25
FARTHEST_M = 20.0
REGIONS = ("wnw", "nw", "nnw", "n", "nne", "ne", "ene")
"""Seven equal sectors of the half circle ahead, from left to right."""

# Corners of the left and right wall in metres; the corridor starts at (0, 0).
_LEFT = ((-1.0, 1.0), (5.0, 1.0), (5.0, 6.0), (12.0, 6.0))
_RIGHT = ((-1.0, -1.0), (7.0, -1.0), (7.0, 4.0), (12.0, 4.0))
_GOAL_X = 11.0
_RAYS = 9
_STEP_S = 0.02

Point = tuple[float, float]
Wall = tuple[Point, Point]


class Corridor:
    """The world; the seed determines the start pose of the robot.

    Attributes:
        x, y: Position of the robot in m.
        heading: In degrees, counter-clockwise.
        amount_turned: Sum of absolute turns in degrees.
        bumps: Number of collisions with a wall.
    """

    def __init__(self, seed: int = 1) -> None:
        draw = Random(seed).uniform
        self.x, self.y, self.heading = draw(0.0, 0.5), draw(-0.3, 0.3), draw(-20.0, 20.0)
        self.amount_turned = 0.0
        self.bumps = 0
        self._speed = self._turning_speed = 0.0
        self._now_s = self._free_at_s = 0.0
        self._is_at_wall = False
        left, right = (list(pairwise(side)) for side in (_LEFT, _RIGHT))
        self._walls: list[Wall] = [*left, *right, (_LEFT[0], _RIGHT[0])]

    # Sensors: laser_max, and laser_min_n for each region

    def __getattr__(self, name: str) -> float:
        region = name.removeprefix("laser_min_")
        if region == name or region not in REGIONS:
            raise AttributeError(name)
        width = 180.0 / len(REGIONS)
        first = self.heading + 90.0 - width * REGIONS.index(region)
        return min(self._see(first - width * ray / (_RAYS - 1)) for ray in range(_RAYS))

    @property
    def laser_max(self) -> float:
        """The maximum of the minimum distances in m."""
        return max(self.__getattr__(f"laser_min_{region}") for region in REGIONS)

    # Basic behaviors

    def differential_drive(self, *, speed: float, turning_speed: float) -> None:
        """Drive with `speed` (m/s) and `turning_speed` (degrees/s) until the next command."""
        if self._now_s >= self._free_at_s:
            self._speed, self._turning_speed = speed, turning_speed

    def wait(self, *, time: float) -> None:
        """Ignore commands for `time` seconds."""
        if self._now_s >= self._free_at_s:
            self._free_at_s = self._now_s + time

    # Simulation

    def hold(self) -> None:
        """Stop the motors."""
        self._speed = self._turning_speed = 0.0

    @property
    def finished(self) -> bool:
        """Whether the robot has reached the end of the corridor."""
        return self.x >= _GOAL_X

    def advance(self, now_ns: int) -> None:
        """Simulate until `now_ns`."""
        while self._now_s + _STEP_S <= now_ns / 1e9 + 1e-9:
            self._now_s += _STEP_S
            self._move()

    def snapshot(self) -> dict[str, float]:
        return {"x": round(self.x, 2), "y": round(self.y, 2), "heading": round(self.heading, 1)}

    def summary(self) -> dict[str, object]:
        return {"through": self.finished, "bumps": self.bumps, "turned_deg": round(self.amount_turned)}

    def _move(self) -> None:
        turned = self._turning_speed * _STEP_S
        self.heading = (self.heading + turned + 180.0) % 360.0 - 180.0
        self.amount_turned += abs(turned)
        distance = self._speed * _STEP_S
        x, y = (
            self.x + distance * math.cos(math.radians(self.heading)),
            self.y + distance * math.sin(math.radians(self.heading)),
        )
        # The robot slides along walls.
        free = next((point for point in ((x, y), (x, self.y), (self.x, y)) if self._is_free(point)), (self.x, self.y))
        self.bumps += free != (x, y) and not self._is_at_wall
        self._is_at_wall = free != (x, y)
        self.x, self.y = free

    def _is_free(self, point: Point) -> bool:
        return all(_distance(point, wall) >= RADIUS_M for wall in self._walls)

    def _see(self, degrees: float) -> float:
        """Return the length of a ray."""
        ahead = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
        return min((_hit((self.x, self.y), ahead, wall) for wall in self._walls), default=FARTHEST_M)


def _hit(start: Point, ahead: Point, wall: Wall) -> float:
    (x1, y1), (x2, y2) = wall
    along = (x2 - x1, y2 - y1)
    across = ahead[0] * along[1] - ahead[1] * along[0]
    if abs(across) < 1e-12:
        return FARTHEST_M
    offset = (x1 - start[0], y1 - start[1])
    distance = (offset[0] * along[1] - offset[1] * along[0]) / across
    part = (offset[0] * ahead[1] - offset[1] * ahead[0]) / across
    return min(distance, FARTHEST_M) if distance >= 0 and 0 <= part <= 1 else FARTHEST_M


def _distance(point: Point, wall: Wall) -> float:
    (x1, y1), (x2, y2) = wall
    along = (x2 - x1, y2 - y1)
    part = ((point[0] - x1) * along[0] + (point[1] - y1) * along[1]) / (along[0] ** 2 + along[1] ** 2)
    part = min(1.0, max(0.0, part))
    return math.dist(point, (x1 + part * along[0], y1 + part * along[1]))
