"""The ball, which rolls, slows down and bounces off feet and posts."""

from dataclasses import dataclass

from field.geometry import ORIGIN, Point, Pose

BALL_RADIUS_MM = 32.5
FRICTION_MM_S2 = 400.0

FOOT_FRONT_MM = 100.0
FOOT_BACK_MM = -60.0
FEET_HALF_WIDTH_MM = 95.0

_POST_BOUNCE = 0.5


@dataclass(slots=True, kw_only=True)
class Ball:
    """A ball on the ground; `velocity` in mm/s."""

    position: Point
    velocity: Point = ORIGIN

    @property
    def speed(self) -> float:
        """Speed in mm/s."""
        return self.velocity.length

    def roll(self, seconds: float) -> None:
        """Roll with friction; the result is exact for any duration."""
        speed = self.speed
        if speed == 0.0:
            return
        rolling_s = min(seconds, speed / FRICTION_MM_S2)
        distance = speed * rolling_s - FRICTION_MM_S2 * rolling_s**2 / 2
        left_over = max(0.0, speed - FRICTION_MM_S2 * seconds)
        x, y = self.velocity.x / speed, self.velocity.y / speed
        self.position = Point(self.position.x + x * distance, self.position.y + y * distance)
        self.velocity = Point(x * left_over, y * left_over)

    def bounce_off_post(self, post: Point, radius: float) -> None:
        """Bounce off a round post, if the ball touches it, with half the speed."""
        away = self.position.minus(post)
        reach = radius + BALL_RADIUS_MM
        if not 0.0 < away.length < reach:
            return
        x, y = away.x / away.length, away.y / away.length
        self.position = Point(post.x + x * reach, post.y + y * reach)
        towards = self.velocity.x * x + self.velocity.y * y
        if towards < 0.0:
            change = -(1.0 + _POST_BOUNCE) * towards
            self.velocity = Point(self.velocity.x + x * change, self.velocity.y + y * change)

    def push_out(self, feet: Pose, speed: Point) -> None:
        """Move the ball out of the feet of a robot that moves with `speed` (in the frame of the robot)."""
        local = feet.to_local(self.position)
        displacement = _find_displacement(local)
        if displacement is None:
            return
        self.position = feet.to_field(Point(local.x + displacement.x, local.y + displacement.y))
        pushed = Point(speed.x if displacement.x else 0.0, speed.y if displacement.y else 0.0)
        self.velocity = pushed.turned(feet.heading)


def _find_displacement(local: Point) -> Point | None:
    """Return the shortest displacement that separates the ball from the feet; None if they do not touch."""
    ahead = FOOT_FRONT_MM + BALL_RADIUS_MM - local.x
    behind = FOOT_BACK_MM - BALL_RADIUS_MM - local.x
    left = FEET_HALF_WIDTH_MM + BALL_RADIUS_MM - local.y
    right = -FEET_HALF_WIDTH_MM - BALL_RADIUS_MM - local.y
    if ahead <= 0.0 or behind >= 0.0 or left <= 0.0 or right >= 0.0:
        return None
    candidates = (Point(ahead, 0.0), Point(behind, 0.0), Point(0.0, left), Point(0.0, right))
    return min(candidates, key=lambda candidate: candidate.length)
