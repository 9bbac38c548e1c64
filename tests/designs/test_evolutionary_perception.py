"""The genetic algorithm finds the ball, the evolutionary one the pose; solutions by other methods are the standard."""

import math
import re
import subprocess
import sys
from random import Random

import pytest
from field.ball_tracker import GeneticBallTracker
from field.camera import BOTTOM_CAMERA_PITCH, view_of
from field.evolutionary_perception import EvolutionaryPerception
from field.geometry import Point, Pose, normalized
from field.landmarks import LANDMARKS, Kind, Sighting, detect_landmarks
from field.localization import EvolutionaryLocalization
from field.simulated_images import BallImage, Optics, take_image
from field.world import World
from hypothesis import given
from hypothesis import strategies as st

from tests.manual.code_blocks import ROOT
from vicode.bica import Root, SimulatedClock

MIDDLE = Pose(x=0.0, y=0.0, heading=0.0)
IMAGE_S = 1 / 15


def centroid_of(image: BallImage, near: tuple[float, float]) -> tuple[float, float]:
    """Return the mean position of the positive pixels around a pixel."""
    pixels = [(column, row) for row in range(120) for column in range(160) if image.rows[row] >> column & 1]
    ball = [pixel for pixel in pixels if math.dist(pixel, near) < 20.0]
    return sum(x for x, _ in ball) / len(ball) + 0.5, sum(y for _, y in ball) / len(ball) + 0.5


def pixel_of(x: float, y: float, down: float) -> tuple[float, float]:
    """Project a ball on the ground with vectors: the right, lower and optical axes of a camera that looks ahead."""
    focal = 80.0 / math.tan(math.radians(23.2))
    tilt = math.radians(down)
    ray = (x, y, 32.5 - 480.0)
    axes = ((0.0, -1.0, 0.0), (-math.sin(tilt), 0.0, -math.cos(tilt)), (math.cos(tilt), 0.0, -math.sin(tilt)))
    right, below, depth = (sum(a * b for a, b in zip(axis, ray, strict=True)) for axis in axes)
    return 80.0 + focal * right / depth, 60.0 + focal * below / depth


def brute_force_ball(images: list[BallImage], about: Point, down: float) -> Point:
    """Return the place on a grid whose projection has the least squared distance from the pixels of the images."""
    means = [centroid_of(image, pixel_of(about.x, about.y, down)) for image in images]
    mean = (sum(x for x, _ in means) / len(means), sum(y for _, y in means) / len(means))
    steps = range(-20, 21)
    grid = [(about.x * (1 + 0.01 * i), about.y + about.x * 0.002 * j) for i in steps for j in steps]
    return Point(*min(grid, key=lambda place: math.dist(pixel_of(*place, down), mean)))


@pytest.mark.parametrize(("distance", "tilt", "is_bottom"), [(200, 20, True), (900, 15, False), (2500, 5, False)])
def test_the_ball_is_found_as_exactly_as_by_least_squares(distance: int, tilt: int, is_bottom: bool) -> None:
    genetic, exact = [], []
    for seed in range(8):
        world = World(seed, robot=MIDDLE, ball=Point(distance, 0.1 * distance))
        world.robot.tilt = tilt
        noise, tracker = world.stream("images"), GeneticBallTracker(world.stream("ball tracker"))
        seen = []
        for _ in range(8):
            image = take_image(world, noise, is_bottom=is_bottom)
            found = tracker.update(image)
            if found is not None:
                seen.append(image)
                genetic.append(found.minus(world.ball.position).length)
                down = tilt + (BOTTOM_CAMERA_PITCH if is_bottom else 0.0)
                exact.append(brute_force_ball(seen[-2:], world.ball.position, down).minus(world.ball.position).length)
    assert len(genetic) > 40
    assert sum(genetic) < 1.6 * sum(exact) + 3.0 * len(exact)


