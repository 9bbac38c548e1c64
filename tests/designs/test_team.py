"""The team: roles that the robots agree on by messages, and a pitch that is the same for each seed."""

from collections import Counter
from random import Random

import pytest
from pitch import radio
from pitch.physics import BALL_RADIUS, HALF_LENGTH, HALF_WIDTH, KICK_SPEED, ROBOT_RADIUS, Pitch, Robot
from pitch.world import MATCH_S, Match, World
from team.player import Player

from vicode.bica import Root, SimulatedClock
from vicode.bica.match import play

ROLES = ["Attack", "Defend", "Keep"]


def watch_roles(match: Match, seconds: float) -> list[tuple[str, ...]]:
    """The roles of the home team in each iteration."""
    seen = []

    class Watched(Player):
        def step(self) -> None:
            super().step()
            number = self.world.robot.number
            if self.world.robot.side == 1:
                if number == 1:
                    seen.append([])
                seen[-1].append(self.state)

    play(match, (Watched, Watched), seconds)
    return [tuple(each) for each in seen]


def test_each_robot_has_a_role_of_its_own_and_they_exchange_them() -> None:
    seen = watch_roles(World.start_match(1), MATCH_S)
    counts = Counter(tuple(sorted(roles)) for roles in seen)
    assert counts[tuple(ROLES)] > 0.6 * len(seen)
    # Two forwards may meet until a message tells them.
    assert sum(count for roles, count in counts.items() if roles.count("Attack") > 1) < 0.01 * len(seen)
    for number in range(3):
        assert {roles[number] for roles in seen} == set(ROLES)


def test_without_messages_all_want_the_ball(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(radio, "LOST", 1.0)
    seen = watch_roles(World.start_match(1), 10)
    assert seen[-1] == ("Attack", "Attack", "Attack")


def test_a_seed_is_a_match() -> None:
    one, again, other = (play(World.start_match(seed), (Player, Player), 60) for seed in (1, 1, 2))
    assert one == again
    assert one["stopped"] == "limit"
    assert one["errors"] == 0
    assert one["world"] != other["world"]


def test_a_match_ends_with_goals() -> None:
    summary = play(World.start_match(1), (Player, Player), 1000)
    assert (summary["stopped"], summary["time_ns"]) == ("finished", MATCH_S * 1e9)
    assert summary["world"]["goals_a"] + summary["world"]["goals_b"] > 0
    exchanged = play(World.start_match(1), (Player, Player), 1000, exchange=True)["world"]
    assert (exchanged["goals_b"], exchanged["goals_a"]) == (summary["world"]["goals_a"], summary["world"]["goals_b"])


def test_a_robot_alone_scores() -> None:
    world, clock = World(seed=1), SimulatedClock()
    root = Root(Player, world=world, clock=clock)
    while clock.now_ns() < 30e9:
        world.advance(clock.now_ns())
        root.step()
        clock.advance(20_000_000)
    assert world.summary()["goals"] > 0


def make_pitch() -> tuple[Pitch, Robot]:
    """A pitch with one robot in a corner."""
    robot = Robot(side=1, number=3, noise=Random(1))
    pitch = Pitch([robot])
    robot.at = complex(-HALF_LENGTH, HALF_WIDTH)
    return pitch, robot


def run(pitch: Pitch, steps: int) -> None:
    for _step in range(steps):
        pitch.step()


@pytest.mark.parametrize(("speed", "goals"), [(KICK_SPEED, {1: 1, -1: 0}), (-KICK_SPEED, {1: 0, -1: 1})])
def test_a_ball_behind_the_line_is_a_goal_and_the_others_kick_off(speed: float, goals: dict[int, int]) -> None:
    pitch, robot = make_pitch()
    pitch.ball_velocity = complex(speed, 0.1)
    while not any(pitch.goals.values()):
        pitch.step()
    assert pitch.goals == goals
    assert (pitch.ball, pitch.ball_velocity) == (0, 0)
    assert (abs(robot.at) < 0.6) == (goals[-1] == 1)


def test_friction_stops_the_ball_and_boards_keep_it_on_the_pitch() -> None:
    pitch, _robot = make_pitch()
    pitch.ball_velocity = 0.5 + 0j
    run(pitch, 60)
    assert pitch.ball_velocity == 0
    assert pitch.ball.real == pytest.approx(0.25, abs=0.01)
    pitch.ball_velocity = 3 + 3j
    run(pitch, 100)
    assert abs(pitch.ball.imag) <= HALF_WIDTH
    assert abs(pitch.ball.real) <= HALF_LENGTH


def test_a_ball_that_does_not_move_is_dropped_in_the_center() -> None:
    pitch, _robot = make_pitch()
    pitch.ball = 1 + 1j
    run(pitch, 450)
    assert pitch.ball == 0
    assert pitch.dropped_balls == 1


def test_robots_push_the_ball_and_not_each_other_aside() -> None:
    pitch, robot = make_pitch()
    other = Robot(side=-1, number=3, noise=Random(2), at=0.1 + 1j)
    robot.at, robot.walking = 1j, 0.5 + 0j
    pitch.robots.append(other)
    pitch.step()
    assert abs(robot.at - other.at) == pytest.approx(2 * ROBOT_RADIUS)
    robot.at, other.at = -0.5 + 0j, 2 + 1j
    run(pitch, 60)
    assert pitch.ball.real > robot.at.real + ROBOT_RADIUS + BALL_RADIUS - 0.02
    assert pitch.ball_velocity.real > 0.3


def test_a_kick_needs_the_ball_in_reach_and_a_pause() -> None:
    pitch, robot = make_pitch()
    robot.kick_power = 1.0
    pitch.step()
    assert pitch.kicks == 0
    robot.at, robot.heading = -0.22 + 0j, 0.0
    pitch.step()
    assert pitch.kicks == 1
    assert pitch.ball_velocity.real == pytest.approx(KICK_SPEED, rel=0.05)
    pitch.ball, pitch.ball_velocity = 0j, 0j
    run(pitch, 40)
    assert pitch.kicks == 1


def test_messages_are_late_or_lost() -> None:
    match = World.start_match(1)
    sent = 0
    arrived: Counter[float] = Counter()
    for tick in range(400):
        match.advance(tick * match.tick_ns)
        first, second, _third = match.teams[0]
        for packet in second._radio.receive(second.robot.number, match.now_s):
            arrived[round(match.now_s - packet.sent_s, 1)] += 1
        first.tell(Root(Player, world=first, clock=SimulatedClock()).team)
        sent += 1
    assert set(arrived) == {0.1, 0.2}
    assert 0.05 < 1 - arrived.total() / sent < 0.15
