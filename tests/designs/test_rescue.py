"""The rescue robot of the thesis turns in its circle, and finds through the corridor."""

import pytest
from arena.bridge import RescueWorld
from arena.world import Corridor
from rescue.drive_circle import drive_circle
from rescue.walk_corridor import walk_corridor

from vicode.bica import Component, Root, SimulatedClock

PERIOD_NS = 100_000_000


def drive(component: type[Component], world: Corridor, *, seconds: float) -> Root:
    """Run a component until it is done, the robot is through, or the time is over."""
    clock = SimulatedClock()
    root = Root(component, clock=clock, world=world, on_error="stop")
    while clock.now_ns() < seconds * 1e9 and not root.main.is_done and not world.finished:
        world.advance(clock.now_ns())
        root.step()
        clock.advance(PERIOD_NS)
    return root


def test_the_circle_is_closed_and_the_robot_stands() -> None:
    world = Corridor(seed=1)
    root = drive(drive_circle, world, seconds=60)
    assert root.main.is_done
    assert 360 <= world.amount_turned < 370
    assert world.bumps == 0
    world.advance(100_000_000_000)
    assert world.amount_turned < 370


@pytest.mark.parametrize("seed", [1, 2])
def test_the_robot_finds_through_the_corridor(seed: int) -> None:
    world = Corridor(seed)
    drive(walk_corridor, world, seconds=400)
    assert world.finished, (world.x, world.y, world.heading)
    assert world.bumps == 0


def test_nothing_is_sensed_that_is_not_there() -> None:
    with pytest.raises(AttributeError):
        _ = Corridor().laser_min_south


def test_a_robot_without_distances_stands() -> None:
    world = RescueWorld()

    def drive_until(end: int, laser: bytes = b"") -> None:
        while root.iteration < end:
            clock.advance(PERIOD_NS)
            if laser:
                world.bridge.receive("LASER", laser, clock.now_ns())
            world.bridge.begin_tick(clock.now_ns(), clock.now_ns())
            root.step()
            world.bridge.end_tick()
            commands.append(world.bridge.commands.take().get("DIFFERENTIALDRIVE"))

    clock, commands = SimulatedClock(), list[object]()
    with Root(walk_corridor, clock=clock, world=world, on_error="stop") as root:
        drive_until(5)
        assert commands == [(0, 0), None, None, None, None]
        drive_until(12, b"1,1,1,5,1,1,1")
        assert (0.4, 0) in commands
        drive_until(20)
        assert [each for each in commands if each][-1] == (0, 0)
