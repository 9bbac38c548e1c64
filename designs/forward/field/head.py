"""Head: turns the neck by relative angles."""

from field.world import World
from vicode.bica import Component, Root

GAIN_PER_S = 4.0


class Head(Component):
    """Turns towards a target `pan` to the left of and `tilt` below the image center, with proportional speed."""

    frequency_hz = 30.0
    world: World

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.pan = 0.0
        self.tilt = 0.0
        self._pan_by = 0.0
        self._tilt_by = 0.0

    def modulate(self, *, pan: float = 0.0, tilt: float = 0.0) -> None:
        """Set the relative angles in degrees: to the left, downwards."""
        self._pan_by, self._tilt_by = pan, tilt

    def work(self) -> None:
        """Command neck speeds and update the neck angles."""
        robot = self.world.robot
        robot.turn_head(GAIN_PER_S * self._pan_by, GAIN_PER_S * self._tilt_by)
        self.pan, self.tilt = robot.pan, robot.tilt
