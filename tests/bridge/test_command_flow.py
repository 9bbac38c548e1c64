"""Commands on their way: acknowledgments, commands that stop a robot, and when a behavior starts."""

import math

from tests.bridge.sample_robots import (
    TICK_NS,
    Client,
    SampleWorld,
    WatchedWorld,
    commands,
    in_event_loop,
    make_server,
    tick,
)
from vicode.bridge import Sensor
from vicode.bridge.server import BridgeOptions

LONG_AGO_NS = -(10**15)
HELLO = {"hello": {"robot": "r1", "pace": "client"}}


class Watched(SampleWorld):
    """The watchdog stops the robot after longer than a test takes."""

    max_age = 600.0


@in_event_loop
def test_sensors_do_not_prove_that_a_robot_reads() -> None:
    server = make_server(BridgeOptions(port=0, tick_ns=TICK_NS, command_rate_hz=1e-6))
    client = Client(server)
    client.send(b"AHEAD:5\n")
    tick(server, 1)
    assert commands(client.lines()) == ["DRIVE:0.5,0"]
    client.send(b"AHEAD:0.5\n")
    tick(server, 2)
    assert client.lines() == []
    world = server.robots[0].world
    assert world.command_age == math.inf
    client.send(b"ACK:1\n")
    assert client.lines() == ["DRIVE:0,30"]
    assert server.collect_command_ages().number == 1
    tick(server, 3)
    assert 0 < world.command_age < math.inf


@in_event_loop
def test_json_commands_have_a_time_that_acknowledges_them() -> None:
    server = make_server(BridgeOptions(port=0, tick_ns=TICK_NS, command_rate_hz=1e-6))
    client = Client(server)
    client.send({"hello": {"robot": "r1"}, "AHEAD": 5})
    tick(server, 1)
    (_welcome, first) = client.answers()
    assert first["commands"] == {"DRIVE": [0.5, 0]}
    assert "command_age_ms" not in first
    client.send({"AHEAD": 0.5})
    tick(server, 2)
    assert client.lines() == []
    client.send({"ack": first["time"]})
    (second,) = client.answers()
    assert second["commands"] == {"DRIVE": [0, 30]}
    assert second["command_age_ms"] >= 0
    assert second["time"] >= first["time"]
    client.send({"ack": second["time"] + 1})
    assert "but the newest commands have the time" in client.answers()[0]["error"]


@in_event_loop
def test_wrong_acknowledgments_are_answered() -> None:
    client = Client(make_server())
    client.send(b"AHEAD:5\nACK:1\nACK:-1\nACK:\nACK:many\n")
    assert client.lines()[1:] == [
        "ERROR: ACK says 1 command lines were read, but 0 were sent",
        "ERROR: ACK is '-1', expected the number of command lines that were read",
        "ERROR: ACK is '', expected the number of command lines that were read",
        "ERROR: ACK is 'many', expected the number of command lines that were read",
    ]
    client = Client(make_server())
    client.send(HELLO)
    client.send({"ack": 1})
    assert client.answers()[1:] == [{"error": "in lock step, commands are not acknowledged; leave out ack"}]


@in_event_loop
def test_commands_that_stop_the_robot_do_not_wait_for_an_acknowledgment() -> None:
    server = make_server(BridgeOptions(port=0, tick_ns=TICK_NS, command_rate_hz=1e-6), world=Watched)
    client = Client(server)
    client.send(b"AHEAD:5\n")
    tick(server, 1)
    client.send(b"ACK:1\nAHEAD:6\n")
    tick(server, 2)
    client.lines()
    # The robot falls silent, with a command on its way.
    robot = server.robots[0]
    robot.data._input_ns = LONG_AGO_NS
    tick(server, 3)
    assert client.lines() == [
        "NOTICE: commands are at rest: nothing has arrived for 600 s",
        "DRIVE:0,0",
    ]
    tick(server, 4)
    assert client.lines() == []
    client.send(b"ACK:3\nAHEAD:7\n")
    tick(server, 5)
    assert client.lines() == ["DRIVE:0.7,0"]
    assert server.total().rests == 1


