"""StandUp: lets the robot stand up after a fall."""

from field.world import World
from vicode.bica import Component


class StandUp(Component):
    """Plays the stand-up motion."""

    frequency_hz = 5.0
    world: World

    def work(self) -> None:
        """Start the motion; has no effect while it plays."""
        self.world.robot.stand_up()
