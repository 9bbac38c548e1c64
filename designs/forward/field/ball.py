"""The ball: it rolls, slows down, and bounces off feet and posts."""

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
        """How fast it rolls, in mm/s."""
        return self.velocity.length

    def roll(self, seconds: float) -> None:
        """Roll on, slowed down by the carpet; exact for any length of time."""
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
        """Leave a round post, if it touches it, with half the speed that it came with."""
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

    def be_pushed(self, feet: Pose, speed: Point) -> None:
        """Be shoved out of the feet of a robot that moves with `speed`, given in its own directions."""
        local = feet.to_local(self.position)
        way_out = _way_out_of_feet(local)
        if way_out is None:
            return
        self.position = feet.to_field(Point(local.x + way_out.x, local.y + way_out.y))
        pushed = Point(speed.x if way_out.x else 0.0, speed.y if way_out.y else 0.0)
        self.velocity = pushed.turned(feet.heading)


def _way_out_of_feet(local: Point) -> Point | None:
    """The shortest move that takes a ball off the feet, None when it does not touch them."""
    ahead = FOOT_FRONT_MM + BALL_RADIUS_MM - local.x
    behind = FOOT_BACK_MM - BALL_RADIUS_MM - local.x
    left = FEET_HALF_WIDTH_MM + BALL_RADIUS_MM - local.y
    right = -FEET_HALF_WIDTH_MM - BALL_RADIUS_MM - local.y
    if ahead <= 0.0 or behind >= 0.0 or left <= 0.0 or right >= 0.0:
        return None
    ways = (Point(ahead, 0.0), Point(behind, 0.0), Point(0.0, left), Point(0.0, right))
    return min(ways, key=lambda way: way.length)
