"""A connection without a network: both languages, faults of clients, and slow readers."""

import asyncio

import pytest

from tests.bridge.sample_robots import Client, commands, in_event_loop, make_server, tick
from vicode.bridge.connection import ClockOffset
from vicode.bridge.server import BridgeOptions

HELLO = {"hello": {"robot": "r1", "pace": "client"}}


@in_event_loop
def test_lines_of_jxi() -> None:
    server = make_server()
    client = Client(server)
    assert client.lines() == ["Robot connection accepted"]
    client.send(b"BEHAVIOR:follow\r\nAHEAD: 5.0\r\n")
    tick(server, 1)
    assert client.lines() == ["DRIVE:0.5,0"]
    client.send(b"ACK:1\nAHEAD:0.")
    client.send(b"5\n")
    tick(server, 2)
    assert client.lines() == ["DRIVE:0,30"]
    assert [robot.name for robot in server.robots] == ["robot1"]


@in_event_loop
def test_the_default_behavior_starts_with_the_first_value() -> None:
    server = make_server()
    client = Client(server)
    tick(server, 1)
    client.send(b"AHEAD:5\n")
    tick(server, 2)
    assert client.lines() == ["Robot connection accepted", "DRIVE:0.5,0"]


@in_event_loop
def test_without_a_default_a_robot_is_told_to_choose() -> None:
    client = Client(make_server(default=""))
    client.send(b"AHEAD:5\n")
    assert client.lines()[1:] == ["ERROR: choose a behavior: follow, failing, crossing"]
    client.send(b"BEHAVIOR:fly\n")
    assert client.lines() == ["ERROR: there is no behavior 'fly'; choose from: follow, failing, crossing"]


@in_event_loop
def test_lock_step_in_json() -> None:
    server = make_server()
    client = Client(server)
    client.send({"hello": {"robot": "r1", "pace": "client", "state": True}})
    assert client.answers() == [{"welcome": {"robot": "r1", "behavior": "follow", "tick_ms": 50}}]
    client.send({"AHEAD": 5, "tick": 0})
    client.send({"tick": 0.05})
    client.send({"AHEAD": [0.5], "time": 0.075, "tick": 0.1})
    active = {"active": [["Follow", "Going"]]}
    assert client.answers() == [
        {"tick": 0, "age_ms": 0, "state": active, "commands": {"DRIVE": [0.5, 0]}},
        {"tick": 0.05, "age_ms": 50, "state": active, "commands": {}},
        {"tick": 0.1, "age_ms": 25, "state": {"active": [["Follow", "Near"]]}, "commands": {"DRIVE": [0, 30]}},
    ]
    tick(server)
    assert client.lines() == []


@in_event_loop
def test_errors_in_lock_step_are_answers() -> None:
    client = Client(make_server())
    client.send(HELLO)
    client.send({"tick": 1, "AHEAD": "far"})
    client.send({"tick": 0.5})
    client.send({"tick": "soon"})
    client.send(b'{"tick": \n')
    client.send({"NOTHING": 1})
    client.send(b'{"tick": ' + b"9" * 400 + b"}\n")
    assert client.answers()[1:] == [
        {"tick": 1, "errors": ["AHEAD: parameter 1 is 'far', expected a number"], "commands": {"DRIVE": [0.9, 0]}},
        {"error": "tick 0.5 is before tick 1"},
        {"error": "tick is 'soon', expected seconds"},
        {"error": "expected a JSON object, found '{\"tick\": '"},
        {"error": "no sensor or event 'NOTHING'; the world has AHEAD, INS, LASER, MODE, WHISTLE, BUTTON"},
        {"error": "tick is not a number of seconds up to 1e+09"},
    ]


