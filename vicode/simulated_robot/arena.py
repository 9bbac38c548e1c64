"""The simulated world: robots with a differential drive among walls, in lock step and repeatable for each seed."""

from dataclasses import dataclass, field
from math import cos, degrees, hypot, radians, sin
from math import dist as distance
from random import Random

import pymunk

from vicode.simulated_robot.laser import RAYS, scan, wrap_degrees
from vicode.simulated_robot.world_map import Point, StartPose, Wall, WorldMap

RADIUS_M = 0.25
MASS_KG = 10.0
_STEP_S = 0.01
_OVERLAP_M = 0.001
_WALL, _ROBOT = 1, 2
_ROBOT_CATEGORY = 2
_FASTEST_M_S, _FASTEST_TURN_DEG_S = 1.0, 180.0
_HEADING_SPREAD_DEG = 15.0
_NOISE_VALUES = 2000


@dataclass(frozen=True, slots=True, kw_only=True)
class Physics:
    """Friction and noise; with `Physics.exact()`, sensors and drive have none.

    Attributes:
        grip: Friction of the wheels on the floor: acceleration in m/s² at which they slip.
        turning_grip: The same of turning, in degrees/s².
        wall_friction: Coefficient of friction against walls and other robots.
        drive_error: Standard deviation of the speeds of the wheels, as a fraction: per robot and per step.
        laser_noise: Standard deviation of each ray, in m.
        position_drift: Random walk of the odometry's position, in m after one second.
        yaw_drift: The same of its heading, in degrees.
    """

    grip: float = 4.0
    turning_grip: float = 720.0
    wall_friction: float = 0.5
    drive_error: float = 0.02
    laser_noise: float = 0.01
    position_drift: float = 0.005
    yaw_drift: float = 0.05

    @staticmethod
    def exact() -> "Physics":
        return Physics(drive_error=0.0, laser_noise=0.0, position_drift=0.0, yaw_drift=0.0)


@dataclass(slots=True, eq=False)
class SimulatedRobot:
    """A disc-shaped robot; `contacts` counts how often it began to touch a wall or another robot."""

    number: int
    body: pymunk.Body
    random: Random
    physics: Physics
    contacts: int = 0
    speed: float = 0.0
    turning_speed: float = 0.0
    driven_m: float = 0.0
    start_angle: float = 0.0
    _drift: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    _wheels: tuple[float, float] = (1.0, 1.0)

    def __post_init__(self) -> None:
        error = self.physics.drive_error
        self.start_angle = self.body.angle
        self._wheels = (self.random.gauss(1.0, error), self.random.gauss(1.0, error))

    @property
    def at(self) -> Point:
        return self.body.position.x, self.body.position.y

    @property
    def yaw(self) -> float:
        """The heading in degrees, from -180 to 180, counter-clockwise."""
        return wrap_degrees(self.body.angle)

    @property
    def turned(self) -> float:
        """Degrees turned since the start, to the left."""
        return degrees(self.body.angle - self.start_angle)

    def drive(self, speed: float, turning_speed: float) -> None:
        """Drive with a speed (m/s) while turning to the left (degrees/s), until the next command."""
        self.speed = max(-_FASTEST_M_S, min(_FASTEST_M_S, speed))
        self.turning_speed = max(-_FASTEST_TURN_DEG_S, min(_FASTEST_TURN_DEG_S, turning_speed))

    def pull(self, seconds: float) -> None:
        """Change the velocity towards the commanded one, as far as the wheels grip."""
        gauss, error = self.random.gauss, self.physics.drive_error
        along, around = self._wheels[0] * gauss(1.0, error), self._wheels[1] * gauss(1.0, error)
        angle = self.body.angle
        wanted = (self.speed * along * cos(angle), self.speed * along * sin(angle))
        self.body.velocity = _approach(self.body.velocity, wanted, self.physics.grip * seconds)
        turning, step = radians(self.turning_speed * around), radians(self.physics.turning_grip) * seconds
        change = turning - self.body.angular_velocity
        self.body.angular_velocity += max(-step, min(step, change))

    def drift(self, seconds: float) -> None:
        """Let the odometry drift."""
        root = seconds**0.5
        for index, rate in enumerate((self.physics.position_drift,) * 2 + (self.physics.yaw_drift,)):
            self._drift[index] += self.random.gauss(0.0, rate * root)

    def odometry(self) -> tuple[float, float, float]:
        """Position and heading as the robot believes them."""
        x, y, yaw = self._drift
        return self.at[0] + x, self.at[1] + y, (self.yaw + yaw + 180.0) % 360.0 - 180.0


