"""Kicker: one kick per activation."""

from forward.declarations import Kick, Side

from field.kicks import KICKS
from field.world import World
from vicode.bica import Component, Root


class Kicker(Component):
    """Kicks once when it becomes active; `busy` until the leg is down again."""

    frequency_hz = 20.0
    world: World

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.busy = False
        self._kick = Kick.front
        self._side = Side.left
        self._is_started = False

    def restart(self) -> None:
        """Start a new kick with each activation."""
        self._is_started = False
        self.busy = True

    def modulate(self, *, kick: Kick = Kick.front, side: Side = Side.left) -> None:
        """Select the kick; the selection applies when the kick starts."""
        self._kick, self._side = kick, side

    def work(self) -> None:
        """Start the kick, then wait for its end."""
        robot = self.world.robot
        if not self._is_started:
            self._is_started = robot.kick(KICKS[self._kick.name], is_left=self._side is Side.left)
        self.busy = robot.swing is not None
