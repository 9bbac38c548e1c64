"""Drive simulated robots in a 2D world by the behaviors of a bridge."""

import argparse
import asyncio
import contextlib
import ssl
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from vicode.bica import options
from vicode.cli.console import print_findings
from vicode.cli.ports import port_number
from vicode.findings import escape_text

if TYPE_CHECKING:
    from vicode.simulated_robot.robot_model import RobotModel
    from vicode.simulated_robot.session import SimulationSession
    from vicode.simulated_robot.world_map import WorldMap

T = TypeVar("T")
MISSING_EXTRA = "vicode: simulated robots need pymunk; install it with: pip install 'vicode-fsm[sim]'"
_DEFAULT_SECONDS = 60.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "map",
        metavar="MAP",
        help="a map file (docs/experiments.md), or one of: arena, bent, room, straight, t, two_rooms",
    )
    add("--robots", type=options.count, default=1, metavar="N", help="number of robots (default: 1)")
    add("--host", default="127.0.0.1", metavar="HOST", help="where the bridge runs (default: %(default)s)")
    add("--port", type=port_number, default=7001, metavar="P", help="port of the bridge (default: %(default)s)")
    add("--token", default="", metavar="TEXT", help="token of the bridge, if it has one")
    add("--tls", action="store_true", help="connect with TLS, to a bridge with a certificate that this machine trusts")
    add("--ca", metavar="FILE", type=Path, help="connect with TLS, and trust this certificate in PEM format")
    add("--behavior", default="", metavar="NAME", help="design or agent that drives the robots (default: the bridge's)")
    add(
        "--robot",
        metavar="MODULE:CLASS",
        default="",
        help="a class derived from RobotModel, with the sensors and commands of the robots (docs/experiments.md)",
    )
    add("--world", metavar="MODULE:CLASS", default="", help="send only what this world of the bridge declares")
    path_help = "folder of these modules (default: the current one)"
    add("--path", metavar="DIR", dest="import_path", type=Path, default=Path(), help=path_help)
    add("--seed", type=int, default=1, metavar="N", help="seed of start poses and noise (default: %(default)s)")
    add(
        "--seconds", type=options.seconds, metavar="S", help="stop after S simulated seconds (default in lock step: 60)"
    )
    add("--until-goal", action="store_true", help="stop when all robots are in a goal of the map")
    add("--lock-step", action="store_true", help="as fast as the bridge answers, instead of in real time")
    add("--jxi", action="store_true", help="use the line protocol of JXI instead of JSON lines")
    add(
        "--view",
        type=port_number,
        nargs="?",
        const=0,
        metavar="P",
        help="show the world in the browser, on port P of this machine (default: a free one)",
    )


def run(args: argparse.Namespace) -> int:
    """Connect the robots and simulate until the end."""
    if args.jxi and args.lock_step:
        print("vicode: JXI has no lock step; leave out --jxi or --lock-step", file=sys.stderr)
        return 2
    world_map = read_map(args.map)
    if world_map is None:
        return 1
    try:
        from vicode.simulated_robot.arena import Arena
        from vicode.simulated_robot.session import BridgeAddress, SimulationSession
    except ModuleNotFoundError as error:
        if error.name != "pymunk":
            raise
        print(MISSING_EXTRA, file=sys.stderr)
        return 2
    address = BridgeAddress(
        host=args.host,
        port=args.port,
        behavior=args.behavior,
        token=args.token,
        is_jxi=args.jxi,
        tls=_trust(args.ca) if args.tls or args.ca else None,
    )
    model = _load_model(args)
    if model is None:
        return 2
    arena = Arena(world_map, robots=args.robots, seed=args.seed)
    return _simulate(SimulationSession(arena, address, model=model, is_recorded=False), args)


def _load_model(args: argparse.Namespace) -> "RobotModel | None":
    """What the robots send and obey; None after the reason was printed if that cannot be loaded."""
    from vicode.bica.loader import UserCodeError, describe_user_error
    from vicode.bridge import World
    from vicode.simulated_robot.robot_model import DeclaredSensors, RobotModel

    sys.path.insert(0, str(args.import_path.resolve()))
    try:
        model = _load_class(args.robot, RobotModel)() if args.robot else RobotModel()
        return DeclaredSensors(model, _load_class(args.world, World)().bridge.targets) if args.world else model
    except UserCodeError as error:
        print(f"vicode: {error}", file=sys.stderr)
    except Exception as error:
        print(f"vicode: cannot create the robot: {describe_user_error(error)}", file=sys.stderr)
    return None


