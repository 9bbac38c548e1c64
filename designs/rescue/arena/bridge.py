"""What the rescue robot sends and obeys when `vicode bridge` drives it."""

import math

from arena.world import REGIONS
from vicode.bridge import Command, Sensor, World, cached_per_tick


class RescueWorld(World):
    """A laser scanner, an inertial navigation system and a differential drive.

    The robot stands when nothing arrives for `max_age`, or when one of its sensors is lost.
    """

    published = ("ins",)
    max_age = 0.5

    laser = Sensor("LASER", float, length=(7, 1081), range=(0, 100), unit="m", max_age=0.5)
    """Distances from right (-90 degrees) to left (90 degrees)."""
    ins = Sensor("INS", float, fields=("x", "y", "yaw"), max_age=0.5)
    """Position in m; heading in degrees, counter-clockwise."""
    ground_truth = Sensor("GROUNDTRUTH", float, fields=("x", "y", "yaw"))
    number = Sensor("NUMBER", int)
    drive = Command("DIFFERENTIALDRIVE", "speed", "turning_speed", stop=(0, 0))

    def __init__(self) -> None:
        self._turned = 0.0
        self._yaw: float | None = None
        self._free_at = 0.0
        self._reads_laser = False

    def advance(self, _now_ns: int) -> None:
        """Add the last change of heading, the short way round: from 179 to -179 degrees it is 2, not -358."""
        if not self.ins_is_stale:
            yaw = self.ins.yaw
            if self._yaw is not None:
                self._turned += (yaw - self._yaw + 180.0) % 360.0 - 180.0
            self._yaw = yaw

    @property
    def amount_turned(self) -> float:
        """Degrees turned since the start, either way."""
        return abs(self._turned)

    @cached_per_tick
    def least_distances(self) -> dict[str, float]:
        """The least distance in each region."""
        self._reads_laser = True
        laser, last = self.laser, len(REGIONS) - 1
        # The regions begin at the left, the distances at the right.
        edges = [round(number * (len(laser) - 1) / len(REGIONS)) for number in range(len(REGIONS) + 1)]
        return {name: min(laser[edges[last - at] : edges[last - at + 1] + 1]) for at, name in enumerate(REGIONS)}

    def __getattr__(self, name: str) -> float:
        """The least distance in a region, such as laser_min_n."""
        region = name.removeprefix("laser_min_")
        if region == name or region not in REGIONS:
            raise AttributeError(name)
        return self.least_distances[region]

    @property
    def laser_max(self) -> float:
        """The largest of the least distances."""
        return max(self.least_distances.values())

    def differential_drive(self, *, speed: float, turning_speed: float) -> None:
        """Drive; a robot that steers by its laser stands until there are distances."""
        if self._reads_laser and self.laser_age == math.inf:
            self.drive(0.0, 0.0)
        elif self.time >= self._free_at:
            self.drive(speed, turning_speed)

    def wait(self, *, time: float) -> None:
        """Keep the last command for a while; the robot need not know about this."""
        if self.time >= self._free_at:
            self._free_at = self.time + time
