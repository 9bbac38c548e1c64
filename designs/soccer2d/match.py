#!/usr/bin/env python3
"""Plays half a match on rcssserver, the RoboCup 2D soccer simulator, with two teams of vicode players.

All players run in this process, each with its own root and its own connection, one after the other in each cycle. The
server binds all network interfaces; to keep it and the players apart from the network, run them in a namespace:

    unshare --net --map-root-user sh -c 'ip link set lo up; exec python designs/soccer2d/match.py …'
"""

import argparse
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "generated" / "python"), str(HERE.parents[1] / "generated" / "python"), str(HERE)]

from rcss.world import World  # noqa: E402 - needs the paths
from soccer.field_player import FieldPlayer  # noqa: E402
from soccer.goalkeeper import Goalkeeper  # noqa: E402

from vicode.bica import Root, WorldClock  # noqa: E402

TEAMS = ("vicode", "bica")
FORMATION = (
    (-37, -15), (-39, -5), (-39, 5), (-37, 15),
    (-22, -20), (-18, -7), (-18, 7), (-22, 20),
    (-3, -18), (-10.5, 0), (-3, 18),
)  # fmt: skip
"""Places of the field players at the kick-off."""


def main() -> int:
    options = make_parser().parse_args()
    begin_s = time.monotonic()
    with ExitStack() as match:
        if options.server:
            match.enter_context(run_server(options))
        roots = [root for team in TEAMS[: options.teams] for root in join(team, options, match)]
        play(roots)
    world, seconds = roots[0].world, time.monotonic() - begin_s
    sys.stdout.write(f"{world.goals}:{world.conceded} after {world.cycle} cycles in {seconds:.1f} s\n")
    return int(any(root.errors for root in roots))


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--server", default="rcssserver", help="the server program, or '' if it runs already (default: %(default)s)")
    add("--port", type=int, default=6000, help="UDP port of the server (default: %(default)s)")
    add("--half", type=int, default=300, metavar="S", help="length of the half in seconds of the game (default: 300)")
    add("--synchronous", action="store_true", help="play as fast as the machine can, not in real time")
    add("--teams", type=int, choices=(1, 2), default=2, help="one team plays without opponents")
    add(
        "--players",
        type=int,
        choices=range(1, 12),
        default=11,
        metavar="N",
        help="players of each team, the goalkeeper included (default: 11)",
    )
    add("--watch", metavar="ADDRESS", help="let viewers connect, such as unix:match.sock (vicode attach ADDRESS)")
    add("--control", action="store_true", help="viewers may pause players and change values")
    add("--record", type=Path, metavar="FOLDER", help="record each player")
    return parser


@contextmanager
def run_server(options: argparse.Namespace) -> Iterator[None]:
    """Run the server in a temporary folder, where it keeps its configuration."""
    program = shutil.which(options.server)
    if program is None:
        sys.exit(f"{options.server} was not found; build github.com/rcsoccersim/rcssserver and pass --server PROGRAM")
    parameters = {
        "port": options.port,
        "half_time": options.half,
        "nr_normal_halfs": 1,
        "nr_extra_halfs": 0,
        "penalty_shoot_outs": "false",
        "auto_mode": "true",
        # In cycles, which take no time in synchronous mode while no player is connected.
        "connect_wait": 100_000 if (options.teams, options.players) == (2, 11) else 300,
        "kick_off_wait": 10,
        "game_over_wait": 10,
        "synch_mode": str(options.synchronous).lower(),
        "text_logging": "false",
        "game_logging": "false",
    }
    command = [program, *(f"server::{name}={value}" for name, value in parameters.items())]
    with tempfile.TemporaryDirectory() as folder, Path(folder, "server.log").open("wb") as log:
        server = subprocess.Popen(command, cwd=folder, env={"HOME": folder}, stdout=log, stderr=log)
        try:
            wait_for_server(server, options.port, Path(log.name))
            yield
        finally:
            server.send_signal(signal.SIGINT)
            server.wait()


def wait_for_server(server: subprocess.Popen[bytes], port: int, log: Path) -> None:
    """Wait until the server has opened its port."""
    while f":{port:04X} " not in Path("/proc/net/udp").read_text():
        if server.poll() is not None:
            sys.exit(f"the server ended: {log.read_text(errors='replace').strip().splitlines()[-1:]}")
        time.sleep(0.05)


def join(team: str, options: argparse.Namespace, match: ExitStack) -> Iterator[Root]:
    """Connect the players of a team; a goalkeeper is the first."""
    for number in range(options.players):
        world = World(team=team, goalkeeper=number == 0, server=("127.0.0.1", options.port))
        if number == 0:
            root = Root(Goalkeeper, world=world, clock=WorldClock(world))
        else:
            home_x, home_y = FORMATION[number - 1]
            root = Root(FieldPlayer, world=world, clock=WorldClock(world), home_x=home_x, home_y=home_y)
        match.enter_context(root)
        name = f"{team} {world.number}"
        if options.watch:
            root.watch(options.watch, control=options.control, name=name)
        if options.record:
            root.record(options.record / f"{name.replace(' ', '-')}.jsonl", minutes=options.half / 30)
        yield root


def play(roots: list[Root]) -> None:
    """Step all players in each cycle until the match is over."""
    while not any(root.world.finished for root in roots):
        for root in roots:
            if root.clock.wait():
                root.step()
                # Before the other players wait: a synchronous server continues when it has the commands of all.
                root.world.send_commands()


if __name__ == "__main__":
    sys.exit(main())
