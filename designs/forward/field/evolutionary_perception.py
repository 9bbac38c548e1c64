"""Perception from simulated images: the ball by a genetic algorithm, the pose by an evolutionary one.

It has the interface of `Perception` and reads no true positions; the profile `evolutionary` uses it.
"""

from field.ball_tracker import GeneticBallTracker
from field.camera import view_of
from field.geometry import Point
from field.landmarks import Kind, detect_landmarks
from field.localization import EvolutionaryLocalization
from field.perception import Perception
from field.pitch import NET
from field.simulated_images import take_image
from vicode.bica import Root


class EvolutionaryPerception(Perception):
    """Evolves hypotheses about the ball and about the pose of the robot with each image."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        world = self.world
        self._camera_noise = world.stream("images")
        self._tracker = GeneticBallTracker(world.stream("ball tracker"))
        self._localization = EvolutionaryLocalization(world.stream("localization"), world.robot.odometry)

    def work(self) -> None:
        """Take an image and update all outputs."""
        robot = self.world.robot
        self.fallen = robot.is_fallen
        self.neck_pan, self.neck_tilt = robot.pan, robot.tilt
        is_bottom = self._choose_camera()
        self._see_ball(is_bottom=is_bottom)
        self._see_landmarks(is_bottom=is_bottom)
        self._tell_ball(robot.odometry)
        self._tell_net(robot.odometry)

    def bearing_to(self, *, x: float, y: float) -> float:
        """Return the direction to a field position in degrees to the left; as if at the center before any landmark."""
        pose = self._localization.pose
        return (Point(x, y) if pose is None else pose.to_local(Point(x, y))).bearing

    def _see_ball(self, *, is_bottom: bool) -> None:
        found = self._tracker.update(take_image(self.world, self._camera_noise, is_bottom=is_bottom))
        self.ball_seen = found is not None
        if found is not None:
            self._ball, self._ball_s = found, self.root.now_ns / 1e9

    def _see_landmarks(self, *, is_bottom: bool) -> None:
        """Localize the robot; a post in the image says that the net is seen, the pose says where it is."""
        robot, now_s = self.world.robot, self.root.now_ns / 1e9
        view = view_of(robot.pan, robot.tilt, is_bottom=is_bottom)
        sightings = [] if robot.is_fallen else detect_landmarks(robot.pose, view, self._camera_noise)
        self._localization.update(robot.odometry, sightings, now_s)
        pose = self._localization.pose
        self.net_seen = pose is not None and any(sighting.kind is Kind.NET_POST for sighting in sightings)
        if pose is not None and self.net_seen:
            self._net, self._net_s = robot.odometry.to_field(pose.to_local(NET)), now_s
