"""The simulated world: one robot, one ball, two goals and fixed time steps."""

from dataclasses import dataclass
from random import Random

from field import pitch
from field.ball import BALL_RADIUS_MM, Ball
from field.camera import sees_ball, sees_net, view_of
from field.geometry import ORIGIN, Point, Pose
from field.kicks import kicked_velocity
from field.pitch import Whereabouts
from field.robot import STANDING, Robot, Swing

STEP_NS = 10_000_000
REACHED_MM = 300.0
CHEER_S = 3.0

_STEP_S = STEP_NS / 1e9


@dataclass(slots=True, kw_only=True)
class Record:
    """Events so far; times in seconds, None for events that have not happened."""

    ball_found_s: float | None = None
    ball_reached_s: float | None = None
    first_goal_s: float | None = None
    goals: int = 0
    own_goals: int = 0
    kicks: int = 0
    hits: int = 0
    throw_ins: int = 0
    falls: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Image:
    """What a camera has in view: positions of objects in the frame of the robot (x ahead, y left, in mm); no pixels."""

    ball: Point | None
    net: Point | None


class World:
    """A field with a seed; the same seed and the same commands give the same simulation.

    Args:
        seed: decides where robot and ball begin, and all noise.
        robot: where the robot begins, instead of a place drawn from the seed.
        ball: where the ball begins, likewise.
    """

    def __init__(self, seed: int = 1, *, robot: Pose | None = None, ball: Point | None = None) -> None:
        self.seed = seed
        draw = self.stream("start").uniform
        drawn_pose = Pose(x=draw(-2400.0, -800.0), y=draw(-1200.0, 1200.0), heading=draw(-180.0, 180.0))
        drawn_ball = Point(draw(-400.0, 1800.0), draw(-1200.0, 1200.0))
        self.robot = Robot(pose=robot or drawn_pose, noise=self.stream("robot"))
        self.ball = Ball(position=ball or drawn_ball)
        self.record = Record()
        self._kick_noise = self.stream("kicks")
        self._steps = 0

    def stream(self, name: str) -> Random:
        """Return a separate random stream for each user, so that their draws do not affect each other."""
        return Random(f"{self.seed}/{name}")

    @property
    def time_s(self) -> float:
        """Simulated time in seconds."""
        return self._steps * STEP_NS / 1e9

    @property
    def finished(self) -> bool:
        """Whether some time has passed since the first goal."""
        goal_s = self.record.first_goal_s
        return goal_s is not None and self.time_s >= goal_s + CHEER_S

    def advance(self, now_ns: int) -> None:
        """Simulate until `now_ns` in whole steps."""
        while (self._steps + 1) * STEP_NS <= now_ns:
            self._steps += 1
            self._step()

    def hold(self) -> None:
        """Let legs and head stand still."""
        self.robot.walk(STANDING)
        self.robot.turn_head(0.0, 0.0)

    def look(self, *, is_bottom: bool) -> Image:
        """Return what is in view of the top or bottom camera, without noise; nothing while the robot lies."""
        robot = self.robot
        view = view_of(robot.pan, robot.tilt, is_bottom=is_bottom)
        ball = robot.pose.to_local(self.ball.position)
        has_ball = not robot.is_fallen and sees_ball(view, ball)
        has_net = not robot.is_fallen and sees_net(view, robot.pose)
        if has_ball and self.record.ball_found_s is None:
            self.record.ball_found_s = self.time_s
        return Image(ball=ball if has_ball else None, net=robot.pose.to_local(pitch.NET) if has_net else None)

    def snapshot(self) -> dict[str, float]:
        """Return the current state as rounded numbers."""
        robot, ball = self.robot, self.ball.position
        return {
            "robot_x": round(robot.pose.x),
            "robot_y": round(robot.pose.y),
            "heading": round(robot.pose.heading, 1),
            "pan": round(robot.pan, 1),
            "tilt": round(robot.tilt, 1),
            "ball_x": round(ball.x),
            "ball_y": round(ball.y),
            "net_bearing": round(robot.pose.to_local(pitch.NET).bearing, 1),
            "goals": self.record.goals,
        }

    def summary(self) -> dict[str, float | int | None]:
        """Return the events and their times."""
        record = self.record
        return {
            "seconds": round(self.time_s, 2),
            "ball_found_s": _rounded(record.ball_found_s),
            "ball_reached_s": _rounded(record.ball_reached_s),
            "first_goal_s": _rounded(record.first_goal_s),
            "goals": record.goals,
            "own_goals": record.own_goals,
            "kicks": record.kicks,
            "hits": record.hits,
            "throw_ins": record.throw_ins,
            "falls": record.falls,
        }

    def _step(self) -> None:
        robot, ball = self.robot, self.ball
        was_up, was_swinging = not robot.is_fallen, robot.swing is not None
        struck = robot.move(_STEP_S)
        self.record.falls += was_up and robot.is_fallen
        self.record.kicks += struck is not None
        if struck is not None:
            self._strike(struck)
        ball.roll(_STEP_S)
        if not was_swinging:
            ball.push_out(robot.pose, Point(robot.gait.forward, robot.gait.lateral))
        for post in pitch.POSTS:
            ball.bounce_off_post(post, pitch.POST_RADIUS_MM)
        self._judge()

    def _strike(self, swing: Swing) -> None:
        pose = self.robot.pose
        local = pose.to_local(self.ball.position)
        velocity = kicked_velocity(swing.motion, local, is_left=swing.is_left, noise=self._kick_noise)
        if velocity is not None:
            self.record.hits += 1
            self.ball.velocity = velocity.turned(pose.heading)

    def _judge(self) -> None:
        record, ball = self.record, self.ball
        if record.ball_reached_s is None and self.robot.pose.to_local(ball.position).length < REACHED_MM:
            record.ball_reached_s = self.time_s
        match pitch.whereabouts(ball.position, BALL_RADIUS_MM):
            case Whereabouts.GOAL:
                self._score()
            case Whereabouts.OWN_GOAL:
                record.own_goals += 1
                self.ball = Ball(position=ORIGIN)
            case Whereabouts.OUT:
                record.throw_ins += 1
                self.ball = Ball(position=pitch.throw_in(ball.position))

    def _score(self) -> None:
        """Record the first goal; the ball then stays in the net."""
        if self.record.first_goal_s is None:
            self.record.first_goal_s = self.time_s
            self.record.goals += 1
        _rest_in_net(self.ball)


def _rest_in_net(ball: Ball) -> None:
    depth = pitch.HALF_LENGTH_MM + 200.0
    if ball.position.x > depth:
        ball.position, ball.velocity = Point(depth, ball.position.y), ORIGIN


def _rounded(seconds: float | None) -> float | None:
    return None if seconds is None else round(seconds, 2)
