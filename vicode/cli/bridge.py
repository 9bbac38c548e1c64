"""Run behaviors for robot programs that connect over a socket."""

import argparse
import asyncio
import gc
import os
import signal
import ssl
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.bridge_behaviors import LoadedBehaviors, load_behaviors, load_world
from vicode.cli.ports import port_number
from vicode.output import temporary_folder
from vicode.platform import end_signals

if TYPE_CHECKING:
    from collections.abc import Callable

    from vicode.bridge import World
    from vicode.bridge.robot import Robot
    from vicode.bridge.server import BridgeServer
    from vicode.cli.bridge_view import BridgeView


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("path", metavar="PATH", help="a design, a folder with a project, or an XABSL file with agents")
    add("--behavior", metavar="NAME", default="", help="the behavior of robots that choose none")
    add(
        "--port",
        type=port_number,
        metavar="N",
        help="port; 0 for a free one (default: that of project.yaml, or 7001)",
    )
    add("--host", metavar="ADDRESS", default="127.0.0.1", help="address to listen on (default: %(default)s)")
    add("--token", metavar="TEXT", help="token that robots must send first (default: VICODE_BRIDGE_TOKEN, or none)")
    add("--cert", metavar="FILE", type=Path, help="certificate in PEM format: robots connect with TLS")
    add("--key", metavar="FILE", type=Path, help="key of the certificate, if it is not in the same file")
    add("--tick-ms", type=options.tick_ms, metavar="MS", help="time between ticks (default: project.yaml, or 50)")
    add(
        "--command-rate",
        type=_frequency,
        metavar="HZ",
        default=4.0,
        help="command lines per second for robots that acknowledge none (default: %(default)g)",
    )
    add(
        "--grace",
        type=options.seconds,
        metavar="S",
        default=10.0,
        help="how long the state of a disconnected robot is kept, in seconds (default: %(default)g)",
    )
    add("--world", metavar="MODULE:CLASS", default="", help="class of the world (default: that of project.yaml)")
    add("--path", metavar="DIR", dest="import_path", type=Path, help="folder of the module (default: that of PATH)")
    add("--profile", metavar="NAME", default="", help="use the implementations of this profile")
    add("--watch", metavar="ADDRESS", help="let 'vicode attach' connect: PORT, HOST:PORT or unix:PATH (docs/live.md)")
    add("--reload", action="store_true", help="exchange the code of the robots when a design or a module changes")
    add("--plain", action="store_true", help="print one line per event; the default if stdout is not a terminal")


def run(args: argparse.Namespace) -> int:
    """Load the behaviors and the world, and serve until Ctrl-C or SIGTERM."""
    from vicode.bridge.server import ListenError

    with temporary_folder("bridge") as folder:
        # The generated code is only imported, once.
        sys.dont_write_bytecode = True
        loaded = load_behaviors(args, folder)
        if isinstance(loaded, int):
            return loaded
        world_class = load_world(args.world or loaded.settings.world, loaded)
        if isinstance(world_class, int):
            return world_class
        # What is loaded so far stays: collections need not look at it.
        gc.collect()
        gc.freeze()
        try:
            return asyncio.run(_serve(loaded, world_class, args, folder))
        except ListenError as error:
            print(f"vicode: {error}", file=sys.stderr)
            return 2


async def _serve(loaded: LoadedBehaviors, world_class: "type[World]", args: argparse.Namespace, folder: Path) -> int:
    from vicode.bridge.server import DEFAULT_PORT, DEFAULT_TICK_MS, BridgeOptions, BridgeServer
    from vicode.cli.bridge_view import open_view

    settings = loaded.settings
    port = next(each for each in (args.port, settings.port, DEFAULT_PORT) if each is not None)
    server = BridgeServer(
        loaded.catalog,
        world_class,
        BridgeOptions(
            host=args.host,
            port=port,
            tick_ns=round((args.tick_ms or settings.tick_ms or DEFAULT_TICK_MS) * 1e6),
            token=os.environ.get("VICODE_BRIDGE_TOKEN", "") if args.token is None else args.token,
            grace_s=args.grace,
            tls=_load_certificate(args),
            command_rate_hz=args.command_rate,
        ),
    )
    observers: list[Callable[[Robot], None]] = []
    if args.watch is not None:
        observers.append(_let_viewers_connect(args.watch))
    if args.reload:
        from vicode.cli.bridge_reload import BridgeReloader

        reloader = BridgeReloader(server, args, folder)
        reloader.start()
        observers.append(reloader.follow)

    def start(robot: "Robot") -> None:
        for observe in observers:
            observe(robot)

    server.on_start = start
    await server.start()
    # Programs that start the bridge read this line.
    print(f"listening at {server.address}; behaviors: {', '.join(loaded.catalog.names)}", flush=True)
    view = open_view(server, is_plain=args.plain)
    try:
        return await _wait_for_signal(server, view)
    finally:
        view.close()


async def _wait_for_signal(server: "BridgeServer", view: "BridgeView") -> int:
    """Serve until a signal, stop all robots, and return the exit code."""
    loop, ended = asyncio.get_running_loop(), asyncio.Event()
    received: list[int] = []

    def end(number: int) -> None:
        received.append(number)
        ended.set()

    for signal_number in end_signals():
        # Windows has no `loop.add_signal_handler`.
        signal.signal(signal_number, lambda number, _frame: loop.call_soon_threadsafe(end, number))
    ticker = server.ticker
    assert ticker is not None
    ticker.add_done_callback(lambda _task: ended.set())
    await ended.wait()
    await server.stop()
    view.close()
    if not received:
        ticker.result()
    return 128 + received[0]


def _let_viewers_connect(address: str) -> "Callable[[Robot], None]":
    """Open the view; the result shows the components or options of a robot to viewers."""
    from vicode.bica.live_server import LiveServer
    from vicode.bridge.behaviors import DesignBehavior, XabslBehavior
    from vicode.bridge.engine_feed import EngineFeed

    viewers = LiveServer(address, token=os.environ.get("VICODE_WATCH_TOKEN", ""), stays_open=True)
    print(
        f"watch: vicode attach {viewers.address}{f' --token {viewers.token}' if viewers.token else ''}", file=sys.stderr
    )

    def show(robot: "Robot") -> None:
        behavior = robot.behavior
        if isinstance(behavior, DesignBehavior):
            viewers.add(behavior.root, robot.name)
        elif isinstance(behavior, XabslBehavior):
            feed = viewers.add_feed(robot.name, lambda name, wake: EngineFeed(behavior, name, wake))
            behavior.on_close = lambda: viewers.remove(feed)

    return show


def _frequency(text: str) -> float:
    number = float(text)
    if not 1e-3 <= number <= 1e6:
        raise argparse.ArgumentTypeError(f"{text} is not a valid rate; write a number per second, such as 4")
    return number


def _load_certificate(args: argparse.Namespace) -> ssl.SSLContext | None:
    if args.cert is None:
        if args.key is not None:
            raise OSError("--key needs --cert")
        return None
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    try:
        context.load_cert_chain(args.cert, args.key)
    except ssl.SSLError as error:
        raise OSError(f"{args.cert} is not a PEM certificate, or does not match the key: {error.reason}") from None
    return context
