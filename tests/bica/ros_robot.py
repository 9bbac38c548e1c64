"""A robot with a laser scanner, or a listener, in a process of its own; it speaks DDS without vicode's components.

python ros_robot.py turtle FOLDER drives toward a wall at 2 m until it is stopped, and records a bag in FOLDER.
"""

import math
import sys
import time
from pathlib import Path
from typing import Any

from cyclonedds.core import Policy, Qos
from cyclonedds.sub import DataReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from vicode.bica import ros_session

SCAN, TWIST = "sensor_msgs/msg/LaserScan", "geometry_msgs/msg/Twist"
PERIOD_S = 0.02


def make_scan(*ranges: float) -> Any:
    message = ros_session.make_message(SCAN)
    message.ranges = list(ranges)
    return message


def read_latched(topic: str) -> Any:
    """A reader of a latched topic of texts, whose `take(1)` lists new messages."""
    session = ros_session.open_session()
    assert isinstance(session, ros_session._DomainSession)
    qos = Qos(Policy.Reliability.Reliable(0), Policy.Durability.TransientLocal, Policy.History.KeepLast(1))
    return DataReader(session._participant, session._topic(topic, "std_msgs/msg/String"), qos=qos)


def write_bag(path: Path, messages: list[tuple[int, Any]], topic: str = "/scan", type_: str = SCAN) -> None:
    """Write messages with their times in ns."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection(topic, type_, typestore=get_typestore(Stores.ROS2_JAZZY))
        for time_ns, message in messages:
            writer.write(connection, time_ns, message.serialize())


def drive_turtle(folder: Path) -> None:
    session = ros_session.open_session()
    commands, publish = session.reader("/cmd_vel", TWIST), session.writer("/scan", SCAN)
    position, speed, recorded = 0.0, 0.0, []
    has_moved, start_ns = False, time.monotonic_ns()
    while time.monotonic_ns() - start_ns < 20e9:
        command = commands.take(0)
        speed = command.linear.x if command is not None else speed
        has_moved = has_moved or speed > 0
        position += speed * PERIOD_S
        scan = make_scan(math.nan, 2.0 - position, math.inf)
        publish(scan)
        recorded.append((1_000_000_000 + time.monotonic_ns() - start_ns, scan))
        if has_moved and speed == 0.0:
            break
        time.sleep(PERIOD_S)
    write_bag(folder / "bag", recorded)
    sys.stdout.write(f"{position:.2f} {speed}\n")


if __name__ == "__main__":
    drive_turtle(Path(sys.argv[2]))
