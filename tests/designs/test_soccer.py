"""The soccer team understands the server, and plays."""

import cmath
import json
import math
import select
import socket
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fake_soccer_server import BODY, FakeServer, cycle
from rcss.landmarks import LANDMARKS, locate
from rcss.messages import parse
from rcss.world import World
from soccer.field_player import FieldPlayer
from soccer.goalkeeper import Goalkeeper

from vicode.bica import Component, Root, SimulatedClock

ROOT = Path(__file__).parents[2]


# Messages and landmarks


def test_a_message_is_read_as_nested_lists() -> None:
    assert parse('(see 12 ((p "a b" 3) 10.2 -3) ((b)))') == ["see", "12", [["p", "a b", "3"], "10.2", "-3"], [["b"]]]


@pytest.mark.parametrize("text", ["", "see 1", "(see", "(see))", ")(", "(a) (b)"])
def test_a_broken_message_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"message|unexpected"):
        parse(text)


def test_the_field_has_55_landmarks() -> None:
    assert len(LANDMARKS) == 55
    assert LANDMARKS["f p l t"] == -36 - 20.16j
    assert LANDMARKS["f b r 40"] == 40 + 39j
    assert LANDMARKS["f l t 10"] == -57.5 - 10j


@pytest.mark.parametrize("count", [2, 3, 55])
def test_a_player_is_where_the_landmarks_say(count: int) -> None:
    place, heading = 10 - 5j, math.radians(150)
    sightings = [(each, (each - place) * cmath.rect(1, -heading)) for each in list(LANDMARKS.values())[:count]]
    found = locate(sightings)
    assert found is not None
    assert found[0] == pytest.approx(place)
    assert found[1] == pytest.approx(150)


def test_one_landmark_is_not_enough() -> None:
    assert locate([(1 + 1j, 2 + 0j)]) is None
    assert locate([(1 + 1j, 2 + 0j), (1 + 1j, 2 + 0j)]) is None


# The world


@contextmanager
def joined(cycles: Sequence[Sequence[str]], **options: Any) -> Iterator[tuple[World, FakeServer]]:
    server = FakeServer(cycles, mode=options.pop("mode", "before_kick_off"))
    serving = threading.Thread(target=server.serve)
    serving.start()
    world = World(server=server.address, **options)
    try:
        yield world, server
    finally:
        world.close()
        serving.join(10)
        assert not serving.is_alive()


def test_a_cycle_is_sensed_and_the_commands_are_sent() -> None:
    with joined([cycle(0, '((b) 10 30) ((p "vicode" 7) 20 0) ((p "other") 3 90) ((l r) 52)')]) as (world, server):
        world.receive_cycle()
        assert (world.side, world.number, world.cycle) == ("l", 1, 1)
        assert (world.stamina, world.speed) == (7950, 0.2)
        assert (world.x, world.y, world.heading) == (pytest.approx(0, abs=0.2), pytest.approx(0, abs=0.2), 0)
        assert (world.ball_distance, world.ball_direction, world.ball_age) == (10, 30, 0)
        assert (world.mate_is_free, world.mate_distance, world.opponent_distance) == (True, 20, 3)
        assert world.mate_to_ball == pytest.approx(abs(20 - cmath.rect(10, math.radians(30))), abs=0.1)
        world.dash(power=20)
        world.turn(angle=30)
        world.turn_neck(angle=-5)
        world.send_commands()
    assert server.commands[0][:2] == ["(synch_see)", "(change_view narrow)"]
    assert server.commands[0][2:5] == ["(turn 60.0)", "(turn_neck -5.0)", "(done)"]


def test_what_is_seen_is_turned_by_the_neck() -> None:
    with joined([cycle(0, "((b) 10 30)", body=BODY.replace("angle 0", "angle 20"))]) as (world, _server):
        world.receive_cycle()
        assert (world.neck, world.heading, world.ball_direction) == (20, -20, 50)


