"""StandUp: gets the robot back on its feet."""

from field.world import World
from vicode.bica import Component


class StandUp(Component):
    """Plays the motion that stands up from the ground."""

    frequency_hz = 5.0
    world: World

    def work(self) -> None:
        """Begin the motion; while it plays, asking again changes nothing."""
        self.world.robot.stand_up()
