"""The simulated field: how the ball rolls, what the cameras see, what the legs do, and that a seed decides it all."""

import math
from random import Random

import pytest
from field import pitch
from field.ball import FRICTION_MM_S2, Ball
from field.camera import Direction, direction_to_ball, place_of_ball, sees_ball, sees_net, view_of
from field.geometry import Point, Pose, normalized
from field.kicks import CONTACT_S, DURATION_S, KICKS, kicked_velocity
from field.robot import STAND_UP_S, Gait
from field.world import STEP_NS, World

MIDDLE = Pose(x=0.0, y=0.0, heading=0.0)
FAR_BALL = Point(2000.0, 1000.0)


def run(world: World, seconds: float) -> None:
    world.advance(round((world.time_s + seconds) * 1e9))


def walk(world: World, gait: Gait, seconds: float) -> None:
    for _ in range(round(seconds * 10)):
        world.robot.walk(gait)
        run(world, 0.1)


def test_pose_and_its_inverse_agree() -> None:
    pose = Pose(x=120.0, y=-40.0, heading=30.0)
    assert pose.to_local(pose.to_field(Point(7.0, -3.0))) == pytest.approx((7.0, -3.0))
    assert pose.to_local(pose.to_field(Point(10.0, 0.0))).bearing == pytest.approx(0.0)


@pytest.mark.parametrize(("angle", "same"), [(190.0, -170.0), (-180.0, -180.0), (180.0, -180.0), (725.0, 5.0)])
def test_angles_are_normalized(angle: float, same: float) -> None:
    assert normalized(angle) == pytest.approx(same)


def test_a_ball_stops_where_friction_says() -> None:
    ball = Ball(position=Point(0.0, 0.0), velocity=Point(1200.0, 0.0))
    ball.roll(100.0)
    assert ball.position.x == pytest.approx(1200.0**2 / (2 * FRICTION_MM_S2))
    assert ball.speed == 0.0


def test_a_ball_rolls_the_same_in_one_step_or_many() -> None:
    at_once = Ball(position=Point(0.0, 0.0), velocity=Point(600.0, 800.0))
    in_steps = Ball(position=Point(0.0, 0.0), velocity=Point(600.0, 800.0))
    at_once.roll(1.0)
    for _ in range(100):
        in_steps.roll(0.01)
    assert in_steps.position == pytest.approx(at_once.position)


def test_feet_push_a_ball_ahead_of_them() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(200.0, 0.0))
    walk(world, Gait(forward=150.0), 3.0)
    ball = world.robot.pose.to_local(world.ball.position)
    assert world.ball.position.x > 250.0
    assert ball.x > 130.0


def test_a_post_sends_the_ball_back() -> None:
    post = Point(pitch.HALF_LENGTH_MM, pitch.GOAL_HALF_WIDTH_MM)
    ball = Ball(position=Point(post.x - 70.0, post.y), velocity=Point(1000.0, 0.0))
    ball.bounce_off_post(post, pitch.POST_RADIUS_MM)
    assert ball.velocity.x == pytest.approx(-500.0)
    assert ball.position.x < post.x - pitch.POST_RADIUS_MM


@pytest.mark.parametrize(
    ("place", "verdict"),
    [
        (Point(3040.0, 600.0), pitch.Whereabouts.GOAL),
        (Point(-3040.0, 0.0), pitch.Whereabouts.OWN_GOAL),
        (Point(3020.0, 0.0), pitch.Whereabouts.IN_PLAY),
        (Point(3040.0, 900.0), pitch.Whereabouts.OUT),
        (Point(0.0, -2040.0), pitch.Whereabouts.OUT),
    ],
)
def test_the_referee(place: Point, verdict: pitch.Whereabouts) -> None:
    assert pitch.whereabouts(place, 32.5) == verdict


def test_a_ball_that_went_out_is_put_back_at_rest() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(500.0, 1900.0))
    world.ball.velocity = Point(0.0, 1000.0)
    run(world, 1.0)
    assert world.record.throw_ins == 1
    assert abs(world.ball.position.y) < pitch.HALF_WIDTH_MM
    assert world.ball.speed == 0.0


def test_a_goal_counts_once_and_ends_the_world_a_little_later() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(2800.0, 0.0))
    world.ball.velocity = Point(1500.0, 0.0)
    run(world, 1.0)
    assert (world.record.goals, world.finished) == (1, False)
    run(world, 5.0)
    assert (world.record.goals, world.finished) == (1, True)
    assert world.summary()["first_goal_s"] == pytest.approx(0.16, abs=0.03)


def test_the_cameras_see_a_cone() -> None:
    ahead = view_of(0.0, 0.0, is_bottom=False)
    assert sees_ball(ahead, Point(2500.0, 0.0))
    assert not sees_ball(ahead, Point(600.0, 0.0)), "too near for the top camera"
    assert sees_ball(view_of(0.0, 0.0, is_bottom=True), Point(600.0, 0.0))
    assert not sees_ball(ahead, Point(2500.0, 1300.0)), "27 degrees to the left"
    assert sees_ball(view_of(20.0, 0.0, is_bottom=False), Point(2500.0, 1300.0))
    assert not sees_ball(ahead, Point(4800.0, 0.0)), "too far away"
    assert not sees_ball(ahead, Point(-2500.0, 0.0)), "behind"