@in_event_loop
def test_a_behavior_starts_with_the_first_value_or_says_that_it_does_not_wait() -> None:
    for hello, waits_for, ticks in (({"behavior": "follow"}, ["any"], 1), ({"wait": False}, [], 2)):
        server = make_server()
        client = Client(server)
        client.send({"hello": hello})
        assert client.answers()[0]["welcome"]["waits_for"] == waits_for
        tick(server, 1)
        assert [each["commands"] for each in client.answers()] == ([] if waits_for else [{"DRIVE": [0.9, 0]}])
        client.send({"AHEAD": 5})
        tick(server, 2)
        assert server.robots[0].data.counts.ticks == ticks


@in_event_loop
def test_a_wait_for_a_required_sensor_is_reported() -> None:
    class Requiring(SampleWorld):
        laser = Sensor("LASER", float, length=3, required=True)

    server = make_server()
    server.make_world = Requiring
    client = Client(server)
    client.send(b"BEHAVIOR:follow\nAHEAD:5\n")
    for number in range(1, 60):
        tick(server, number)
    assert client.lines()[1:] == ["NOTICE: follow waits for the first value of LASER"]
    client.send(b"LASER:1,2,3\n")
    tick(server, 60)
    assert client.lines() == ["DRIVE:0.5,0"]
    assert server.robots[0].world.time == 0


@in_event_loop
def test_a_slow_reader_gets_the_newest_command_only() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"AHEAD:5\n")
    tick(server, 1)
    client.lines()
    client.transport.unsent = 100
    for number in range(2, 50):
        client.send(f"AHEAD:{number}\n".encode())
        tick(server, number)
    assert client.lines() == []
    client.transport.unsent = 0
    client.send(b"ACK:1\n")
    assert client.lines() == ["DRIVE:4.9,0"]
    assert server.robots[0].data.counts.commands_dropped == 47


@in_event_loop
def test_in_lock_step_a_robot_is_stopped_by_its_own_clock() -> None:
    server = make_server(world=WatchedWorld)
    shown: list[str] = []
    server.on_event = lambda _robot, text: shown.append(text)
    client = Client(server)
    client.send(HELLO)
    client.send({"AHEAD": 5, "tick": 0})
    client.send({"tick": 1})
    client.send({"tick": 1.05})
    assert [each["commands"] for each in client.answers()[1:]] == [{"DRIVE": [0.5, 0]}, {}, {"DRIVE": [0, 0]}]
    assert shown[-1] == "commands are at rest: nothing has arrived for 1 s"


@in_event_loop
def test_a_robot_that_connects_again_with_old_values_stands_without_a_notice() -> None:
    server = make_server(world=Watched)
    first = Client(server)
    first.send(b"ROBOT:r1\nAHEAD:5\n")
    tick(server, 1)
    first.leave()
    server._seats["r1"].robot.data._input_ns = LONG_AGO_NS
    second = Client(server)
    second.send(b"ROBOT:r1\n")
    tick(server, 2)
    assert second.lines() == ["Robot connection accepted", "DRIVE:0,0"]
    second.send(b"ACK:1\nAHEAD:6\n")
    tick(server, 3)
    assert second.lines() == ["DRIVE:0.6,0"]
    assert server.total().rests == 0


@in_event_loop
def test_both_sides_are_told_that_commands_wait() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"ACK:0\nAHEAD:5\n")
    tick(server, 1)
    flow = server.robots[0].data.flow
    assert flow is not None
    flow._waiting.clear()
    flow.add(1, 0, 0)
    client.lines()
    tick(server, 2)
    tick(server, 3)
    assert client.lines() == ["NOTICE: newer commands wait: the previous ones have not been acknowledged for 1 s"]
