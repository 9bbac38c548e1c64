"""The robot for tests of users: the same as a robot of the server."""

import pytest

from tests.bridge.sample_robots import Follow, SampleWorld, WatchedWorld
from vicode.bridge.frames import FrameError
from vicode.bridge.testing import RobotTester


def test_a_component_is_driven_by_a_test() -> None:
    robot = RobotTester(WatchedWorld, Follow)
    assert (robot.tick(), robot.world.time) == ({}, 0)
    robot.send(AHEAD=5)
    assert (robot.tick(), robot.state) == ({"DRIVE": (0.5, 0)}, "Going")
    assert robot.run(0.2, AHEAD=0.5, INS=(1, 2, 90)) == [{"DRIVE": (0, 30)}]
    assert (robot.state, robot.world.pose.yaw) == ("Near", 90)
    assert robot.run(2) == [{"DRIVE": (0, 0)}]
    assert robot.notices == ["commands are at rest: nothing has arrived for 1 s"]
    assert robot.errors == []


def test_a_function_is_a_behavior() -> None:
    robot = RobotTester(SampleWorld, lambda world: world.lamp(world.range_ahead), tick_s=0.1)
    assert robot.run(0.3, AHEAD=2) == [{"LAMP": (2,)}] * 3
    robot.send(MODE=7)
    robot.tick()
    assert robot.world.mode == ""
    robot.tick()
    assert robot.errors == ["MODE: parameter 1 is 7, expected a text"]
    with pytest.raises(FrameError, match="no sensor or event LIDAR; the world has AHEAD, INS"):
        robot.send(LIDAR=1)
