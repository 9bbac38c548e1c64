"""Simulated perception: ball, net and the pose of the robot are read from the world, with noise.

There are no images and no landmarks. A camera of the world returns ball and net if they are in its view. On a robot, a
component with the same interface detects them in images and localizes the robot on the field.
"""

import math

from field.camera import Direction, direction_to_ball, place_of_ball, view_of
from field.geometry import Point, Pose, normalized
from field.world import World
from vicode.bica import Component, Root

NEVER_S = 1000.0

_MISSED_IMAGES = 0.05
_ANGLE_NOISE = 0.4
_NET_NOISE = 1.5
_NET_DISTANCE_NOISE = 0.05
_AGREEMENT = 0.2
_LOST_S = 0.2
_TO_BOTTOM_DEG = 38.0
_TO_TOP_DEG = 24.0


class Perception(Component):
    """Uses one of the two simulated cameras at a time; `bottom_camera` is the one that should see the ball.

    Positions are stored in the odometry frame, so that they stay valid while the robot walks.
    """

    frequency_hz = 15.0
    world: World

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.ball_seen = False
        self.ball_x = 0.0
        self.ball_y = 0.0
        self.ball_distance = 0.0
        self.ball_bearing = 0.0
        self.ball_ahead = 0.0
        self.ball_left = 0.0
        self.ball_age = NEVER_S
        self.net_seen = False
        self.net_bearing = 0.0
        self.net_distance = 0.0
        self.net_age = NEVER_S
        self.bottom_camera = False
        self.neck_pan = 0.0
        self.neck_tilt = 0.0
        self.fallen = False
        self._noise = self.world.stream("perception")
        self._is_bottom_next = False
        self._ball: Point | None = None
        self._ball_s = -NEVER_S
        self._net: Point | None = None
        self._net_s = -NEVER_S
        self._located = self.world.robot.pose
        self._located_at = self.world.robot.odometry

    def work(self) -> None:
        """Take an image and update all outputs."""
        robot = self.world.robot
        self.fallen = robot.is_fallen
        self.neck_pan, self.neck_tilt = robot.pan, robot.tilt
        image = self.world.look(is_bottom=self._choose_camera())
        self.ball_seen = image.ball is not None and self._noise.random() >= _MISSED_IMAGES
        self.net_seen = image.net is not None and self._noise.random() >= _MISSED_IMAGES
        if image.ball is not None and self.ball_seen:
            self._remember_ball(image.ball, robot.odometry)
        if image.net is not None and self.net_seen:
            self._remember_net(image.net, robot.odometry)
            self._locate()
        self._tell_ball(robot.odometry)
        self._tell_net(robot.odometry)

    def bearing_to(self, *, x: float, y: float) -> float:
        """Return the direction to a field position in degrees to the left, by simulated localization and odometry."""
        moved = self._located_at.to_local(Point(self.world.robot.odometry.x, self.world.robot.odometry.y))
        turned = self.world.robot.odometry.heading - self._located_at.heading
        place = self._located.to_field(moved)
        here = Pose(x=place.x, y=place.y, heading=self._located.heading + turned)
        return here.to_local(Point(x, y)).bearing

    def _remember_ball(self, local: Point, odometry: Pose) -> None:
        exact = direction_to_ball(local)
        draw = self._noise.gauss
        seen = Direction(bearing=exact.bearing + draw(0.0, _ANGLE_NOISE), down=exact.down + draw(0.0, _ANGLE_NOISE))
        place = odometry.to_field(place_of_ball(seen))
        if self._ball is not None and place.minus(self._ball).length < _AGREEMENT * place_of_ball(seen).length:
            # Consistent detections mean that the ball rests; their mean is less noisy than the last one.
            place = Point((place.x + self._ball.x) / 2, (place.y + self._ball.y) / 2)
        self._ball, self._ball_s = place, self.root.now_ns / 1e9

    def _remember_net(self, local: Point, odometry: Pose) -> None:
        distance = local.length * (1.0 + self._noise.gauss(0.0, _NET_DISTANCE_NOISE))
        bearing = local.bearing + self._noise.gauss(0.0, _NET_NOISE)
        self._net = odometry.to_field(Point(distance, 0.0).turned(bearing))
        self._net_s = self.root.now_ns / 1e9

    def _locate(self) -> None:
        """Simulate localization: the true pose, with noise of the size of the paper's error, 14 cm and 8 degrees."""
        pose, draw = self.world.robot.pose, self._noise.gauss
        x, y, heading = pose.x + draw(0.0, 140.0), pose.y + draw(0.0, 140.0), pose.heading + draw(0.0, 8.4)
        self._located = Pose(x=x, y=y, heading=normalized(heading))
        self._located_at = self.world.robot.odometry

    def _choose_camera(self) -> bool:
        """Whether to use the bottom camera next: the camera that should see the ball, or both in turn to find it."""
        if self.ball_age > _LOST_S:
            self._is_bottom_next = not self._is_bottom_next
            return self._is_bottom_next
        return self.bottom_camera

    def _tell_ball(self, odometry: Pose) -> None:
        self.ball_age = min(NEVER_S, self.root.now_ns / 1e9 - self._ball_s)
        if self._ball is None:
            return
        local = odometry.to_local(self._ball)
        direction = direction_to_ball(local)
        self.bottom_camera = direction.down > (_TO_TOP_DEG if self.bottom_camera else _TO_BOTTOM_DEG)
        view = view_of(self.neck_pan, self.neck_tilt, is_bottom=self.bottom_camera)
        self.ball_ahead, self.ball_left = local
        self.ball_distance, self.ball_bearing = local.length, direction.bearing
        self.ball_x = normalized(direction.bearing - view.pan)
        self.ball_y = direction.down - view.down

    def _tell_net(self, odometry: Pose) -> None:
        self.net_age = min(NEVER_S, self.root.now_ns / 1e9 - self._net_s)
        if self._net is None:
            return
        local = odometry.to_local(self._net)
        self.net_distance = math.hypot(*local)
        self.net_bearing = local.bearing