def _load_class(name: str, base: type[T]) -> type[T]:
    from vicode.bica.loader import UserCodeError, load_attribute

    found = load_attribute(name)
    if not (isinstance(found, type) and issubclass(found, base)):
        raise UserCodeError(f"{name} is not a {base.__name__}; derive it from {base.__module__}.{base.__name__}")
    return found


def _trust(certificate: Path | None) -> ssl.SSLContext:
    """The settings of TLS that trust one certificate, or those of this machine."""
    try:
        return ssl.create_default_context(cafile=certificate)
    except ssl.SSLError:
        raise OSError(f"{certificate} is not a PEM certificate") from None


def read_map(text: str) -> "WorldMap | None":
    """The map with a name or in a file; None after its errors were printed.

    Raises:
        OSError: There is no such map.
    """
    from vicode.simulated_robot.map_file import load_world_map, map_names, read_world_map

    if text in map_names():
        return load_world_map(text)
    path = Path(text)
    if not path.exists():
        raise OSError(f"no map '{text}'; name a file, or one of: {', '.join(map_names())}")
    result = read_world_map(path.read_bytes(), str(path))
    print_findings(result.findings, to_stderr=True)
    return result.world_map


def _simulate(session: "SimulationSession", args: argparse.Namespace) -> int:
    from vicode.simulated_robot.client import BridgeError

    start = time.perf_counter()
    try:
        with contextlib.ExitStack() as stack:
            asyncio.run(_drive(session, args, stack))
    except ConnectionRefusedError:
        place = f"{args.host}:{args.port}"
        print(f"vicode: nothing listens on {place}; start 'vicode bridge DESIGN' first", file=sys.stderr)
        return 2
    except BridgeError as error:
        print(f"vicode: {error}", file=sys.stderr)
        return 2
    finally:
        if session.arena.now_s:
            _print_summary(session, time.perf_counter() - start)
    return 0


async def _drive(session: "SimulationSession", args: argparse.Namespace, stack: contextlib.ExitStack) -> None:
    view = _open_view(session, args.view, stack)
    arena = session.arena

    def is_over() -> bool:
        return bool(args.until_goal) and all(arena.has_reached_goal(robot) for robot in arena.robots)

    if args.lock_step:
        from vicode.cli.progress import progress_bar

        seconds = args.seconds or _DEFAULT_SECONDS
        advance = stack.enter_context(progress_bar())

        def show() -> None:
            advance(f"{arena.now_s:.0f} s of {seconds:g} s", round(arena.now_s), round(seconds))
            view()

        await session.run_lock_step(seconds, is_over=is_over, on_tick=show)
    else:
        changes = _StatePrinter(session)

        def report() -> None:
            changes.print_new()
            view()

        await session.run_real_time(args.seconds or float("inf"), is_over=is_over, on_tick=report)


def _open_view(session: "SimulationSession", port: int | None, stack: contextlib.ExitStack) -> Callable[[], None]:
    """Start the view, if there is one; the result shows the current situation."""
    if port is None:
        return lambda: None
    from vicode.simulated_robot.view_server import ViewServer

    server: ViewServer = ViewServer(session.arena.map, port)
    stack.callback(server.close)
    print(f"The world is shown at {server.url}", flush=True)
    return lambda: server.publish(session.arena.now_s, session.tracks)


class _StatePrinter:
    """Prints the state changes of the robots."""

    def __init__(self, session: "SimulationSession") -> None:
        self._session = session
        self._states: dict[int, str] = {}
        self._notices: dict[int, int] = {}

    def print_new(self) -> None:
        for track in self._session.tracks:
            number, state = track.robot.number, track.state
            for notice in track.notices[self._notices.get(number, 0) :]:
                print(f"{self._session.arena.now_s:9.2f} s  robot {number}: {escape_text(notice)}", flush=True)
            self._notices[number] = len(track.notices)
            if state and self._states.get(number) != state:
                before = f"{self._states[number]} → " if number in self._states else ""
                self._states[number] = state
                print(f"{self._session.arena.now_s:9.2f} s  robot {number}: {before}{escape_text(state)}", flush=True)


def _print_summary(session: "SimulationSession", wall_s: float) -> None:
    arena = session.arena
    for track in session.tracks:
        robot = track.robot
        words = [f"{robot.driven_m:.2f} m driven", f"{robot.turned:.1f}° turned", f"{robot.contacts} contacts"]
        words += [track.state] if track.state else []
        words += ["at a goal"] if arena.has_reached_goal(robot) else []
        print(f"robot {robot.number}: {', '.join(words)}")
    print(f"{arena.now_s:.1f} s simulated in {wall_s:.1f} s ({arena.now_s / wall_s:.1f} × real time)")