def test_the_right_team_sees_the_field_from_its_side() -> None:
    with joined([cycle(0, "((b) 10 0)")]) as (world, _server):
        world.side = "r"
        world.receive_cycle()
        assert abs(world.heading) == 180
        assert world.ball_x == pytest.approx(-10, abs=0.2)


def test_the_ball_is_remembered() -> None:
    with joined([cycle(0, "((b) 10 0)"), cycle(1), cycle(2)]) as (world, _server):
        for _cycle in range(3):
            world.receive_cycle()
            world.send_commands()
        assert (world.ball_distance, world.ball_age) == (10, 0.2)


def test_a_player_that_is_late_continues_with_the_newest_cycle() -> None:
    with joined([[*cycle(0), *cycle(1), *cycle(2, "((b) 4 0)")]]) as (world, server):
        while not server.commands:  # until the server has sent all of it
            time.sleep(0.001)
        world.receive_cycle()
        assert (world.cycle, world.ball_distance) == (3, 4)


def test_after_a_long_stop_a_player_takes_the_newest_cycle_although_its_buffer_was_full() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server:
        server.bind(("127.0.0.1", 0))
        is_full = threading.Event()

        def serve() -> None:
            _text, player = server.recvfrom(100)
            server.sendto(b"(init l 1 play_on)", player)
            for number in range(1, 100_000):
                for message in cycle(number, f"((b) {number / 10} 0)")[:-1]:
                    server.sendto(message.encode(), player)
                if number > 1000:
                    is_full.set()
                    if select.select([server], [], [], 0.02)[0] and server.recvfrom(100)[0] == b"(bye)":
                        break

        serving = threading.Thread(target=serve)
        serving.start()
        world = World(server=server.getsockname())
        assert is_full.wait(10)
        begun = world.next_cycle()
        distance = world.ball_distance
        world.close()
        serving.join(10)
        assert not serving.is_alive()
    assert begun > 1000
    assert distance == pytest.approx(begun / 10)


def test_the_run_ends_when_the_server_is_silent() -> None:
    with joined([["(error)"]], timeout_s=0.1) as (world, _server):
        world.receive_cycle()
        assert world.finished


def test_a_program_can_end_while_the_server_is_silent() -> None:
    with joined([["(error)"]], timeout_s=1.5) as (world, _server):
        begun = []
        while not world.finished:
            begun.append(world.next_cycle())
        assert begun == [0, 0]


def test_a_refused_player_does_not_start() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server:
        server.bind(("127.0.0.1", 0))

        def refuse() -> None:
            server.sendto(b"(error no_more_team_or_player_or_goalie)", server.recvfrom(100)[1])

        refusing = threading.Thread(target=refuse)
        refusing.start()
        with pytest.raises(ConnectionRefusedError, match="no_more_team_or_player_or_goalie"):
            World(server=server.getsockname())
        refusing.join()


def test_a_player_can_join_a_running_match() -> None:
    with joined([cycle(0)], mode="play_on") as (world, _server):
        assert world.situation == "play_on"


def test_a_missing_server_is_reported() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as silent:
        silent.bind(("127.0.0.1", 0))
        with pytest.raises(TimeoutError, match=r"no server answers at 127\.0\.0\.1:"):
            World(server=silent.getsockname(), timeout_s=0.01)


@pytest.mark.parametrize(
    ("said", "situation"),
    [
        ("before_kick_off", "waiting"),
        ("kick_off_l", "our_kick"),
        ("kick_off_r", "their_kick"),
        ("play_on", "play_on"),
        ("goal_kick_l", "our_kick"),
        ("goal_l_2", "waiting"),
        ("offside_l", "their_kick"),
        ("foul_charge_l", "their_kick"),
        ("indirect_free_kick_r", "their_kick"),
    ],
)
def test_the_referee_is_understood(said: str, situation: str) -> None:
    with joined([cycle(0, heard=said)]) as (world, _server):
        world.receive_cycle()
        assert world.situation == situation
        assert world.goals == (2 if said == "goal_l_2" else 0)