def test_the_net_is_seen_above_the_horizon_too() -> None:
    assert sees_net(view_of(0.0, -10.0, is_bottom=False), MIDDLE)
    assert not sees_net(view_of(0.0, 29.0, is_bottom=False), MIDDLE), "the image ends below the net"
    assert not sees_net(view_of(0.0, -10.0, is_bottom=False), Pose(x=0.0, y=0.0, heading=90.0))


@pytest.mark.parametrize("place", [Point(150.0, 40.0), Point(900.0, -700.0), Point(3500.0, 100.0)])
def test_projection_and_its_inverse_agree(place: Point) -> None:
    assert place_of_ball(direction_to_ball(place)) == pytest.approx(place)


def test_a_ball_at_the_horizon_is_far_but_not_at_infinity() -> None:
    assert place_of_ball(Direction(bearing=0.0, down=-5.0)).length < 30_000.0


@pytest.mark.parametrize(("kind", "direction"), [("front", 0.0), ("diagonal", 45.0), ("lateral", 90.0)])
@pytest.mark.parametrize("is_left", [True, False])
def test_kicks_go_where_they_are_meant_to(kind: str, direction: float, is_left: bool) -> None:
    mirror = 1.0 if is_left else -1.0
    spot = KICKS[kind].spot
    velocity = kicked_velocity(KICKS[kind], Point(spot.x, spot.y * mirror), is_left=is_left, noise=Random(3))
    assert velocity is not None
    assert velocity.bearing == pytest.approx(direction * mirror, abs=10.0)
    assert velocity.length == pytest.approx(KICKS[kind].speed, rel=0.3)


def test_a_kick_misses_a_ball_out_of_reach() -> None:
    assert kicked_velocity(KICKS["front"], Point(300.0, 50.0), is_left=True, noise=Random(1)) is None


def test_the_foot_strikes_in_the_middle_of_the_kick() -> None:
    world = World(seed=1, robot=MIDDLE, ball=KICKS["front"].spot)
    assert world.robot.kick(KICKS["front"], is_left=True)
    assert not world.robot.kick(KICKS["front"], is_left=True), "one kick at a time"
    run(world, CONTACT_S - 0.1)
    assert world.ball.speed == 0.0
    run(world, 0.2)
    assert world.ball.velocity.x > 1000.0
    assert (world.record.kicks, world.record.hits) == (1, 1)
    run(world, DURATION_S)
    assert world.robot.swing is None


def test_a_command_that_is_not_renewed_lets_the_robot_stand() -> None:
    world = World(seed=1, robot=MIDDLE, ball=FAR_BALL)
    walk(world, Gait(forward=200.0), 2.0)
    assert 250.0 < world.robot.pose.x < 450.0
    run(world, 2.0)
    stopped_at = world.robot.pose
    run(world, 2.0)
    assert world.robot.pose == stopped_at


def test_the_neck_has_its_limits() -> None:
    world = World(seed=1, robot=MIDDLE, ball=FAR_BALL)
    for _ in range(40):
        world.robot.turn_head(1000.0, 1000.0)
        run(world, 0.1)
    assert (world.robot.pan, world.robot.tilt) == (119.0, 29.0)


def test_a_fallen_robot_neither_walks_nor_sees_until_it_stood_up() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(1500.0, 0.0))
    assert world.look(is_bottom=False).ball is not None
    world.robot.is_fallen = True
    walk(world, Gait(forward=200.0), 1.0)
    assert world.robot.pose == MIDDLE
    assert world.look(is_bottom=False).ball is None
    world.robot.stand_up()
    run(world, STAND_UP_S + 0.1)
    assert not world.robot.is_fallen


def test_the_robot_stays_on_the_carpet() -> None:
    world = World(seed=1, robot=Pose(x=3300.0, y=0.0, heading=0.0), ball=FAR_BALL)
    walk(world, Gait(forward=200.0), 5.0)
    assert world.robot.pose.x <= pitch.HALF_LENGTH_MM + pitch.BORDER_MM


def test_a_seed_decides_everything() -> None:
    first, again, other = World(seed=4), World(seed=4), World(seed=5)
    assert first.snapshot() == again.snapshot() != other.snapshot()
    walk(first, Gait(forward=150.0, turn=10.0), 3.0)
    walk(again, Gait(forward=150.0, turn=10.0), 3.0)
    assert first.robot.pose == again.robot.pose


def test_time_passes_in_whole_steps_however_it_is_cut() -> None:
    coarse, fine = World(seed=2, ball=Point(0.0, 0.0)), World(seed=2, ball=Point(0.0, 0.0))
    for world in (coarse, fine):
        world.ball.velocity = Point(0.0, 700.0)
    coarse.advance(1_000_000_000)
    for now_ns in range(0, 1_000_000_001, STEP_NS // 4):
        fine.advance(now_ns)
    assert fine.ball.position == coarse.ball.position
    assert fine.time_s == coarse.time_s == 1.0


def test_snapshot_is_small_and_plain() -> None:
    snapshot = World(seed=1).snapshot()
    assert {"robot_x", "robot_y", "heading", "pan", "ball_x", "ball_y", "net_bearing", "goals"} <= snapshot.keys()
    assert all(math.isfinite(value) for value in snapshot.values())
