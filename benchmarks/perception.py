"""Errors and times of the evolutionary perception of the sample player, for docs/perception.md.

`python -m benchmarks.perception [--seeds N]`; `--stand-in` plays with the stand-in instead. Times are processor times.
"""

import argparse
import math
import statistics
import sys
import time
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "designs/forward"), str(ROOT / "generated/python")]

import field.perception  # noqa: E402
from field.ball_tracker import GeneticBallTracker  # noqa: E402
from field.camera import view_of  # noqa: E402
from field.evolutionary_perception import EvolutionaryPerception  # noqa: E402
from field.geometry import Point, Pose, limited, normalized  # noqa: E402
from field.landmarks import detect_landmarks  # noqa: E402
from field.localization import EvolutionaryLocalization  # noqa: E402
from field.robot import Gait, Robot  # noqa: E402
from field.simulated_images import take_image  # noqa: E402
from field.world import World  # noqa: E402

from vicode.bica import Root, SimulatedClock  # noqa: E402

IMAGE_S = 1 / 15
TICK_NS = round(1e9 / 60)
WALK_S = 60.0
FOUND_MM, FOUND_DEG, STAYS_S = 500.0, 20.0, 2.0
CORNERS = [Point(1500.0, 1000.0), Point(-1500.0, -1000.0), Point(1500.0, -1000.0), Point(-1500.0, 1000.0)]

Error = tuple[float, float]


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--stand-in", action="store_true")
    args = parser.parse_args()
    seeds = range(1, args.seeds + 1)
    if not args.stand_in:
        for distance, tilt, is_bottom in [(200, 20, True), (1000, 15, False), (2000, 5, False), (4000, 5, False)]:
            measure_ball(seeds, distance, tilt, is_bottom=is_bottom)
        measure_walks(seeds)
        field.perception.Perception = EvolutionaryPerception  # as the profile does
    measure_games(seeds)


def measure_ball(seeds: Iterable[int], distance: float, tilt: float, *, is_bottom: bool) -> None:
    """Track a ball at rest for 40 images."""
    errors, milliseconds = [], []
    for seed in seeds:
        world = World(seed, robot=Pose(x=-2000.0, y=0.0, heading=0.0), ball=Point(distance - 2000.0, 0.0))
        world.robot.tilt = tilt
        noise, tracker = world.stream("images"), GeneticBallTracker(world.stream("ball tracker"))
        for _ in range(40):
            image = take_image(world, noise, is_bottom=is_bottom)
            begin = time.process_time()
            found = tracker.update(image)
            milliseconds.append(1000 * (time.process_time() - begin))
            errors += [] if found is None else [found.minus(Point(distance, 0.0)).length]
    share = len(errors) / len(milliseconds)
    print(
        f"ball at {distance} mm: in {share:.0%} of images, {spread(errors)} mm, {spread(milliseconds)} ms", flush=True
    )


def measure_walks(seeds: Iterable[int]) -> None:
    """Walk between four places, turning the head; after a minute it is carried away, and walks another one."""
    errors, milliseconds, first, again = [], [], [], []
    for seed in seeds:
        world = World(seed, ball=Point(0.0, 1900.0))
        localization = EvolutionaryLocalization(world.stream("localization"), world.robot.odometry)
        draw = world.stream("kidnapping").uniform
        walked = walk(world, localization, milliseconds, 0.0)
        world.robot.pose = Pose(x=draw(-2500.0, 2500.0), y=draw(-1500.0, 1500.0), heading=draw(-180.0, 180.0))
        carried = walk(world, localization, milliseconds, WALK_S)
        for values, delays in ((walked, first), (carried, again)):
            index = first_index(values)
            delays.append(math.inf if index is None else index * IMAGE_S)
            errors += [] if index is None else values[index:]
    report_pose("walk", errors)
    print(f"  {spread(milliseconds)} ms per image")
    for name, delays in (("from an unknown place", first), ("after kidnapping", again)):
        found = [delay for delay in delays if delay < math.inf]
        median = statistics.median(delays)
        print(f"  {name}: found in {len(found)} of {len(delays)}, median {median:.1f} s, at most {max(delays):.1f} s")