# The designs


def play(component: type[Component], *situations: dict[str, Any]) -> tuple[list[str], list[str]]:
    """Step a player once in each situation; returns its states, and the commands."""
    commands: list[str] = []
    world = SimpleNamespace(
        situation="play_on", x=0.0, y=0.0, heading=0.0, neck=0.0, stamina=8000.0, ball_x=30.0, ball_y=0.0,
        ball_distance=30.0, ball_direction=0.0, ball_age=0.0, goal_distance=52.5, goal_direction=0.0,
        mate_is_free=False, mate_distance=130.0, mate_direction=0.0, mate_to_ball=130.0, opponent_distance=130.0,
    )  # fmt: skip
    for name in ("dash", "turn", "kick", "catch", "move", "turn_neck"):
        setattr(world, name, lambda name=name, **_given: commands.append(name))
    clock, states = SimulatedClock(), []
    root = Root(component, world=world, clock=clock, on_error="stop")
    for situation in situations:
        vars(world).update(situation)
        root.step()
        clock.advance(100_000_000)
        states.append(root.main.state)
    return states, commands


def test_a_player_runs_to_the_ball_and_shoots() -> None:
    near = {"ball_distance": 0.8, "goal_distance": 15.0}
    states, commands = play(FieldPlayer, {"situation": "waiting"}, {"situation": "play_on"}, {}, {}, {}, near, near)
    assert states == ["TakePosition", "LookForBall", "HoldPosition", "Chase", "Chase", "Shoot", "Shoot"]
    assert [each for each in commands if each != "turn_neck"][:2] == ["move", "turn"]
    assert "dash" in commands
    assert commands[-2:] == ["turn_neck", "kick"]


def test_the_nearest_player_runs() -> None:
    states, _commands = play(
        FieldPlayer, {}, {}, {"mate_to_ball": 10.0}, {}, {"mate_to_ball": 31.0}, {"mate_to_ball": 27.0}
    )
    assert states[2:] == ["HoldPosition", "HoldPosition", "Chase", "HoldPosition"]


@pytest.mark.parametrize(
    ("situation", "state"),
    [
        ({"goal_distance": 10.0, "opponent_distance": 1.0, "mate_is_free": True}, "Shoot"),
        ({"opponent_distance": 1.0, "mate_is_free": True}, "Pass"),
        ({"opponent_distance": 1.0}, "Dribble"),
        ({"situation": "our_kick"}, "TakeKick"),
        ({"situation": "their_kick"}, "HoldPosition"),
    ],
)
def test_at_the_ball_a_player_decides_by_the_situation(situation: dict[str, Any], state: str) -> None:
    assert play(FieldPlayer, {}, {}, {}, {}, {"ball_distance": 0.5, **situation})[0][3:] == ["Chase", state]


def test_the_goalkeeper_catches_and_clears() -> None:
    states, commands = play(
        Goalkeeper, {}, {}, {"ball_x": -42.0, "ball_distance": 8.0}, {"ball_distance": 1.1}, {"situation": "our_kick"},
        {"ball_distance": 0.5}, {"situation": "play_on"},
    )  # fmt: skip
    assert states == ["LookForBall", "Guard", "Meet", "Catch", "Clear", "KickAway", "Guard"]
    assert "catch" in commands
    assert "kick" in commands


# The match