def test_no_ball_is_found_where_there_is_none() -> None:
    world = World(1, robot=MIDDLE, ball=Point(-1000.0, 0.0))
    noise, tracker = world.stream("images"), GeneticBallTracker(world.stream("ball tracker"))
    found = [tracker.update(take_image(world, noise, is_bottom=False)) for _ in range(200)]
    assert sum(place is not None for place in found) <= 4


def test_a_patch_of_color_in_one_image_is_not_a_ball() -> None:
    optics = Optics(x=0.0, y=0.0, pan=0.0, down=10.0)
    empty = BallImage(rows=(0,) * 120, optics=optics)
    patch = BallImage(rows=tuple(0b11111100 << 70 if 60 <= row < 66 else 0 for row in range(120)), optics=optics)
    tracker = GeneticBallTracker(Random(1))
    assert [tracker.update(image) for image in (empty, patch, empty)] == [None, None, None]
    assert tracker.update(patch) is not None


def test_an_area_of_the_color_of_the_ball_is_not_a_ball() -> None:
    optics = Optics(x=0.0, y=0.0, pan=0.0, down=20.0)
    shirt = BallImage(rows=tuple(((1 << 60) - 1) << 50 if 30 <= row < 90 else 0 for row in range(120)), optics=optics)
    tracker = GeneticBallTracker(Random(1))
    assert [tracker.update(shirt) for _ in range(20)] == [None] * 20


@given(st.floats(100.0, 4000.0), st.floats(-20.0, 20.0), st.floats(0.0, 80.0))
def test_a_pixel_is_the_place_that_is_projected_there(distance: float, bearing: float, down: float) -> None:
    optics = Optics(x=300.0, y=-200.0, pan=bearing / 2, down=down)
    ball = Point(distance, 0.0).turned(bearing)
    projection = optics.project(Point(ball.x + 300.0, ball.y - 200.0))
    if projection is not None:
        place = optics.place(projection[0], projection[1])
        assert place is not None
        assert place.minus(Point(ball.x + 300.0, ball.y - 200.0)).length < 0.01


class Walker:
    """A robot that turns its head from side to side and localizes itself."""

    def __init__(self, pose: Pose, seed: int = 1) -> None:
        self.world = World(seed, robot=pose, ball=Point(0.0, -1900.0))
        self.noise = self.world.stream("images")
        self.localization = EvolutionaryLocalization(self.world.stream("localization"), self.world.robot.odometry)
        self.now_s = 0.0

    def look(self, seconds: float) -> None:
        robot = self.world.robot
        for _ in range(round(seconds / IMAGE_S)):
            self.now_s += IMAGE_S
            robot.pan, robot.tilt = 70.0 * math.sin(self.now_s), 8.0
            view = view_of(robot.pan, robot.tilt, is_bottom=False)
            self.localization.update(robot.odometry, detect_landmarks(robot.pose, view, self.noise), self.now_s)

    def error(self) -> tuple[float, float]:
        pose, true = self.localization.pose, self.world.robot.pose
        assert pose is not None
        return math.hypot(pose.x - true.x, pose.y - true.y), abs(normalized(pose.heading - true.heading))


@pytest.mark.parametrize(
    "pose", [Pose(x=-1000.0, y=500.0, heading=30.0), Pose(x=800.0, y=-900.0, heading=170.0), MIDDLE]
)
def test_the_robot_finds_out_where_it_is(pose: Pose) -> None:
    walker = Walker(pose)
    walker.look(10.0)
    distance, angle = walker.error()
    assert distance < 250.0
    assert angle < 8.0


def test_a_robot_that_was_carried_away_finds_out() -> None:
    walker = Walker(Pose(x=-1000.0, y=500.0, heading=30.0))
    walker.look(10.0)
    walker.world.robot.pose = Pose(x=1200.0, y=-700.0, heading=-150.0)
    assert walker.error()[0] > 2000.0
    walker.look(15.0)
    assert walker.error()[0] < 250.0


