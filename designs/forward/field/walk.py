"""Walk: the gait."""

from field.robot import Gait
from field.world import World
from vicode.bica import Component, Root


class Walk(Component):
    """Walks at the given speeds while it is stepped; otherwise the robot stands."""

    frequency_hz = 20.0
    world: World

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._gait = Gait()

    def modulate(self, *, forward: float = 0.0, lateral: float = 0.0, turn: float = 0.0) -> None:
        """Speeds: mm/s ahead, mm/s to the left, degrees/s to the left."""
        self._gait = Gait(forward=forward, lateral=lateral, turn=turn)

    def work(self) -> None:
        """Renew the walk command, which expires otherwise."""
        self.world.robot.walk(self._gait)
