"""What viewers see of an XABSL engine, without a network."""

from tests.bridge.test_robot import advance, make_robot, xabsl
from vicode.bridge.behaviors import XabslBehavior, XabslCatalog
from vicode.bridge.engine_feed import EngineFeed

__all__ = ["xabsl"]


def test_viewers_see_active_options_and_state_changes(xabsl: XabslCatalog) -> None:
    robot = make_robot("goer", xabsl)
    assert isinstance(robot.behavior, XabslBehavior)
    notified: list[int] = []
    feed = EngineFeed(robot.behavior, "nao", lambda: notified.append(1))
    robot.data.receive("AHEAD", b"5", 0)
    advance([robot], 0)
    assert feed.newest == (0, {})
    feed.is_watched = True
    for number, ahead in enumerate((b"5", b"0.5", b"0.4"), 1):
        robot.data.receive("AHEAD", ahead, number * 50_000_000)
        advance([robot], number)
    number, message = feed.newest
    (step,) = message["tree"]
    assert (number, len(notified)) == (3, 3)
    assert (step["component"], step["state"], step["state_time_ns"], step["by"]) == ("go", "near", 50_000_000, None)
    assert [(each["source"], each["target"], each["time_ns"]) for each in feed.changes] == [
        ("going", "near", 100_000_000)
    ]
    assert feed.describe()["components"]["go"]["states"] == ["going", "near"]


def test_an_engine_cannot_be_controlled(xabsl: XabslCatalog) -> None:
    robot = make_robot("goer", xabsl)
    assert isinstance(robot.behavior, XabslBehavior)
    feed = EngineFeed(robot.behavior, "nao", lambda: None)
    assert feed.request("viewer", {"do": "pause", "id": 7})
    assert feed.answers.popleft() == (
        "viewer",
        {"answer": 7, "robot": "nao", "error": "XABSL agents of a bridge can be watched, not controlled"},
    )