def test_without_a_landmark_only_odometry_moves_the_pose() -> None:
    walker = Walker(Pose(x=-1000.0, y=500.0, heading=30.0))
    walker.localization.update(Pose(x=10.0, y=0.0, heading=5.0), [], 0.0)
    assert walker.localization.pose is None
    walker.look(10.0)
    before = walker.localization.pose
    for step in range(1, 101):
        walker.localization.update(Pose(x=5.0 * step, y=0.0, heading=0.9 * step), [], 10.0 + step)
    after = walker.localization.pose
    assert before is not None
    assert after is not None
    assert tuple(before.to_local(Point(after.x, after.y))) == pytest.approx((500.0, 0.0), abs=30.0)
    assert normalized(after.heading - before.heading) == pytest.approx(90.0, abs=1.0)


def false_sightings(noise: Random) -> list[Sighting]:
    kind, bearing = noise.choice(list(Kind)), noise.uniform(-180.0, 180.0)
    return [Sighting(kind=kind, bearing=bearing, distance=noise.choice([None, noise.uniform(300.0, 5000.0)]))]


def test_a_second_of_false_landmarks_changes_little_and_a_minute_breaks_nothing() -> None:
    walker = Walker(Pose(x=-1000.0, y=500.0, heading=30.0))
    walker.look(10.0)
    for image in range(900):
        if image == 15:
            assert walker.error()[0] < 400.0
        walker.localization.update(walker.world.robot.odometry, false_sightings(walker.noise), 10.0 + image * IMAGE_S)
    walker.now_s = 70.0
    walker.look(15.0)
    assert walker.error()[0] < 250.0


def test_a_symmetric_pose_stays_a_race_until_a_post_is_seen() -> None:
    true, localization = Pose(x=1000.0, y=200.0, heading=60.0), EvolutionaryLocalization(Random(1), MIDDLE)

    def sight(*kinds: Kind) -> list[Sighting]:
        local = [(kind, true.to_local(place)) for kind in kinds for place in LANDMARKS[kind]]
        return [Sighting(kind=kind, bearing=place.bearing, distance=place.length) for kind, place in local]

    for image in range(60):
        localization.update(MIDDLE, sight(Kind.CROSSING, Kind.JUNCTION), image * IMAGE_S)
    healthy = [race.pose for race in localization.races if race.health > 0.8]
    assert sorted(round(pose.x, -3) for pose in healthy) == [-1000.0, 1000.0]
    for image in range(60, 140):
        localization.update(MIDDLE, sight(Kind.CROSSING, Kind.NET_POST), image * IMAGE_S)
    assert localization.pose is not None
    assert math.hypot(localization.pose.x - true.x, localization.pose.y - true.y) < 100.0


def test_the_component_perceives_alike_with_the_same_seed() -> None:
    outputs = []
    for _ in range(2):
        world, clock = World(seed=1, robot=MIDDLE, ball=Point(1800.0, 200.0)), SimulatedClock()
        root = Root(EvolutionaryPerception, clock=clock, world=world, on_error="stop")
        for _ in range(30):
            world.advance(clock.now_ns())
            root.step()
            clock.advance(66_666_667)
        perception = root.component(EvolutionaryPerception)
        outputs.append((perception.ball_ahead, perception.net_bearing, perception.bearing_to(x=3000.0, y=0.0)))
        assert perception.ball_ahead == pytest.approx(1800.0, abs=150.0)
        assert perception.ball_left == pytest.approx(200.0, abs=40.0)
    assert outputs[0] == outputs[1]


def test_a_player_with_this_perception_scores() -> None:
    words = "run designs/forward/player.yaml --profile evolutionary --seed 2 --seconds 60 --plain"
    command = [sys.executable, "-m", "vicode", *words.split()]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    assert re.search(r"EvolutionaryPerception", done.stdout)
    assert re.search(r"goals 1\b", done.stdout)