class Arena:
    """A world with robots.

    Attributes:
        robots: The robots, at the start poses of the map; further ones start behind the first.
    """

    def __init__(self, world_map: WorldMap, *, robots: int = 1, seed: int = 1, physics: Physics | None = None) -> None:
        self.map = world_map
        self._steps = 0
        self.physics = Physics() if physics is None else physics
        self._walls: tuple[Wall, ...] = tuple(world_map.segments())
        self._space = pymunk.Space()
        self._space.collision_slop = _OVERLAP_M
        for start, end in self._walls:
            wall = pymunk.Segment(self._space.static_body, start, end, 0.0)
            wall.friction, wall.collision_type = self.physics.wall_friction, _WALL
            self._space.add(wall)
        random = Random(seed)
        # Drawing 181 numbers for each scan would take longer than the scan.
        self._laser_noise = [random.gauss(0.0, self.physics.laser_noise) for _ray in range(_NOISE_VALUES + RAYS)]
        poses = world_map.starts or (StartPose(at=(0.0, 0.0), towards=(1.0, 0.0)),)
        self.robots = tuple(self._add_robot(number, poses, random) for number in range(robots))
        self._robot_of = {robot.body: robot for robot in self.robots}
        for kinds in ((_ROBOT, _WALL), (_ROBOT, _ROBOT)):
            self._space.on_collision(*kinds, begin=self._count_contact)

    def advance(self, seconds: float) -> None:
        """Simulate for a time, rounded to steps of 10 ms."""
        steps = round(seconds / _STEP_S)
        for _step in range(steps):
            before = [robot.at for robot in self.robots]
            for robot in self.robots:
                robot.pull(_STEP_S)
            self._space.step(_STEP_S)
            for robot, at in zip(self.robots, before, strict=True):
                robot.driven_m += distance(robot.at, at)
        for robot in self.robots:
            robot.drift(steps * _STEP_S)
        self._steps += steps

    @property
    def now_s(self) -> float:
        """Simulated time."""
        return self._steps * _STEP_S

    def scan(self, robot: SimulatedRobot) -> list[float]:
        """What the laser of a robot measures, in whole mm."""
        discs = [(other.at, RADIUS_M) for other in self.robots if other is not robot]
        exact = scan(robot.at, robot.body.angle, self._walls, discs)
        first = robot.random.randrange(_NOISE_VALUES)
        noise = self._laser_noise[first : first + RAYS]
        return [round(each + off, 3) for each, off in zip(exact, noise, strict=True)]

    def is_blocked(self, start: Point, end: Point) -> bool:
        """Whether a wall is between two points."""
        walls = pymunk.ShapeFilter(mask=pymunk.ShapeFilter.ALL_MASKS() ^ _ROBOT_CATEGORY)
        return self._space.segment_query_first(start, end, 0.0, walls) is not None

    def has_reached_goal(self, robot: SimulatedRobot) -> bool:
        return self.map.is_goal(robot.at)

    def _add_robot(self, number: int, poses: tuple[StartPose, ...], random: Random) -> SimulatedRobot:
        pose = poses[number % len(poses)]
        body = pymunk.Body(MASS_KG, pymunk.moment_for_circle(MASS_KG, 0, RADIUS_M))
        towards = pymunk.Vec2d(*pose.towards) - pose.at
        behind = towards.normalized() * (-3 * RADIUS_M * (number // len(poses)))
        off = (random.uniform(-pose.spread, pose.spread), random.uniform(-pose.spread, pose.spread))
        body.position = behind + pose.at + off
        body.angle = towards.angle + radians(random.uniform(-1, 1) * _HEADING_SPREAD_DEG if pose.spread else 0.0)
        shape = pymunk.Circle(body, RADIUS_M)
        shape.friction, shape.collision_type = self.physics.wall_friction, _ROBOT
        shape.filter = pymunk.ShapeFilter(categories=_ROBOT_CATEGORY)
        self._space.add(body, shape)
        return SimulatedRobot(number=number + 1, body=body, random=Random(random.random()), physics=self.physics)

    def _count_contact(self, arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object) -> None:
        for shape in arbiter.shapes:
            robot = self._robot_of.get(shape.body) if shape.body is not None else None
            if robot is not None:
                robot.contacts += 1


def _approach(velocity: Point, wanted: Point, step: float) -> Point:
    """The velocity changed towards another one by at most `step`."""
    dx, dy = wanted[0] - velocity[0], wanted[1] - velocity[1]
    size = hypot(dx, dy)
    part = 1.0 if size <= step else step / size
    return velocity[0] + part * dx, velocity[1] + part * dy