def test_a_match_is_played_recorded_and_replayed(tmp_path: Path) -> None:
    program = tmp_path / "server"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{ROOT}/tests/designs/fake_soccer_server.py" "$@"\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, str(ROOT / "designs" / "soccer2d" / "match.py"), "--server", str(program)]
    options = ["--port", str(port), "--teams", "1", "--players", "2", "--synchronous", "--record", str(tmp_path)]
    played = subprocess.run([*command, *options], cwd=ROOT, check=False, capture_output=True, text=True, timeout=60)
    assert played.returncode == 0, played.stderr
    assert played.stdout.startswith("1:0 after 33 cycles")
    replay = [
        sys.executable,
        "-m",
        "vicode",
        "replay",
        str(tmp_path / "vicode-2.jsonl"),
        "--design",
        "designs/soccer2d",
    ]
    replayed = subprocess.run(replay, cwd=ROOT, check=False, capture_output=True, text=True, timeout=60)
    assert "same states in 32 iterations" in replayed.stdout, replayed


@contextmanager
def watched_match(folder: Path) -> Iterator[subprocess.Popen[str]]:
    """Two players of one process that are recorded and can be controlled."""
    ball = "((b) 0.7 0 0 0)"
    script = [cycle(0), cycle(0, ball, "kick_off_l")]
    script += [cycle(n, ball if n % 60 < 30 else "", "play_on" if n == 1 else "") for n in range(1, 20_000)]
    server = FakeServer(script)
    serving = threading.Thread(target=server.serve)
    serving.start()
    command = [sys.executable, str(ROOT / "designs" / "soccer2d" / "match.py"), "--server", "", "--synchronous"]
    command += ["--port", str(server.address[1]), "--teams", "1", "--players", "2", "--record", str(folder)]
    command += ["--watch", f"unix:{folder / 'live'}", "--control"]
    match = subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, text=True)
    try:
        yield match
    finally:
        match.kill()
        match.communicate(timeout=30)
        server.stop()
        serving.join(30)
        assert not serving.is_alive()


def test_a_match_that_is_paused_and_killed_can_be_replayed(tmp_path: Path) -> None:
    with watched_match(tmp_path) as match, socket.socket(socket.AF_UNIX) as viewer:
        assert match.stderr is not None
        assert match.stderr.readline().startswith("watch: ")
        viewer.settimeout(30)
        viewer.connect(str(tmp_path / "live"))
        lines = viewer.makefile("rw", encoding="utf-8")

        def ask(**request: object) -> None:
            lines.write(json.dumps({"robot": "vicode 2", **request}) + "\n")
            lines.flush()

        def wait_for(*, paused: bool) -> dict[str, Any]:
            received = map(json.loads, lines)
            return next(line for line in received if line.get("robot") == "vicode 2" and line.get("paused") is paused)

        ask(rate_hz=200)
        wait_for(paused=False)
        ask(do="break", places=[["FieldPlayer", "LookForBall"]])
        paused = wait_for(paused=True)
        assert paused["tree"][0]["changed_from"] is not None
        ask(do="step")
        following = wait_for(paused=True)
        assert following["iteration"] == paused["iteration"] + 1
        assert following["time_ns"] == paused["time_ns"] + 100_000_000
        for _attempt in range(1000):
            if last_recorded(tmp_path, "vicode-2") == following["iteration"]:
                break
            time.sleep(0.01)
        match.kill()
        assert lines.read() == ""
    assert last_recorded(tmp_path, "vicode-2") == following["iteration"]
    replay = [
        sys.executable,
        "-m",
        "vicode",
        "replay",
        str(tmp_path / "vicode-2.jsonl"),
        "--design",
        "designs/soccer2d",
    ]
    replayed = subprocess.run(replay, cwd=ROOT, check=False, capture_output=True, text=True, timeout=60)
    assert replayed.returncode == 0, replayed
    assert "FieldPlayer: same states in" in replayed.stdout


def last_recorded(folder: Path, name: str) -> int:
    """The number of the last iteration in a record, without a line that is being written."""
    newest = max(folder.glob(f"{name}.1.*.jsonl"))
    lines = newest.read_text(encoding="utf-8").split("\n")[1:-1]
    return int(json.loads(lines[-1])["iteration"]) if lines else 0
