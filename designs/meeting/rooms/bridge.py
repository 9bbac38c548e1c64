"""What each robot sends and obeys when `vicode bridge` drives it."""

import math

from rooms.steering import ARRIVED_M, steer
from vicode.bridge import Command, Sensor, World


class MeetingWorld(World):
    """A laser scanner, odometry and a differential drive that finds its way to a point."""

    published = ("ins",)
    max_age = 0.5

    laser = Sensor("LASER", float, length=181, range=(0, 100), unit="m", max_age=0.5)
    """Distances from right (-90 degrees) to left (90 degrees)."""
    ins = Sensor("INS", float, fields=("x", "y", "yaw"), max_age=0.5)
    """Position in m; heading in degrees, counter-clockwise."""
    ground_truth = Sensor("GROUNDTRUTH", float, fields=("x", "y", "yaw"))
    robot_number = Sensor("NUMBER", int)
    differential_drive = Command("DIFFERENTIALDRIVE", "speed", "turning_speed", stop=(0, 0))

    def __init__(self) -> None:
        self._target: tuple[float, float] | None = None

    @property
    def arrived(self) -> bool:
        """Whether the robot is at the point that it drives to."""
        return self._target is not None and self._look_at(*self._target)[1] < ARRIVED_M

    def drive_to(self, *, x: float, y: float) -> None:
        """Drive towards a point, around what is in the way."""
        self._target = (x, y)
        bearing, distance = self._look_at(x, y)
        speed, turning_speed = steer(self.laser, bearing, distance)
        self.differential_drive(speed=speed, turning_speed=turning_speed)

    def _look_at(self, x: float, y: float) -> tuple[float, float]:
        """The bearing of a point in degrees to the left, and its distance in m."""
        dx, dy = x - self.ins.x, y - self.ins.y
        bearing = math.degrees(math.atan2(dy, dx)) - self.ins.yaw
        return (bearing + 180.0) % 360.0 - 180.0, math.hypot(dx, dy)
