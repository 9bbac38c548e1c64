"""The hand-written components, each alone at the top of a tree."""

import pytest
from field.geometry import Point, Pose
from field.head import Head
from field.kicker import Kicker
from field.perception import Perception
from field.stand_up import StandUp
from field.walk import Walk
from field.world import World
from forward.declarations import Kick, Side

from vicode.bica import Component, Root, SimulatedClock

MIDDLE = Pose(x=0.0, y=0.0, heading=0.0)
TICK_NS = 20_000_000


class Bench:
    """A world, one component stepped in it, and a clock to let pass."""

    def __init__(self, component_class: type[Component], world: World, **parameters: object) -> None:
        self.world = world
        self.clock = SimulatedClock()
        self.root = Root(component_class, clock=self.clock, world=world, on_error="stop", **parameters)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds * 1e9 / TICK_NS)):
            self.world.advance(self.clock.now_ns())
            self.root.step()
            self.clock.advance(TICK_NS)


def perceive(world: World, seconds: float) -> Perception:
    bench = Bench(Perception, world)
    bench.run(seconds)
    return bench.root.component(Perception)


def test_perception_finds_the_ball_about_where_it_is() -> None:
    perception = perceive(World(seed=1, robot=MIDDLE, ball=Point(1800.0, 200.0)), 2.0)
    assert perception.ball_age < 0.3
    assert perception.ball_ahead == pytest.approx(1800.0, abs=200.0)
    assert perception.ball_left == pytest.approx(200.0, abs=40.0)
    assert perception.ball_x == pytest.approx(perception.ball_bearing)


def test_perception_measures_with_noise() -> None:
    perception = perceive(World(seed=1, robot=MIDDLE, ball=Point(1800.0, 200.0)), 2.0)
    assert perception.ball_ahead != pytest.approx(1800.0, abs=1e-6)


def test_perception_looks_down_for_a_ball_at_the_feet() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(200.0, 0.0))
    world.robot.tilt = 25.0
    perception = perceive(world, 1.0)
    assert perception.bottom_camera
    assert perception.ball_distance == pytest.approx(200.0, abs=20.0)
    assert perception.ball_y == pytest.approx(0.9, abs=3.0)


def test_perception_knows_no_ball_that_was_never_seen() -> None:
    perception = perceive(World(seed=1, robot=MIDDLE, ball=Point(-1000.0, 0.0)), 1.0)
    assert not perception.ball_seen
    assert perception.ball_age > 100.0
    assert (perception.ball_x, perception.ball_y) == (0.0, 0.0)


def test_perception_remembers_a_ball_while_the_robot_turns_away() -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(1000.0, 0.0))
    bench = Bench(Perception, world)
    bench.run(1.0)
    world.robot.pose = world.robot.odometry = Pose(x=0.0, y=0.0, heading=90.0)
    bench.run(1.0)
    perception = bench.root.component(Perception)
    assert not perception.ball_seen
    assert 0.8 < perception.ball_age < 1.3
    assert perception.ball_bearing == pytest.approx(-90.0, abs=3.0)


def test_perception_sees_the_net_and_locates_the_robot() -> None:
    world = World(seed=1, robot=Pose(x=1000.0, y=0.0, heading=20.0), ball=Point(-1000.0, 0.0))
    perception = perceive(world, 1.0)
    assert perception.net_age < 0.3
    assert perception.net_bearing == pytest.approx(-20.0, abs=6.0)
    assert perception.bearing_to(x=3000.0, y=0.0) == pytest.approx(-20.0, abs=30.0)


def test_head_turns_by_what_it_is_asked_for_and_reports_it() -> None:
    bench = Bench(Head, World(seed=1, robot=MIDDLE), pan=30.0, tilt=-10.0)
    bench.run(0.2)
    head = bench.root.component(Head)
    assert head.pan > 5.0
    assert head.tilt < -3.0
    head.modulate()
    at_rest = bench.world.robot.pan
    bench.run(0.5)
    assert bench.world.robot.pan == pytest.approx(at_rest, abs=4.0)


def test_walk_walks_as_it_is_modulated() -> None:
    bench = Bench(Walk, World(seed=1, robot=MIDDLE, ball=Point(2000.0, 1000.0)), forward=100.0, turn=20.0)
    bench.run(3.0)
    pose = bench.world.robot.pose
    assert pose.x > 100.0
    assert pose.heading == pytest.approx(55.0, abs=15.0)


@pytest.mark.parametrize(("side", "sign"), [(Side.left, 1.0), (Side.right, -1.0)])
def test_kicker_kicks_once_an_activation(side: Side, sign: float) -> None:
    world = World(seed=1, robot=MIDDLE, ball=Point(155.0, 80.0 * sign))
    bench = Bench(Kicker, world, kick=Kick.lateral, side=side)
    bench.run(1.0)
    kicker = bench.root.component(Kicker)
    assert kicker.busy
    assert world.ball.position.y * sign > 200.0
    bench.run(3.0)
    assert not kicker.busy
    assert world.record.kicks == 1


def test_stand_up_gets_the_robot_on_its_feet() -> None:
    world = World(seed=1, robot=MIDDLE)
    world.robot.is_fallen = True
    Bench(StandUp, world).run(4.0)
    assert not world.robot.is_fallen
