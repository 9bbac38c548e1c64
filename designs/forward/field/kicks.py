"""The kick motions and their effect on the ball."""

from dataclasses import dataclass
from random import Random

from field.geometry import Point

CONTACT_S = 0.6
DURATION_S = 1.6

_DIRECTION_NOISE = 3.0
_SPEED_NOISE = 0.08


@dataclass(frozen=True, slots=True, kw_only=True)
class KickMotion:
    """A kick with the left leg; the right leg mirrors it.

    `spot` is the optimal ball position, `reach` the allowed distance from it, `direction` is in degrees to the left.
    """

    direction: float
    speed: float
    spot: Point
    reach: float = 75.0


KICKS = {
    "front": KickMotion(direction=0.0, speed=2100.0, spot=Point(165.0, 50.0)),
    "diagonal": KickMotion(direction=45.0, speed=1900.0, spot=Point(165.0, 60.0)),
    "lateral": KickMotion(direction=90.0, speed=1600.0, spot=Point(155.0, 80.0)),
}


def kicked_velocity(motion: KickMotion, ball: Point, *, is_left: bool, noise: Random) -> Point | None:
    """Return the velocity of a ball at `ball` after a kick, in the frame of the robot; None if the leg misses it."""
    mirror = 1.0 if is_left else -1.0
    off = Point(ball.x, ball.y * mirror).minus(motion.spot)
    if off.length > motion.reach:
        return None
    # A ball off the center of the foot is slower and deflected to its side.
    quality = 1.0 - 0.4 * (off.length / motion.reach) ** 2
    glance = 12.0 * off.turned(-motion.direction).y / motion.reach
    direction = motion.direction + glance + noise.gauss(0.0, _DIRECTION_NOISE)
    speed = motion.speed * quality * (1.0 + noise.gauss(0.0, _SPEED_NOISE))
    return Point(speed, 0.0).turned(direction * mirror)
