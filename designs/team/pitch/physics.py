"""Robots and a ball on a pitch with boards; lengths in m, angles in radians to the left, times in s.

Positions are complex numbers: x towards the goal that the home team attacks, y to the left.
"""

import cmath
import math
from dataclasses import dataclass
from itertools import combinations
from random import Random

HALF_LENGTH, HALF_WIDTH, HALF_GOAL = 3.0, 2.0, 0.6
ROBOT_RADIUS, BALL_RADIUS = 0.15, 0.05
KICK_SPEED, KICK_REACH, KICK_PAUSE_S = 3.0, 0.27, 1.0
STEP_S = 0.02
_MARGIN = 0.2
_FRICTION = 0.5
_BOUNCE = 0.4
_STUCK_S, _STUCK_WITHIN = 8.0, 0.3
_FORMATION = (-2.8, -1.6 + 0.7j, -0.9 - 0.4j)
_KICK_OFF = -0.35


@dataclass(slots=True, kw_only=True, eq=False)
class Robot:
    """A disc that walks in all directions and kicks straight ahead.

    Attributes:
        side: 1 for the home team, -1 for the other one.
        walking: Speed ahead and to the left, in m/s.
        turning: Turning speed, in rad/s.
        kick_power: Power of the kick that is wanted, 0 for none.
        noise: Its own random numbers: those of other robots do not depend on what it does.
    """

    side: int
    number: int
    noise: Random
    at: complex = 0j
    heading: float = 0.0
    walking: complex = 0j
    turning: float = 0.0
    kick_power: float = 0.0
    kicked_s: float = -KICK_PAUSE_S

    @property
    def velocity(self) -> complex:
        return self.walking * cmath.rect(1, self.heading)


class Pitch:
    """Moves robots and ball in steps of 20 ms, counts goals, and puts all in place for a kick-off."""

    def __init__(self, robots: list[Robot]) -> None:
        self.robots = robots
        self.ball = self.ball_velocity = 0j
        self.goals = {1: 0, -1: 0}
        self.kicks = self.dropped_balls = 0
        self.now_s = self._moved_s = 0.0
        self._marker = 0j
        self._kick_off(1)

    def step(self) -> None:
        self.now_s += STEP_S
        for robot in self.robots:
            robot.heading += robot.turning * STEP_S
            robot.at += robot.velocity * robot.noise.gauss(1, 0.1) * STEP_S
            robot.at = _clamp(robot.at, HALF_LENGTH + _MARGIN, HALF_WIDTH + _MARGIN)
        for one, other in combinations(self.robots, 2):
            gap = one.at - other.at
            if 0 < (distance := abs(gap)) < 2 * ROBOT_RADIUS:
                push = gap / distance * (ROBOT_RADIUS - distance / 2)
                one.at += push
                other.at -= push
        self._move_ball()
        self._referee()

    def _move_ball(self) -> None:
        speed = abs(self.ball_velocity)
        self.ball_velocity *= max(0.0, 1 - _FRICTION * STEP_S / speed) if speed else 0
        self.ball += self.ball_velocity * STEP_S
        for robot in self.robots:
            gap = self.ball - robot.at
            distance = abs(gap)
            if distance < ROBOT_RADIUS + BALL_RADIUS:
                self._bounce(robot, gap / (distance or 1))
            if robot.kick_power and self.now_s - robot.kicked_s >= KICK_PAUSE_S:
                ahead = gap * cmath.rect(1, -robot.heading)
                if distance < KICK_REACH and abs(cmath.phase(ahead)) < math.radians(40):
                    robot.kicked_s = self.now_s
                    self.kicks += 1
                    direction = robot.heading + robot.noise.gauss(0, math.radians(5))
                    self.ball_velocity = cmath.rect(KICK_SPEED * robot.kick_power, direction)
        if abs(self.ball.imag) > HALF_WIDTH:
            self.ball_velocity = self.ball_velocity.conjugate() * _BOUNCE
        if abs(self.ball.real) > HALF_LENGTH and abs(self.ball.imag) > HALF_GOAL:
            self.ball_velocity = -self.ball_velocity.conjugate() * _BOUNCE
        in_goal = abs(self.ball.imag) <= HALF_GOAL
        self.ball = _clamp(self.ball, math.inf if in_goal else HALF_LENGTH, HALF_WIDTH)

    def _bounce(self, robot: Robot, normal: complex) -> None:
        """The ball leaves a robot along the normal, and takes its speed."""
        self.ball = robot.at + normal * (ROBOT_RADIUS + BALL_RADIUS)
        relative = self.ball_velocity - robot.velocity
        along = (relative * normal.conjugate()).real
        if along < 0:
            self.ball_velocity -= normal * along * (1 + _BOUNCE)

    def _referee(self) -> None:
        if abs(self.ball.real) > HALF_LENGTH + BALL_RADIUS:
            scorer = 1 if self.ball.real > 0 else -1
            self.goals[scorer] += 1
            self._kick_off(-scorer)
        if abs(self.ball - self._marker) > _STUCK_WITHIN:
            self._marker, self._moved_s = self.ball, self.now_s
        elif self.now_s - self._moved_s > _STUCK_S:
            self.dropped_balls += 1
            self._kick_off(0)

    def _kick_off(self, side: int) -> None:
        """Put the ball in the center and the robots in their halves; the last one of a side is at the ball."""
        self.ball = self.ball_velocity = self._marker = 0j
        self._moved_s = self.now_s
        for robot in self.robots:
            is_at_ball = robot.side == side and robot.number == len(_FORMATION)
            place = _KICK_OFF if is_at_ball else _FORMATION[robot.number - 1]
            place += complex(robot.noise.uniform(-0.1, 0), robot.noise.uniform(-0.1, 0.1))
            robot.at, robot.heading = robot.side * place, 0.0 if robot.side > 0 else math.pi


def _clamp(at: complex, x: float, y: float) -> complex:
    return complex(min(x, max(-x, at.real)), min(y, max(-y, at.imag)))
