"""Points, angles and poses in the plane."""

import math
from dataclasses import dataclass
from typing import NamedTuple


class Point(NamedTuple):
    """A position or a displacement in millimetres."""

    x: float
    y: float

    @property
    def length(self) -> float:
        """Distance from the origin."""
        return math.hypot(self.x, self.y)

    @property
    def bearing(self) -> float:
        """Direction as seen from the origin, in degrees from the x axis."""
        return math.degrees(math.atan2(self.y, self.x))

    def minus(self, other: "Point") -> "Point":
        """Return the displacement from another point to this one."""
        return Point(self.x - other.x, self.y - other.y)

    def turned(self, angle: float) -> "Point":
        """Rotate about the origin, in degrees to the left."""
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        return Point(self.x * cosine - self.y * sine, self.x * sine + self.y * cosine)


ORIGIN = Point(0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """A position and orientation; `heading` in degrees from the x axis."""

    x: float
    y: float
    heading: float

    def to_local(self, point: Point) -> Point:
        """Convert a field position to the local frame (x ahead, y to the left)."""
        return point.minus(Point(self.x, self.y)).turned(-self.heading)

    def to_field(self, point: Point) -> Point:
        """Convert a position in the local frame (x ahead, y to the left) to the field."""
        turned = point.turned(self.heading)
        return Point(self.x + turned.x, self.y + turned.y)

    def moved(self, ahead: float, left: float, turn: float) -> "Pose":
        """Return the pose after a small motion along the mean of the old and the new heading."""
        step = Point(ahead, left).turned(self.heading + turn / 2)
        return Pose(x=self.x + step.x, y=self.y + step.y, heading=normalized(self.heading + turn))


def normalized(angle: float) -> float:
    """Normalize an angle to the range [-180, 180) degrees."""
    return (angle + 180.0) % 360.0 - 180.0


def limited(value: float, limit: float) -> float:
    """Clamp a value to [-limit, limit]."""
    return max(-limit, min(limit, value))


def approached(value: float, target: float, step: float) -> float:
    """Move a value towards the target by at most `step`."""
    return value + limited(target - value, step)
