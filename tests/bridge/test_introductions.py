"""How a robot introduces itself in the lines of JXI: team, pace and times; and ticks by messages."""

from tests.bridge.sample_robots import TICK_NS, Client, commands, in_event_loop, make_server, tick


@in_event_loop
def test_lines_of_jxi_state_team_and_priority() -> None:
    server = make_server()
    for lines in (b"TEAM:red,7\nROBOT:a\nAHEAD:1\n", b"TEAM:red\nAHEAD:1\n", b"ROBOT:c\nAHEAD:1\n"):
        Client(server).send(lines)
    assert [(each.team, each.priority) for each in server.robots] == [("red", 7), ("red", -2), ("", -3)]


@in_event_loop
def test_a_capacity_holds_for_robots_of_a_team_in_jxi() -> None:
    server = make_server()
    for number, team in enumerate((b"red", b"red", b"blue")):
        Client(server).send(b"TEAM:%s,%d\nBEHAVIOR:crossing\nAHEAD:1\n" % (team, number))
    for number in range(1, 10):
        tick(server, number)
    behaviors = [each.behavior for each in server.robots]
    assert [each.active_states()[0][1] for each in behaviors if each] == ["Waiting", "Crossing", "Crossing"]


@in_event_loop
def test_a_line_of_jxi_states_the_time_of_those_after_it() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"TIME:100\nAHEAD:5\nTIME:99.6\nAHEAD:4\n")
    tick(server)
    assert server.robots[0].world.range_ahead_age >= 0.4
    client.send(b"TIME:soon\nTIME:nan\nTIME:\n")
    assert [each for each in client.lines() if each.startswith("ERROR")] == [
        "ERROR: TIME is 'soon', expected seconds",
        "ERROR: TIME is not a number of seconds up to 1e+09",
        "ERROR: TIME is '', expected seconds",
    ]


@in_event_loop
def test_introductions_that_are_wrong_or_late() -> None:
    client = Client(make_server())
    client.send(b"TEAM:red,high\nPACE:fast\nPACE:client\nAHEAD:1\nTEAM:red\n")
    assert client.lines()[1:] == [
        "ERROR: TEAM is 'red,high', expected a name, or a name and a priority",
        "ERROR: PACE is 'fast', expected clock or message",
        "ERROR: PACE is 'client', expected clock or message",
        "ERROR: the robot has already joined; send TEAM before the behavior and the first sensor",
    ]


@in_event_loop
def test_lines_that_arrive_together_tick_once() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"PACE:message\nACK:0\nAHEAD:5\n")
    assert commands(client.lines()) == ["DRIVE:0.5,0"]
    client.send(b"ACK:1\nINS:1,2,3\nAHEAD:6\nAHEAD:7\n")
    assert client.lines() == ["DRIVE:0.7,0"]
    # A line without values is no reason to tick.
    client.send(b"ACK:2\n")
    assert server.robots[0].data.counts.ticks == 2


@in_event_loop
def test_a_message_of_json_ticks_and_its_data_are_new() -> None:
    server = make_server()
    client = Client(server)
    client.send({"hello": {"robot": "r1", "pace": "message"}, "ack": 0})
    assert client.answers()[0]["welcome"]["waits_for"] == ["any"]
    for number in range(5, 9):
        client.send({"AHEAD": number})
        (answer,) = client.answers()
        assert (answer["commands"], answer["age_ms"] < 40) == ({"DRIVE": [number / 10, 0]}, True)
        client.send({"ack": answer["time"]})
    assert server.robots[0].data.counts.ticks == 4


@in_event_loop
def test_the_clock_ticks_a_robot_whose_messages_stay_away() -> None:
    server = make_server()
    client = Client(server)
    client.send(b"PACE:message\nAHEAD:5\n")
    robot = server.robots[0]
    tick(server, 1)
    assert robot.data.counts.ticks == 1
    robot.ticked_ns -= 2 * TICK_NS
    tick(server, 2)
    assert robot.data.counts.ticks == 2
