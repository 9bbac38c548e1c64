"""Robots of a team: states with a capacity, shared values, and robots that end."""

import json
import subprocess
from collections.abc import Callable
from typing import Any

import pytest

from tests.bica.net_robots import Blocker, Field, Idle, MakeRoot, step_until
from vicode.bica import Root
from vicode.bica.net_session import open_session
from vicode.bica.team_link import ANSWER_TICKS


def blocking(*roots: Root) -> list[bool]:
    return [root.main.state == "Block" for root in roots]


def test_one_robot_enters_a_state_with_room_for_one(make_root: MakeRoot) -> None:
    roots = [make_root(Blocker, name, team="blue") for name in ("r1", "r2", "r3")]
    step_until(lambda: any(blocking(*roots)), *roots)
    owner = blocking(*roots).index(True)
    for _ in range(30):
        for root in roots:
            root.step()
        assert blocking(*roots) == [index == owner for index in range(3)]
    roots[owner].close()
    others = [root for root in roots if root is not roots[owner]]
    step_until(lambda: any(blocking(*others)), *others)
    assert sum(blocking(*others)) == 1


def test_a_robot_that_is_killed_leaves_room(
    make_root: MakeRoot, start_robot: Callable[..., "subprocess.Popen[str]"]
) -> None:
    process = start_robot("r1", "Blocker")
    root = make_root(Blocker, "r2", team="blue")
    # It has just connected, and enters nothing before it could hear the others.
    step_until(lambda: root.team.ticks == ANSWER_TICKS, root)
    for _ in range(20):
        root.step()
    assert root.main.state == "Wait"
    process.kill()
    step_until(lambda: root.main.state == "Block", root)
    assert root.network is not None
    assert not root.network.robots["r1"].is_connected


def test_the_size_of_the_team_is_that_of_the_robots_that_are_alive(
    make_root: MakeRoot, start_robot: Callable[..., "subprocess.Popen[str]"]
) -> None:
    process = start_robot("r1", "Blocker")
    roots = [make_root(Blocker, name, team="blue") for name in ("r2", "r3")]
    other = make_root(Blocker, "r4", team="red")
    step_until(lambda: [root.team.size for root in roots] == [3, 3], *roots, other)
    process.kill()
    step_until(lambda: [root.team.size for root in roots] == [2, 2], *roots, other)
    assert other.team.size == 1


def test_other_teams_do_not_count(make_root: MakeRoot) -> None:
    blue, red = make_root(Blocker, "r1", team="blue"), make_root(Blocker, "r2", team="red")
    step_until(lambda: all(blocking(blue, red)), blue, red)


def test_values_of_the_world_are_shared(make_root: MakeRoot) -> None:
    first, second = Field(x=1.5, role="keeper"), Field(x=2, role="striker")
    robot, other = (make_root(Idle, name, team="blue", world=world) for name, world in (("r1", first), ("r2", second)))
    step_until(lambda: first.robots and second.robots, robot, other)
    seen: Any = first.robots["r2"]
    assert (seen.x, seen.role, seen.path, seen.is_alive) == (2, "striker", [2], True)
    assert robot.network is not None
    assert robot.network.robots is first.robots
    with pytest.raises(AttributeError, match="has not shared 'secret'"):
        _ = seen.secret
    second.x = 3.5
    step_until(lambda: seen.x == 3.5, other, robot)
    other.close()
    step_until(lambda: not seen.is_alive, robot)
    assert (seen.x, seen.is_connected) == (3.5, False)


@pytest.mark.parametrize(
    "change",
    [
        {"priority": "high"},
        {"priority": True},
        {"executed": [["Blocker"]]},
        {"executed": 1},
        {"near": [["Blocker", "Block"]] * 65},
        {"fields": 1},
        {"fields": {"x": "far"}},
        {"fields": {"path": [[1]]}},
    ],
)
def test_wrong_messages_are_ignored(
    make_root: MakeRoot, capsys: pytest.CaptureFixture[str], change: dict[str, object]
) -> None:
    robot = make_root(Idle, "r1", team="blue", world=Field())
    message = {"fields": {}, "priority": 1, "executed": [], "entering": [], "near": [], **change}
    other = open_session()
    other.sender("vicode/r2/team/blue").put(json.dumps(message))
    printed = ""

    def is_reported() -> bool:
        nonlocal printed
        printed += capsys.readouterr().err
        return "robot r2 of the team sends a wrong message" in printed

    step_until(is_reported, robot)
    other.close()
    assert robot.network is not None
    assert not robot.network.robots