def walk(
    world: World, localization: EvolutionaryLocalization, milliseconds: list[float], begin_s: float
) -> list[Error]:
    """Walk for a minute; return the errors of each image."""
    robot, noise, errors, corner = world.robot, world.stream(f"images {begin_s}"), [], 0
    for image in range(round(WALK_S / IMAGE_S)):
        now_s = begin_s + image * IMAGE_S
        world.advance(round(now_s * 1e9))
        corner += robot.pose.to_local(CORNERS[corner % 4]).length < 300.0
        command(robot, robot.pose.to_local(CORNERS[corner % 4]).bearing, now_s)
        view = view_of(robot.pan, robot.tilt, is_bottom=False)
        sightings = [] if robot.is_fallen else detect_landmarks(robot.pose, view, noise)
        begin = time.process_time()
        localization.update(robot.odometry, sightings, now_s)
        milliseconds.append(1000 * (time.process_time() - begin))
        errors.append(error(localization.pose, robot.pose))
    return errors


def command(robot: Robot, bearing: float, now_s: float) -> None:
    """Walk towards a bearing while the head turns from side to side."""
    robot.walk(Gait(forward=180.0 if abs(bearing) < 40.0 else 0.0, turn=limited(bearing, 40.0)))
    robot.turn_head(4 * (70.0 * math.sin(now_s) - robot.pan), 4 * (8.0 - robot.tilt))
    if robot.is_fallen:
        robot.stand_up()


def measure_games(seeds: Iterable[int]) -> None:
    """Play for up to two minutes; the pose counts from the first image in which it is right."""
    goals_s, errors = [], []
    for seed in seeds:
        world = World(seed)
        played = play(world)
        errors += played[first_index(played) or 0 :]
        goals_s.append(world.record.first_goal_s or math.inf)
    goals = sum(goal_s < math.inf for goal_s in goals_s)
    print(f"goals in {goals} of {len(goals_s)} games, median {statistics.median(goals_s):.1f} s")
    if errors:
        report_pose("games", errors)


def play(world: World) -> list[Error]:
    """Play a game as `vicode run` does; return the errors of the evolved pose."""
    from forward.player import Player  # noqa: PLC0415  # imports the class that is `Perception` now

    clock, errors = SimulatedClock(), []
    root = Root(Player, clock=clock, world=world, on_error="stop")
    while clock.now_ns() < 120e9 and not world.finished:
        world.advance(clock.now_ns())
        root.step()
        perception = root.component(field.perception.Perception)
        if isinstance(perception, EvolutionaryPerception):
            errors.append(error(perception._localization.pose, world.robot.pose))
        clock.advance(TICK_NS)
    return errors


def error(pose: Pose | None, true: Pose) -> Error:
    """Return the errors of a pose in mm and degrees."""
    if pose is None:
        return math.inf, 180.0
    return Point(pose.x - true.x, pose.y - true.y).length, abs(normalized(pose.heading - true.heading))


def first_index(errors: list[Error]) -> int | None:
    """Return the first image from which the pose is right for two seconds."""
    is_right = [distance < FOUND_MM and angle < FOUND_DEG for distance, angle in errors]
    count = round(STAYS_S / IMAGE_S)
    return next((index for index in range(len(is_right) - count) if all(is_right[index : index + count])), None)


def report_pose(name: str, errors: list[Error]) -> None:
    """Print the errors of poses."""
    distances, angles = zip(*errors, strict=True)
    wrong = statistics.mean(distance > FOUND_MM for distance in distances)
    print(f"{name}: {spread(distances)} mm, {spread(angles)} degrees, {wrong:.1%} of images off by more than 500 mm")


def spread(values: Iterable[float]) -> str:
    """Format mean, standard deviation and 95th percentile."""
    ordered = sorted(values)
    percentile = ordered[int(0.95 * len(ordered))]
    return f"{statistics.mean(ordered):.1f} ± {statistics.pstdev(ordered):.1f} (95 %: {percentile:.1f})"


if __name__ == "__main__":
    main()
