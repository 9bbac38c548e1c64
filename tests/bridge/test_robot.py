"""Robots of one server without a network: exceptions, several behaviors, and teams."""

from itertools import permutations

import pytest

from tests.bridge.sample_robots import TICK_NS, SampleWorld, make_catalog
from vicode.bridge.behaviors import BehaviorCatalog, BehaviorError, XabslCatalog
from vicode.bridge.robot import Robot, TeamRound
from vicode.xabsl.compiler import compile_source, declared_symbols
from vicode.xabsl.parser import parse
from vicode.xabsl.source_loader import load_source

FILES = {
    "agents": """
include "symbols.xabsl";
include "acts.xabsl";
include "go.xabsl";
include "cross.xabsl";
agent goer("Goer", go);
agent crosser("Crosser", cross);
""",
    "symbols": """
namespace Robot("Robot") {
  float input range_ahead "m";
}
""",
    "acts": """
namespace Acts("Acts") {
  behavior drive { float speed "m/s"; float turn "deg/s"; }
}
""",
    "go": """
option go {
  initial state going {
    decision { if (range_ahead < 1) goto near; else stay; }
    action { drive(speed = 1); }
  }
  state near {
    decision { if (range_ahead >= 1) goto going; else stay; }
    action { drive(turn = 30); }
  }
}
""",
    "cross": """
option cross {
  initial state waiting { decision { goto crossing; } action { } }
  state crossing capacity 1 { decision { stay; } action { } }
}
""",
}


@pytest.fixture(scope="module")
def xabsl(tmp_path_factory: pytest.TempPathFactory) -> XabslCatalog:
    folder = tmp_path_factory.mktemp("agents")
    for name, text in FILES.items():
        (folder / f"{name}.xabsl").write_text(text, encoding="utf-8")
    compiled = compile_source(load_source(folder / "agents.xabsl", parse_text=parse))
    assert compiled.program is not None, compiled.findings
    return XabslCatalog(program=compiled.program, symbols=declared_symbols(compiled.table))


def make_robot(behavior: str, catalog: BehaviorCatalog | None = None, *, name: str = "r", priority: int = 0) -> Robot:
    robot = Robot(name, SampleWorld, catalog or make_catalog(), priority=priority)
    robot.select(behavior)
    return robot


def advance(robots: list[Robot], number: int) -> None:
    for robot in robots:
        # As in lock step, where each robot ticks on its own.
        robot.tick(number * TICK_NS, number * TICK_NS, TeamRound(robots, number * TICK_NS))


def states(robots: list[Robot]) -> list[str]:
    return [robot.behavior.active_states()[0][1] for robot in robots if robot.behavior is not None]


def test_the_clock_of_a_robot_starts_with_its_behavior() -> None:
    robot = make_robot("follow")
    times = []
    for number in (100, 101, 103, 102):
        advance([robot], number)
        times.append(robot.world.time)
    assert times == [0, 0.05, 0.15, 0.15]


def test_an_exception_is_reported_once_and_the_ticks_go_on() -> None:
    robot = make_robot("failing")
    for number in range(5):
        if number == 2:
            robot.data.receive("AHEAD", b"1", number * TICK_NS)
        advance([robot], number)
    assert (robot.data.counts.ticks, robot.data.counts.errors) == (5, 5)
    assert [line.partition(" [")[0] for line in robot.take_reports()] == [
        "Failing, work, line 2: SystemExit",
        "Failing, work, line 3: RuntimeError: no idea",
    ]


def test_a_robot_changes_its_behavior_and_keeps_its_sensors() -> None:
    robot = make_robot("failing")
    robot.data.receive("AHEAD", b"0.5", 0)
    advance([robot], 0)
    robot.select("follow")
    advance([robot], 1)
    assert (robot.world.time, states([robot])) == (0, ["Near"])
    with pytest.raises(BehaviorError, match="there is no behavior 'fly'; choose from: follow, failing, crossing"):
        robot.select("fly")
    assert robot.behavior_name == "follow"


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_a_capacity_holds_for_robots_of_a_server_in_any_order(order: tuple[int, ...]) -> None:
    robots = [make_robot("crossing", name=f"r{number}", priority=number) for number in range(3)]
    for number in range(10):
        advance([robots[index] for index in order], number)
    assert states(robots) == ["Waiting", "Waiting", "Crossing"]
    # The next one enters after the first has left the team.
    robots[2].leave_team()
    for number in range(10, 20):
        advance(robots[:2], number)
    assert states(robots[:2]) == ["Waiting", "Crossing"]


def test_robots_read_what_their_team_publishes() -> None:
    robots = [make_robot("follow", name=name) for name in ("a", "b", "c")]
    for number, robot in enumerate(robots, 1):
        robot.data.receive("AHEAD", str(number).encode(), 0)
    advance(robots, 0)
    advance(robots, 1)
    assert [[(mate.robot, mate.speed_wish) for mate in robot.world.team] for robot in robots] == [
        [("b", 0.2), ("c", 0.3)],
        [("a", 0.1), ("c", 0.3)],
        [("a", 0.1), ("b", 0.2)],
    ]


def test_an_agent_of_xabsl(xabsl: XabslCatalog) -> None:
    assert xabsl.names == ("goer", "crosser", "cross", "go")
    robot = make_robot("goer", xabsl)
    sent = []
    for number, ahead in enumerate((b"5", b"5", b"0.5", b"2")):
        robot.data.receive("AHEAD", ahead, number * TICK_NS)
        advance([robot], number)
        sent.append(dict(robot.data.commands.take()))
    assert sent == [{"DRIVE": (1, 0)}, {}, {"DRIVE": (0, 30)}, {"DRIVE": (1, 0)}]
    assert states([robot]) == ["going"]
    with pytest.raises(BehaviorError, match="there is no behavior 'fly'"):
        robot.select("fly")


def test_a_capacity_of_xabsl(xabsl: XabslCatalog) -> None:
    robots = [make_robot("crosser", xabsl, name=f"r{number}", priority=number) for number in range(3)]
    for number in range(10):
        advance(robots, number)
    assert states(robots) == ["waiting", "waiting", "crossing"]


def test_an_exception_of_the_world_does_not_stop_an_engine(xabsl: XabslCatalog) -> None:
    class Faulty(SampleWorld):
        published = ()

        @property
        def range_ahead(self) -> float:  # type: ignore[override]
            return 1 / 0

    robot = Robot("r", Faulty, xabsl)
    robot.select("goer")
    advance([robot], 0)
    advance([robot], 1)
    assert robot.data.counts.errors == 2
    (line,) = robot.take_reports()
    assert line.startswith("ZeroDivisionError: division by zero")


def test_what_the_world_does_wrong_is_reported() -> None:
    class Faulty(SampleWorld):
        published = ("missing",)

        def advance(self, _now_ns: int) -> None:
            raise KeyError("advance")

        def close(self) -> None:
            raise KeyError("close")

    robot = Robot("r", Faulty, make_catalog())
    robot.select("follow")
    advance([robot], 0)
    robot.close()
    assert [line.partition(" [")[0] for line in robot.take_reports()] == [
        "KeyError: 'advance'",
        "published missing: AttributeError: 'Faulty' object has no attribute 'missing'",
        "close of the world: KeyError: 'close'",
    ]
