"""`vicode bridge`: what it refuses, what it shows; its way of working is tested in tests/bridge."""

import asyncio
import json
import re
import shutil
import signal
import socket
import subprocess
import sys
from collections import deque
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from tests.bridge.sample_robots import Client, make_server
from tests.cli.command_runner import lamps, vicode
from vicode.cli.bridge_view import PlainBridgeView, TickRates, describe_totals, render_bridge

ROOT = Path(__file__).parents[2]
__all__ = ["lamps"]

LIMIT_S = 30
WORLD = """\
from vicode.bridge import Command, Sensor, World

class Lacking(World):
    laser_max = Sensor("LASER_MAX")
    differential_drive = Command("DIFFERENTIALDRIVE", "speed")
"""


@pytest.fixture
def rescue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the rescue project, which is also where we are; modules imported from it are forgotten."""
    folder = tmp_path / "rescue"
    shutil.copytree(ROOT / "designs" / "rescue", folder, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "lacking.py").write_text(WORLD, encoding="utf-8")
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    yield folder
    for name in [each for each in sys.modules if each.partition(".")[0] in ("arena", "lacking", "rescue")]:
        del sys.modules[name]


def test_names_that_the_world_lacks_are_listed_with_their_places(
    rescue: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert vicode("bridge", "drive_circle.yaml", "--world", "lacking:Lacking") == 1
    assert capsys.readouterr().err.splitlines() == [
        "vicode: lacking:Lacking does not fit the behaviors:",
        "  project.yaml:23:7: output amount_turned of Odometry: the world has no amount_turned",
        "  project.yaml:37:3: component differential_drive: the command has no parameter turning_speed",
    ]
    agents = ROOT / "generated" / "xabsl" / "rescue" / "agents.xabsl"
    assert vicode("bridge", str(agents), "--world", "lacking:Lacking", "--path", ".") == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 11
    assert lines[1].endswith("Odometry.xabsl:4:15: input symbol amount_turned: the world has no amount_turned")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--world", "lacking:Absent"), "cannot load lacking:Absent: AttributeError"),
        (("--world", "arena.world:Corridor"), "is no world of the bridge; derive it from vicode.bridge.World"),
        (("--behavior", "fly"), "there is no behavior 'fly'; choose from: robot1, robot2, drive_circle, walk_corridor"),
        (("--host", "0.0.0.0"), "other machines could connect to 0.0.0.0; add --token"),
        (("--key", "key.pem"), "--key needs --cert"),
        (("--cert", "project.yaml"), "project.yaml is not a PEM certificate"),
        (("--port", "70000"), "70000 is not a port"),
    ],
)
def test_what_cannot_run(
    rescue: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    assert vicode("bridge", ".", *arguments) == 2
    assert message in capsys.readouterr().err


def test_a_project_without_a_world(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("bridge", "lamps") == 2
    assert "add 'bridge: {world: module:Class}' to project.yaml" in capsys.readouterr().err.replace("Add", "add")


XABSL_AGENTS = (
    "generated/xabsl/rescue/agents.xabsl",
    *("--world", "arena.bridge:RescueWorld", "--path", "designs/rescue"),
)


@pytest.mark.parametrize("behaviors", [("designs/rescue",), XABSL_AGENTS])
def test_viewers_see_the_robots_by_their_names(behaviors: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "vicode", "bridge", *behaviors, "--port", "0", "--watch", "0"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        watched = re.search(r"attach 127\.0\.0\.1:(\d+) --token (\S+)", process.stderr.readline())
        port = re.search(r"127\.0\.0\.1:(\d+)", process.stdout.readline())
        assert watched is not None
        assert port is not None
        with (
            socket.create_connection(("127.0.0.1", int(port[1])), timeout=LIMIT_S) as robot,
            socket.create_connection(("127.0.0.1", int(watched[1])), timeout=LIMIT_S) as viewer,
        ):
            robot.sendall(b"ROBOT:nao\nBEHAVIOR:drive_circle\nINS:0,0,0\n")
            viewer.sendall(json.dumps({"token": watched[2]}).encode() + b"\n")
            lines = viewer.makefile("rb")
            message = next(line for line in map(json.loads, lines) if "tree" in line)
        assert (message["robot"], message["tree"][0]["state"]) == ("nao", "turn")
        process.send_signal(signal.SIGINT)
        assert process.wait(LIMIT_S) == 128 + signal.SIGINT


def test_the_table_of_the_robots() -> None:
    async def draw() -> str:
        server = make_server()
        server.address = "127.0.0.1:7001"
        clients = [Client(server) for _number in range(30)]
        for number, client in enumerate(clients):
            client.send(f"ROBOT:nao{number}\nAHEAD:5\njunk\n".encode())
        times = iter(range(100))
        rates = TickRates(lambda: float(next(times)))
        rates.measure(server.robots[0])
        await server.tick_all(50_000_000)
        output = StringIO()
        Console(width=100, file=output).print(render_bridge(server, deque(["an event"]), rates.measure))
        return output.getvalue()

    text = asyncio.run(draw())
    assert "127.0.0.1:7001  30 robots  0 ticks skipped" in text
    assert re.search(r"nao0 +Follow Going +1\.0 +\d+\.\d +\d+\.\d +- +1 +0 +0 +1", text)
    assert "and 6 more" in text
    assert "an event" in text


def test_events_in_lines_and_totals(capsys: pytest.CaptureFixture[str]) -> None:
    async def talk() -> list[str]:
        server = make_server()
        view = PlainBridgeView(server)
        client = Client(server)
        client.send(b"ROBOT:nao\nBEHAVIOR:failing\njunk\nAHEAD:5\nAHEAD:1\n")
        await server.tick_all(50_000_000)
        client.leave()
        view.close()
        view.close()
        return list(describe_totals(server, 2.0))

    totals = asyncio.run(talk())
    lines = [re.sub(r"^ +[\d.]+ s  ", "", line) for line in capsys.readouterr().out.splitlines()]
    assert lines[0] == "nao: connected from 192.0.2.1:4711"
    assert lines[1] == "nao: runs failing when a value has arrived"
    assert lines[2] == "nao: expected TARGET:p1,p2, found 'junk'"
    assert lines[3].startswith("nao: Failing, work, line 3: RuntimeError: no idea")
    assert lines[4] == "nao: disconnected; its state is kept for 10 s"
    assert totals[:2] == ["served for 2.0 s; 0 of 1 ticks skipped", "         1 connections"]
    assert "         1 values replaced before they were read" in totals
    assert totals[-1].startswith("age of the data: median 0.0 ms")
