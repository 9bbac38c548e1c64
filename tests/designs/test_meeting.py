"""The robots of the meeting drive to a point, around what is in the way; the experiment tests the rest."""

import math

from rooms.steering import steer

FREE = [20.0] * 181


def see(*discs: tuple[float, float, float]) -> list[float]:
    """What the laser measures of discs: direction in degrees, distance and radius in m."""
    ranges = list(FREE)
    for direction, distance, radius in discs:
        half = math.degrees(math.asin(radius / distance))
        for ray in range(181):
            if abs(ray - 90 - direction) <= half:
                ranges[ray] = min(ranges[ray], distance - radius)
    return ranges


def test_the_way_is_straight_if_nothing_is_there() -> None:
    assert steer(FREE, 0.0, 5.0) == (0.4, 0.0)
    speed, turning_speed = steer(FREE, 20.0, 5.0)
    assert 0 < speed < 0.4
    assert turning_speed == 50
    assert steer(FREE, 170.0, 5.0) == (0.0, 60.0)


def test_the_robot_stops_at_the_point() -> None:
    assert steer(FREE, 90.0, 0.05) == (0.0, 0.0)
    assert 0 < steer(FREE, 0.0, 0.15)[0] < 0.2


def test_the_robot_drives_around_an_obstacle_on_the_side_of_the_point() -> None:
    obstacle = see((0.0, 0.9, 0.25))
    assert steer(obstacle, 15.0, 3.0)[1] > 40
    assert steer(obstacle, -15.0, 3.0)[1] < -40


def test_a_robot_that_is_blocked_turns_to_the_right() -> None:
    assert steer([0.4] * 181, 0.0, 3.0) == (0.0, -60.0)
