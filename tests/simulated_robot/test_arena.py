"""The simulated world: drive, contacts, laser, odometry, repeatability."""

import math

import pytest

from vicode.simulated_robot.arena import RADIUS_M, Arena, Physics
from vicode.simulated_robot.laser import FARTHEST_M, RAYS, scan
from vicode.simulated_robot.map_file import read_world_map
from vicode.simulated_robot.world_map import MAPS_FOLDER, Circle, StartPose, WorldMap

BOX = WorldMap(
    walls=(((-2.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-2.0, 1.0), (-2.0, -1.0)),),
    starts=(StartPose(at=(0.0, 0.0), towards=(1.0, 0.0)),),
)


def test_a_robot_drives_as_fast_as_commanded() -> None:
    arena = Arena(WorldMap(), physics=Physics.exact())
    arena.robots[0].drive(0.5, 0)
    arena.advance(4)
    assert arena.robots[0].at == pytest.approx((2.0, 0.0), abs=0.05)
    arena.robots[0].drive(0, 90)
    arena.advance(3)
    assert arena.robots[0].turned == pytest.approx(270, abs=6)
    assert arena.robots[0].yaw == pytest.approx(-90, abs=6)


def test_commands_beyond_the_limits_are_limited() -> None:
    arena = Arena(WorldMap(), physics=Physics.exact())
    arena.robots[0].drive(100, 0)
    arena.advance(2)
    assert arena.robots[0].driven_m < 2


def test_walls_stop_a_robot_and_count_as_one_contact() -> None:
    arena = Arena(BOX, physics=Physics.exact())
    arena.robots[0].drive(1, 0)
    arena.advance(5)
    assert arena.robots[0].at[0] == pytest.approx(3 - RADIUS_M, abs=0.05)
    assert arena.robots[0].contacts == 1


def test_robots_that_meet_both_count_the_contact() -> None:
    world = WorldMap(starts=(StartPose(at=(0, 0), towards=(1, 0)), StartPose(at=(2, 0), towards=(0, 0))))
    arena = Arena(world, robots=2, physics=Physics.exact())
    for robot in arena.robots:
        robot.drive(0.5, 0)
    arena.advance(3)
    assert [robot.contacts for robot in arena.robots] == [1, 1]


def test_the_laser_measures_walls_from_right_to_left() -> None:
    ranges = scan((0.0, 0.0), 0.0, BOX.segments())
    assert len(ranges) == RAYS
    assert ranges[0] == pytest.approx(1)
    assert ranges[90] == pytest.approx(3)
    assert ranges[135] == pytest.approx(math.sqrt(2))
    assert scan((0.0, 0.0), math.pi, BOX.segments())[90] == pytest.approx(2)
    assert scan((0.0, 0.0), 0.0, ())[90] == FARTHEST_M


@pytest.mark.parametrize("heading", range(-180, 181, 15))
@pytest.mark.parametrize("at", [(0.0, 0.0), (-1.5, 0.7), (2.9, -0.9)])
def test_the_laser_agrees_with_the_library(at: tuple[float, float], heading: int) -> None:
    arena = Arena(BOX, physics=Physics.exact())
    exact = scan(at, math.radians(heading), BOX.segments())
    for ray, distance in enumerate(exact):
        angle = math.radians(heading + ray - 90)
        # The end of the ray is just behind the wall, and nothing is in front of it.
        for factor, is_hit in ((0.999, False), (1.001, True)):
            end = (at[0] + factor * distance * math.cos(angle), at[1] + factor * distance * math.sin(angle))
            assert arena.is_blocked(at, end) is is_hit, (ray, distance)


def test_the_laser_sees_other_robots() -> None:
    ranges = scan((0.0, 0.0), 0.0, (), [((2.0, 0.0), RADIUS_M), ((0.0, -1.0), RADIUS_M)])
    assert ranges[90] == pytest.approx(2 - RADIUS_M)
    assert ranges[0] == pytest.approx(1 - RADIUS_M)
    assert ranges[180] == FARTHEST_M


def test_the_seed_determines_a_run() -> None:
    def run(seed: int) -> tuple[object, ...]:
        arena = Arena(read_named("straight"), seed=seed)
        arena.robots[0].drive(0.4, 5)
        arena.advance(3)
        return arena.robots[0].at, arena.robots[0].odometry(), arena.scan(arena.robots[0])

    assert run(1) == run(1)
    assert run(1) != run(2)


def test_the_odometry_drifts() -> None:
    arena = Arena(WorldMap(), seed=3)
    arena.advance(60)
    x, y, yaw = arena.robots[0].odometry()
    assert 0 < math.hypot(x, y) < 0.3
    assert 0 < abs(yaw) < 3


@pytest.mark.parametrize("path", sorted(MAPS_FOLDER.glob("*.yaml")), ids=lambda path: path.stem)
def test_robots_of_a_map_start_clear_of_walls_and_of_each_other(path) -> None:
    world = read_named(path.stem)
    assert world.name == path.stem
    assert world.doc
    for seed in range(20):
        arena = Arena(world, robots=len(world.starts), seed=seed)
        arena.advance(0.1)
        assert [robot.contacts for robot in arena.robots] == [0] * len(arena.robots)


def test_further_robots_start_behind_the_first() -> None:
    arena = Arena(WorldMap(circles=(Circle(at=(0, 0), radius=9),)), robots=3)
    assert [robot.at[0] for robot in arena.robots] == pytest.approx([0, -0.75, -1.5])


def test_errors_of_a_map_are_reported_with_their_place() -> None:
    result = read_world_map("vicode: 1\nwall: []\nstarts:\n  - {at: [1, 2]}\n", "my.yaml")
    assert result.world_map is None
    lines = [finding.location.line for finding in result.findings if finding.location is not None]
    assert lines == [2, 4]
    assert "did you mean 'walls'?" in result.findings[0].fix


def read_named(name: str) -> WorldMap:
    result = read_world_map((MAPS_FOLDER / f"{name}.yaml").read_bytes(), f"{name}.yaml")
    assert result.world_map is not None, result.findings
    return result.world_map
