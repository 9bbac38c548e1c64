"""The two cameras in the head: conversion between directions and points on the ground."""

import math
from dataclasses import dataclass

from field import pitch
from field.ball import BALL_RADIUS_MM
from field.geometry import Point, Pose, normalized

CAMERA_HEIGHT_MM = 480.0
BOTTOM_CAMERA_PITCH = 40.0
HALF_WIDTH_OF_VIEW = 23.2
HALF_HEIGHT_OF_VIEW = 17.4
BALL_RANGE_MM = 4500.0
NET_RANGE_MM = 7000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """The direction of a camera in degrees: `pan` to the left of straight ahead, `down` below the horizon."""

    pan: float
    down: float

    def holds(self, direction: "Direction") -> bool:
        """Whether a direction is inside the image."""
        across = abs(normalized(direction.bearing - self.pan))
        return across <= HALF_WIDTH_OF_VIEW and abs(direction.down - self.down) <= HALF_HEIGHT_OF_VIEW


@dataclass(frozen=True, slots=True, kw_only=True)
class Direction:
    """A direction from the head in degrees: `bearing` to the left of straight ahead, `down` below the horizon."""

    bearing: float
    down: float


def view_of(pan: float, tilt: float, *, is_bottom: bool) -> View:
    """The view of the top or the bottom camera with the head turned to pan and tilt (down is positive)."""
    return View(pan=pan, down=tilt + (BOTTOM_CAMERA_PITCH if is_bottom else 0.0))


def direction_to_ball(local: Point) -> Direction:
    """Return the direction to a ball at `local` (in the frame of the robot)."""
    return Direction(bearing=local.bearing, down=_angle_down(local.length, CAMERA_HEIGHT_MM - BALL_RADIUS_MM))


def place_of_ball(direction: Direction) -> Point:
    """Return the position of a ball seen in a direction; inverse of `direction_to_ball`."""
    down = max(direction.down, 1.0)
    distance = (CAMERA_HEIGHT_MM - BALL_RADIUS_MM) / math.tan(math.radians(down)) if down < 90.0 else 0.0
    return Point(distance, 0.0).turned(direction.bearing)


def sees_ball(view: View, local: Point) -> bool:
    """Whether a ball at `local` is in the image and near enough to be detected."""
    return local.length <= BALL_RANGE_MM and view.holds(direction_to_ball(local))


def sees_net(view: View, robot: Pose) -> bool:
    """Whether the middle of the opponent's goal, anywhere between ground and crossbar, is in the image."""
    local = robot.to_local(pitch.NET)
    ground = _angle_down(local.length, CAMERA_HEIGHT_MM)
    crossbar = _angle_down(local.length, CAMERA_HEIGHT_MM - pitch.GOAL_HEIGHT_MM)
    nearest = max(crossbar, min(ground, view.down))
    return local.length <= NET_RANGE_MM and view.holds(Direction(bearing=local.bearing, down=nearest))


def _angle_down(distance: float, height: float) -> float:
    return math.degrees(math.atan2(height, distance))
