"""Run behaviors for robot programs that connect over a socket."""

import argparse
import asyncio
import gc
import signal
import ssl
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.bridge_behaviors import BridgeSetup, load_bridge

if TYPE_CHECKING:
    from vicode.bridge.server import BridgeServer


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("path", metavar="PATH", help="a design, a folder with a project, or an XABSL file with agents")
    add("--behavior", metavar="NAME", default="", help="what robots run that choose nothing")
    add("--port", type=int, metavar="N", help="port (default: that of project.yaml, or 7001); 0 selects a free one")
    add("--host", metavar="ADDRESS", default="127.0.0.1", help="address to listen at (default: %(default)s)")
    add("--token", metavar="TEXT", default="", help="what robots must send first; required with other addresses")
    add("--cert", metavar="FILE", type=Path, help="certificate (PEM): robots connect with TLS")
    add("--key", metavar="FILE", type=Path, help="key of the certificate, if it is in another file")
    add("--tick-ms", type=options.tick_ms, metavar="MS", help="time between ticks (default: project.yaml, or 50)")
    add("--grace", type=options.seconds, metavar="S", default=10.0, help="how long a robot may be gone (default: 10)")
    add("--world", metavar="MODULE:CLASS", default="", help="class of the world (default: that of project.yaml)")
    add("--path", metavar="DIR", dest="import_path", type=Path, help="folder of the world's module")
    add("--profile", metavar="NAME", default="", help="use the implementations of this profile")
    add("--plain", action="store_true", help="print one line per event; the default if stdout is no terminal")


def run(args: argparse.Namespace) -> int:
    """Load the behaviors, and serve until Ctrl-C or SIGTERM."""
    from vicode.bridge.server import ListenError

    with tempfile.TemporaryDirectory(prefix="vicode-bridge-") as folder:
        setup = load_bridge(args, Path(folder))
        if isinstance(setup, int):
            return setup
        gc.collect()
        gc.freeze()
        try:
            return asyncio.run(_serve(setup, args))
        except ListenError as error:
            print(f"vicode: {error}", file=sys.stderr)
            return 2


async def _serve(setup: BridgeSetup, args: argparse.Namespace) -> int:
    from vicode.bridge.server import BridgeOptions, BridgeServer

    server = BridgeServer(
        setup.catalog,
        setup.make_world,
        BridgeOptions(
            host=args.host,
            port=setup.port,
            tick_ns=setup.tick_ns,
            token=args.token,
            grace_s=args.grace,
            tls=_load_certificate(args),
        ),
    )
    await server.start()
    print(f"listening at {server.address}; behaviors: {', '.join(setup.catalog.names)}", flush=True)
    return await _wait_for_signal(server)


async def _wait_for_signal(server: "BridgeServer") -> int:
    """Serve until a signal, stop all robots, and return the exit code."""
    loop, ended = asyncio.get_running_loop(), asyncio.Event()
    received: list[int] = []

    def end(number: int) -> None:
        received.append(number)
        ended.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, end, number)
    assert server.ticker is not None
    server.ticker.add_done_callback(lambda _task: ended.set())
    await ended.wait()
    await server.stop()
    return 128 + received[0] if received else 1


def _load_certificate(args: argparse.Namespace) -> ssl.SSLContext | None:
    if args.cert is None:
        return None
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(args.cert, args.key)
    return context
