"""Findings of topics of ROS 2 in profiles."""

from dataclasses import replace
from typing import Any

import pytest

from vicode.bica import ros_messages
from vicode.bica.errors import NetworkError
from vicode.check.project import find_bad_profiles
from vicode.model.design import Declaration, Design, State, Use
from vicode.model.project import Interface, Profile, Project, TopicReference

SCAN = TopicReference(
    component="Scan",
    topic="/scan",
    type="sensor_msgs/msg/LaserScan",
    outputs=(("nearest", "min(ranges)"),),
    max_age=0.5,
)
DRIVE = TopicReference(
    component="Drive", topic="/cmd_vel", type="geometry_msgs/msg/Twist", parameters=(("speed", "linear.x"),)
)
PROJECT = Project(
    name="Turtle",
    components=(
        Interface(
            component="Scan",
            implementation="field.scan:Scan",
            outputs=(Declaration(name="nearest", type="float", initial="9"), Declaration(name="is_alive", type="bool")),
        ),
        Interface(
            component="Drive",
            implementation="field.drive:Drive",
            parameters=(Declaration(name="speed", initial="0.0"),),
        ),
    ),
    designs=(
        Design(
            component="Player",
            uses=(Use(alias="scan", component="Scan"), Use(alias="drive", component="Drive")),
            initial="Go",
            states=(State(name="Go", requires=("scan", "drive")),),
        ),
    ),
    profiles=(Profile(name="ros2", components=(SCAN, DRIVE)),),
)


def findings(choice: TopicReference) -> list[tuple[str, str, str]]:
    project = replace(PROJECT, profiles=(Profile(name="ros2", components=(choice,)),))
    found = []
    for each in find_bad_profiles(project):
        assert each.subject is not None
        found.append(("/".join(map(str, each.subject.path[4:])), each.message, each.fix))
    return found


def test_sound_topics_have_no_findings() -> None:
    assert findings(SCAN) == findings(DRIVE) == []


@pytest.mark.parametrize(
    ("choice", "changes", "place", "message", "fix"),
    [
        (SCAN, {"topic": "scan!"}, "topic", "'scan!' is no name of a topic", "such as /scan"),
        (SCAN, {"type": ""}, "", "the topic '/scan' has no type", "add 'type:"),
        (SCAN, {"type": "sensor_msgs/msg/LaserScam"}, "type", "unknown message type", "LaserScan"),
        (SCAN, {"outputs": (("nearest", "min(rangs)"),)}, "outputs/nearest", "has no field 'rangs'", "ranges"),
        (SCAN, {"outputs": (("nearest", "ranges"),)}, "outputs/nearest", "is an array", "field"),
        (SCAN, {"outputs": (("nearest", "header.frame_id"),)}, "outputs/nearest", "is string", "same type"),
        (SCAN, {"outputs": (("nearest", "range_min"), ("far", "range_max"))}, "outputs/far", "no output 'far'", ""),
        (
            SCAN,
            {"outputs": (("nearest", "range_min"), ("is_alive", "range_max"))},
            "outputs/is_alive",
            "set by the runtime",
            "remove it",
        ),
        (SCAN, {"parameters": (("speed", "range_min"),)}, "", "either read or published", "two components"),
        (SCAN, {"outputs": ()}, "", "either read or published", "give 'outputs'"),
        (SCAN, {"max_age": -1.0}, "max_age", "not a valid age", "above 0"),
        (DRIVE, {"parameters": (("speed", "linear"),)}, "parameters/speed", "is a message", "field"),
        (DRIVE, {"parameters": (("sped", "linear.x"),)}, "parameters", "'speed' of 'Drive' has no field", "add it"),
        (
            DRIVE,
            {"type": "sensor_msgs/msg/LaserScan", "parameters": (("speed", "min(ranges)"),)},
            "parameters/speed",
            "cannot be published",
            "no array",
        ),
    ],
)
def test_findings(choice: TopicReference, changes: dict[str, Any], place: str, message: str, fix: str) -> None:
    where, text, remedy = findings(replace(choice, **changes))[0]
    assert where == place
    assert message in text
    assert fix in remedy


def test_without_rosbags_types_are_not_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    def load() -> None:
        raise NetworkError("not installed")

    monkeypatch.setattr(ros_messages, "_load_types", load)
    assert findings(replace(SCAN, type="no/msg/Type")) == []
