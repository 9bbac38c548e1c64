"""The field of the Standard Platform League of 2010: lines, goals and referee decisions."""

from enum import StrEnum

from field.geometry import Point

HALF_LENGTH_MM = 3000.0
HALF_WIDTH_MM = 2000.0
GOAL_HALF_WIDTH_MM = 700.0
GOAL_HEIGHT_MM = 800.0
POST_RADIUS_MM = 50.0
BORDER_MM = 500.0
NET = Point(HALF_LENGTH_MM, 0.0)
POSTS = tuple(Point(x, y) for x in (-HALF_LENGTH_MM, HALF_LENGTH_MM) for y in (-GOAL_HALF_WIDTH_MM, GOAL_HALF_WIDTH_MM))

_THROW_IN_MM = 400.0


class Whereabouts(StrEnum):
    """The position of a ball relative to field and goals."""

    IN_PLAY = "in play"
    GOAL = "goal"
    OWN_GOAL = "own goal"
    OUT = "out"


def whereabouts(ball: Point, radius: float) -> Whereabouts:
    """Classify a ball; it is out when it crosses a line completely."""
    is_over_end = abs(ball.x) - radius > HALF_LENGTH_MM
    if is_over_end and abs(ball.y) < GOAL_HALF_WIDTH_MM:
        return Whereabouts.GOAL if ball.x > 0 else Whereabouts.OWN_GOAL
    if is_over_end or abs(ball.y) - radius > HALF_WIDTH_MM:
        return Whereabouts.OUT
    return Whereabouts.IN_PLAY


def throw_in(ball: Point) -> Point:
    """Return the position where a ball that went out is placed: inside the line that it crossed."""
    inside_x, inside_y = HALF_LENGTH_MM - _THROW_IN_MM, HALF_WIDTH_MM - _THROW_IN_MM
    return Point(max(-inside_x, min(inside_x, ball.x)), max(-inside_y, min(inside_y, ball.y)))
