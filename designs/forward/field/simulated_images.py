"""Simulated camera images: the pixels of a color filter for the ball, with noise.

A pinhole camera renders the ball as a sphere. The image is what the filter of a robot would return: most pixels of the
ball, some other pixels, and sometimes a patch of the ball's color that is not the ball. Camera angles are measured by
joint sensors, so they differ from the angles at which the image was taken.
"""

import math
from dataclasses import dataclass
from random import Random

from field.ball import BALL_RADIUS_MM
from field.camera import CAMERA_HEIGHT_MM, HALF_WIDTH_OF_VIEW, view_of
from field.geometry import Point
from field.world import World

WIDTH = 160
HEIGHT = 120
FOCAL_PX = WIDTH / 2 / math.tan(math.radians(HALF_WIDTH_OF_VIEW))
JOINT_NOISE_DEG = 0.3

_BALL_HEIGHT_MM = BALL_RADIUS_MM - CAMERA_HEIGHT_MM
_LEAST_DESCENT = -_BALL_HEIGHT_MM / 5000.0
_MISSED_IMAGES = 0.05
_MISSED_PIXELS = 0.1
_FALSE_PIXELS = 5
_FALSE_PATCHES = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class Optics:
    """Where a camera was and where it looked; converts between balls on the ground and the image.

    `pan` and `down` are degrees in the frame in which `x` and `y` are given, in mm.
    """

    x: float
    y: float
    pan: float
    down: float

    def project(self, ball: Point) -> tuple[float, float, float] | None:
        """Return column and row of the center of a ball and its radius, in pixels; None if it is behind the camera."""
        depth, left, below = self.in_camera(ball)
        if depth < 1.0:
            return None
        return (
            WIDTH / 2 - FOCAL_PX * left / depth,
            HEIGHT / 2 + FOCAL_PX * below / depth,
            FOCAL_PX * BALL_RADIUS_MM / depth,
        )

    def place(self, column: float, row: float) -> Point | None:
        """Return where a ball lies whose center is at a pixel; None if it is 5 m away or more."""
        left, below = (WIDTH / 2 - column) / FOCAL_PX, (row - HEIGHT / 2) / FOCAL_PX
        cosine, sine = math.cos(math.radians(self.down)), math.sin(math.radians(self.down))
        descent = sine + below * cosine
        if descent < _LEAST_DESCENT:
            return None
        scale = -_BALL_HEIGHT_MM / descent
        local = Point((cosine - below * sine) * scale, left * scale).turned(self.pan)
        return Point(self.x + local.x, self.y + local.y)

    def in_camera(self, ball: Point) -> tuple[float, float, float]:
        """Return the distances of a ball along the optical axis, to the left and downwards, in mm."""
        x, y = ball.x - self.x, ball.y - self.y
        pan, down = math.radians(self.pan), math.radians(self.down)
        ahead = x * math.cos(pan) + y * math.sin(pan)
        left = y * math.cos(pan) - x * math.sin(pan)
        depth = ahead * math.cos(down) - _BALL_HEIGHT_MM * math.sin(down)
        return depth, left, -ahead * math.sin(down) - _BALL_HEIGHT_MM * math.cos(down)


@dataclass(frozen=True, slots=True, kw_only=True)
class BallImage:
    """The positive pixels of one image; bit `column` of `rows[row]` is set for a pixel of the ball's color."""

    rows: tuple[int, ...]
    optics: Optics

    def count(self, left: int, top: int, right: int, bottom: int) -> int:
        """Return the number of positive pixels in a window; `right` and `bottom` are exclusive."""
        left = max(left, 0)
        mask = (1 << max(right - left, 0)) - 1
        return sum((row >> left & mask).bit_count() for row in self.rows[max(top, 0) : max(bottom, 0)])


def take_image(world: World, noise: Random, *, is_bottom: bool) -> BallImage:
    """Render what a camera of the robot sees now; its measured place and direction are in the odometry frame."""
    robot = world.robot
    view = view_of(robot.pan, robot.tilt, is_bottom=is_bottom)
    at = robot.odometry
    measured = Optics(x=at.x, y=at.y, pan=at.heading + view.pan, down=view.down)
    rows = [0] * HEIGHT
    ball = world.look(is_bottom=is_bottom).ball
    pan, down = view.pan + noise.gauss(0.0, JOINT_NOISE_DEG), view.down + noise.gauss(0.0, JOINT_NOISE_DEG)
    if ball is not None and noise.random() >= _MISSED_IMAGES:
        for column, row in _render(ball, Optics(x=0.0, y=0.0, pan=pan, down=down)):
            rows[row] |= (noise.random() >= _MISSED_PIXELS) << column
    _add_false_pixels(rows, noise)
    return BallImage(rows=tuple(rows), optics=measured)


def _render(ball: Point, optics: Optics) -> list[tuple[int, int]]:
    """Return the pixels whose ray hits the sphere."""
    depth, left, below = optics.in_camera(ball)
    if depth < 1.0:
        return []
    center_column, center_row, radius = optics.project(ball) or (0.0, 0.0, 0.0)
    reach = 1.5 * radius + 1.0
    tangent = depth**2 + left**2 + below**2 - BALL_RADIUS_MM**2
    hits = []
    for row in range(max(0, int(center_row - reach)), min(HEIGHT, int(center_row + reach) + 1)):
        down = (row + 0.5 - HEIGHT / 2) / FOCAL_PX
        for column in range(max(0, int(center_column - reach)), min(WIDTH, int(center_column + reach) + 1)):
            across = (WIDTH / 2 - column - 0.5) / FOCAL_PX
            along = depth + across * left + down * below
            if along**2 >= (1.0 + across**2 + down**2) * tangent:
                hits.append((column, row))
    return hits


def _add_false_pixels(rows: list[int], noise: Random) -> None:
    for _ in range(_FALSE_PIXELS):
        rows[noise.randrange(HEIGHT)] |= 1 << noise.randrange(WIDTH)
    if noise.random() < _FALSE_PATCHES:
        size, top, left = noise.randint(2, 8), noise.randrange(HEIGHT), noise.randrange(WIDTH - 8)
        for row in range(top, min(top + size, HEIGHT)):
            rows[row] |= ((1 << size) - 1) << left