@pytest.mark.parametrize(
    ("hello", "error"),
    [
        ({"hello": []}, "hello is an object"),
        ({"hello": {"robot": 1}}, "hello: robot is '1', expected a text"),
        ({"hello": {"robot": "a b"}}, "the name of a robot has up to 64 letters"),
        ({"hello": {"pace": "fast"}}, "hello: pace is 'fast', expected clock or client"),
        ({"hello": {"behavior": "fly"}}, "there is no behavior 'fly'"),
        ({"hello": {"priority": "high"}}, "hello: priority is 'high', expected an integer"),
        ({"hello": {"robot": "\ud800"}}, "the name of a robot has up to 64 letters"),
        ({"hello": {"pace": "\ud800"}}, "hello: pace is '?', expected clock or client"),
        ({"hello": {"behavior": "\ud800"}}, "there is no behavior '\\ud800'"),
    ],
)
def test_a_hello_that_is_refused(hello: dict[str, object], error: str) -> None:
    async def greet() -> None:
        client = Client(make_server())
        client.send(hello)
        (answer,) = client.answers()
        assert error in answer["error"]
        assert client.transport.is_closed

    asyncio.run(greet())


@in_event_loop
def test_a_malformed_line_is_answered_and_the_tick_goes_on() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"AHEAD:5\nhello there\nAHEAD:4\n\xff\xfe\nNOTHING:1\n")
    tick(server)
    assert client.lines()[1:] == [
        "ERROR: expected TARGET:p1,p2, found 'hello there'",
        "ERROR: expected TARGET:p1,p2, found '\\xff\\xfe'",
        "ERROR: no sensor or event 'NOTHING'; the world has AHEAD, INS, LASER, MODE, WHISTLE, BUTTON",
        "DRIVE:0.4,0",
    ]
    counts = server.robots[0].data.counts
    assert (counts.lines, counts.malformed, counts.unknown, counts.dropped) == (2, 2, 1, 1)


def test_only_some_errors_are_answered() -> None:
    async def complain() -> None:
        server = make_server()
        client = Client(server, 0.0)
        client.send(b"junk\n" * 1000 + b"AHEAD:5\n")
        await client.settle()
        assert len(client.lines()) <= 8
        assert not client.transport.is_paused
        client.connection._error_s -= 2
        client.send(b"junk\n")
        assert client.lines()[-1].endswith("other errors)")
        assert server.total().malformed == 1001

    asyncio.run(complain())


@in_event_loop
def test_in_lock_step_each_error_is_answered_but_only_some_are_shown() -> None:
    server = make_server()
    shown: list[tuple[str, str]] = []
    server.on_event = lambda robot, text: shown.append((robot, text))
    client = Client(server)
    client.send(HELLO)
    client.send(b"junk\n" * 50)
    assert len(client.answers()) == 51
    assert 2 <= len(shown) < 40
    assert shown[-1] == ("r1", "expected a JSON object, found 'junk'")


@in_event_loop
def test_in_clock_pace_a_json_client_may_see_states() -> None:
    server = make_server()
    client = Client(server)
    client.send({"hello": {"robot": "r1", "state": True}, "AHEAD": [5]})
    tick(server, 1)
    (_welcome, answer) = client.answers()
    assert answer["commands"] == {"DRIVE": [0.5, 0]}
    assert answer["state"] == {"active": [["Follow", "Going"]]}
    assert answer["age_ms"] >= 0


@in_event_loop
def test_a_token_comes_first() -> None:
    server = make_server(BridgeOptions(port=0, token="secret"))
    refused = []
    for first in (
        b"AHEAD:5\n",
        b"TOKEN:wrong\n",
        b'{"hello": {}}\n',
        b'{"hello": {"token": "wrong"}}\n',
        b'{"A": 1}\n',
    ):
        client = Client(server)
        client.send(first)
        refused.append(client.lines()[-1])
        assert client.transport.is_closed
    assert refused == [
        "ERROR: this server needs a token; send TOKEN:… first",
        "ERROR: wrong token",
        '{"error":"this server needs a token"}',
        '{"error":"wrong token"}',
        '{"error":"this server needs a token"}',
    ]
    for first in (b"TOKEN:secret\nAHEAD:5\n", b'{"hello": {"token": "secret"}}\n'):
        client = Client(server)
        client.send(first)
        assert not client.transport.is_closed
    assert len(server.robots) == 2


