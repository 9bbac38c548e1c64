"""Drives towards a point, and around what the laser sees on the way."""

import math
from collections.abc import Sequence

Point = tuple[float, float]
Drive = tuple[float, float]
"""Speed in m/s, and turning speed in degrees/s to the left."""

ARRIVED_M = 0.1
_CLEARANCE_M = 0.34
_LOOK_AHEAD_M = 1.2
_STUCK_M = 0.2
_DETOUR_DEG = 150.0
"""How far the robot turns away from its way to avoid an obstacle that is right in front of it."""
_SPEED_M_S, _TURN_DEG_S = 0.4, 60.0
_CANDIDATES = range(-90, 91, 10)
_ANGLES = tuple(math.radians(ray - 90) for ray in range(181))


def steer(ranges: Sequence[float], bearing: float, distance: float) -> Drive:
    """Return the drive towards a point.

    Args:
        ranges: Distances that the laser measures, one per degree, from right to left.
        bearing: Of the point, in degrees to the left.
        distance: Of the point, in m.
    """
    if distance < ARRIVED_M:
        return 0.0, 0.0
    reach = min(distance, _LOOK_AHEAD_M)
    obstacles = [
        (near * math.cos(angle), near * math.sin(angle))
        for near, angle in zip(ranges, _ANGLES, strict=True)
        if near < reach + _CLEARANCE_M
    ]
    best, free = _choose_direction(obstacles, bearing, reach)
    if free < min(_STUCK_M, reach / 2):
        # Look to the right until there is a way: robots that block each other turn away from each other.
        return 0.0, -_TURN_DEG_S
    turning_speed = max(-_TURN_DEG_S, min(_TURN_DEG_S, 2.5 * best))
    ahead = _free_path(obstacles, 0.0, reach)
    speed = _SPEED_M_S * max(0.0, math.cos(math.radians(best))) ** 2 * min(1.0, ahead / 0.4, distance / 0.3)
    return speed, turning_speed


def _choose_direction(obstacles: Sequence[Point], bearing: float, reach: float) -> tuple[float, float]:
    """The direction near the bearing in which the way is free, or nearly so, and how far it is free."""
    best, best_free, least = 0.0, 0.0, math.inf
    for direction in sorted((bearing, *_CANDIDATES), key=lambda each: abs(each - bearing)):
        off = abs(direction - bearing)
        if off >= least:
            break
        free = _free_path(obstacles, direction, reach)
        cost = off + _DETOUR_DEG * (1 - free / reach)
        if cost < least:
            best, best_free, least = direction, free, cost
    return best, best_free


def _free_path(obstacles: Sequence[Point], direction: float, reach: float) -> float:
    """How far the robot can drive in a direction without coming closer to an obstacle than its clearance."""
    ahead, across = math.cos(math.radians(direction)), math.sin(math.radians(direction))
    free = reach
    for x, y in obstacles:
        along, beside = x * ahead + y * across, y * ahead - x * across
        if along > 0 and abs(beside) < _CLEARANCE_M:
            free = min(free, max(0.0, along - math.sqrt(_CLEARANCE_M**2 - beside**2)))
    return free
