"""What a simulated robot sends and obeys; users derive their own robots from this one."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.simulated_robot.arena import Arena, SimulatedRobot

Parameters = Sequence[float]


class RobotModel:
    """A robot with laser, odometry and a differential drive; one object serves all robots of a run."""

    def sense(self, arena: "Arena", robot: "SimulatedRobot") -> Mapping[str, Parameters]:
        """The values to send, by target."""
        return {
            "NUMBER": (robot.number,),
            "LASER": arena.scan(robot),
            "INS": _round(robot.odometry()),
            "GROUNDTRUTH": _round((*robot.at, robot.yaw)),
        }

    def obey(self, robot: "SimulatedRobot", commands: Mapping[str, Parameters]) -> None:
        """Do what the bridge has sent, by target."""
        if command := commands.get("DIFFERENTIALDRIVE"):
            robot.drive(*command[:2])


class DeclaredSensors(RobotModel):
    """A robot that sends only what a world of the bridge declares.

    Args:
        model: What it could send.
        targets: What the world declares.
    """

    def __init__(self, model: RobotModel, targets: Sequence[str]) -> None:
        self._model, self._targets = model, frozenset(targets)

    def sense(self, arena: "Arena", robot: "SimulatedRobot") -> Mapping[str, Parameters]:
        sensors = self._model.sense(arena, robot)
        return {target: values for target, values in sensors.items() if target in self._targets}

    def obey(self, robot: "SimulatedRobot", commands: Mapping[str, Parameters]) -> None:
        self._model.obey(robot, commands)


def _round(values: Parameters) -> tuple[float, ...]:
    return tuple(round(value, 4) for value in values)
