"""Head: turns the neck by what it is asked for."""

from field.world import World
from vicode.bica import Component, Root

GAIN_PER_S = 4.0


class Head(Component):
    """Turns towards what lies `pan` to the left and `tilt` below the middle of the image, and slows down near it."""

    frequency_hz = 30.0
    world: World

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.pan = 0.0
        self.tilt = 0.0
        self._pan_by = 0.0
        self._tilt_by = 0.0

    def modulate(self, *, pan: float = 0.0, tilt: float = 0.0) -> None:
        """Turn by so many degrees: to the left, downwards."""
        self._pan_by, self._tilt_by = pan, tilt

    def work(self) -> None:
        """Pass the wish on as speeds, and tell where the neck is."""
        robot = self.world.robot
        robot.turn_head(GAIN_PER_S * self._pan_by, GAIN_PER_S * self._tilt_by)
        self.pan, self.tilt = robot.pan, robot.tilt