@in_event_loop
def test_a_robot_continues_after_it_connected_again() -> None:
    server = make_server()
    first = Client(server)
    first.send(b"ROBOT:r1\nAHEAD:0.5\n")
    tick(server, 1)
    tick(server, 2)
    robot = server.robots[0]
    first.leave()
    assert server.robots == []
    second = Client(server)
    second.send(b"ROBOT:r1\n")
    tick(server, 9)
    # The robot may have restarted: it gets the current command again.
    assert commands(second.lines()) == ["DRIVE:0,30"]
    assert server.robots == [robot]
    assert (robot.world.time, robot.data.counts.connections) == (0.4, 2)


@in_event_loop
def test_the_state_ends_after_the_grace_time() -> None:
    server = make_server(BridgeOptions(port=0, grace_s=0))
    client = Client(server)
    client.send(b"ROBOT:r1\nAHEAD:0.5\n")
    robot = server.robots[0]
    client.leave()
    again = Client(server)
    again.send(b"ROBOT:r1\nAHEAD:5\n")
    assert server.robots[0] is not robot
    assert server.total().connections == 2


@in_event_loop
def test_the_newer_connection_of_a_robot_wins() -> None:
    server = make_server()
    old, new = Client(server), Client(server)
    old.send(b"ROBOT:r1\nAHEAD:5\n")
    robot = server.robots[0]
    new.send(b"ROBOT:r1\n")
    assert old.lines()[-1] == "ERROR: robot r1 has connected again from 192.0.2.1:4711"
    old.leave()
    assert server.robots == [robot]
    new.send(b"ROBOT:r2\n")
    assert new.lines()[-1] == "ERROR: the robot has already joined; send ROBOT before the behavior and the first sensor"


@in_event_loop
def test_a_client_that_reads_no_answers_is_not_read() -> None:
    server = make_server()
    client = Client(server)
    client.send(HELLO)
    client.connection.pause_writing()
    assert client.transport.is_paused
    client.connection.resume_writing()
    assert not client.transport.is_paused
    # By the clock, sensors matter even if the robot does not read.
    other = Client(server)
    other.send(b"AHEAD:1\n")
    other.connection.pause_writing()
    assert not other.transport.is_paused


def test_a_client_that_reads_no_answers_stays_unread_after_its_lines_are_handled() -> None:
    async def tick_without_reading() -> None:
        client = Client(make_server(), 0.0)
        client.send(HELLO)
        client.send(b'{"tick": 1}\n' * 100)
        client.connection.pause_writing()
        await client.settle()
        assert client.transport.is_paused

    asyncio.run(tick_without_reading())


@in_event_loop
def test_lock_step_begins_anew_with_each_connection() -> None:
    server = make_server()
    for _connection in range(2):
        client = Client(server)
        client.send(HELLO)
        client.send({"tick": -3})
        client.send({"tick": 2})
        assert [answer.get("tick") for answer in client.answers()] == [None, -3, 2]
        assert server.robots[0].world.time == 5
    assert len(server.robots) == 1


def test_times_of_the_robot_become_times_of_the_server() -> None:
    offset = ClockOffset()
    # The robot's clock is 8 s ahead; the messages take 100, 20, 500 and 20 ms. It restarts before the last one.
    times_ms = [(9_000, 1_100), (9_050, 1_070), (9_100, 1_600), (9_700, 1_720), (0, 90_000)]
    ages_ms = [now - offset.convert(sent * 1_000_000, now * 1_000_000) / 1e6 for sent, now in times_ms]
    assert [round(age) for age in ages_ms] == [0, 0, 480, 0, 0]


@in_event_loop
def test_the_time_of_a_message_gives_the_age_of_its_values() -> None:
    server = make_server()
    client = Client(server)
    client.send({"hello": {"robot": "r1"}, "time": 100.0, "AHEAD": 5})
    client.send({"time": 99.6, "AHEAD": 4})
    tick(server)
    assert server.robots[0].world.range_ahead_age >= 0.4
