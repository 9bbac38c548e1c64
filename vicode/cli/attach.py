"""Watch running robots in the editor or in the terminal, and control them if they allow it."""

import argparse
import asyncio
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.ports import port_number
from vicode.findings import escape_text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from vicode.robots import Hello, RobotAddress, SocketTransport
    from vicode.traces.descriptions import TraceRecord


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "address",
        metavar="ADDRESS",
        nargs="?",
        help="PORT, HOST:PORT or unix:PATH, as the robot prints it, or its name",
    )
    add("path", metavar="PATH", nargs="?", default=".", help="design file or folder (default: the current folder)")
    add("--find", action="store_true", help="list the robots that are connected (docs/network.md) and can be watched")
    add("--token", help="token that the robot prints (default: VICODE_WATCH_TOKEN)")
    add("--print", action="store_true", help="print one line per state change instead of opening the editor")
    add("--console", action="store_true", help="print state changes, and read commands: pause, set, break, … (help)")
    add("--port", type=port_number, help="port of the editor (default: a free port)")
    add("--no-open", action="store_true", help="do not open a browser")


def run(args: argparse.Namespace) -> int:
    """Connect once, so that mistakes are reported here; then print, or serve the editor."""
    from vicode.deployment.cpp_program import LIVE_HINT
    from vicode.robots import TOKEN_VARIABLE, AttachError, parse_address
    from vicode.services.robot_search import find_address

    if args.find:
        return _print_robots()
    if args.address is None:
        print("vicode: give the address of a robot, or --find to list the robots", file=sys.stderr)
        return 2
    address = parse_address(find_address(args.address))
    token = args.token if args.token is not None else os.environ.get(TOKEN_VARIABLE, "")
    if args.console:
        from vicode.cli.attach_console import run_console

        return run_console(address, token, Path(args.path))
    if args.print:
        return asyncio.run(_print_changes(address, token))
    try:
        root = asyncio.run(_try(address, token))
    except AttachError as error:
        if not error.is_final and _needs_live(Path(args.path)):
            raise AttachError(f"{error}; {LIVE_HINT}") from error
        raise
    return _edit(args, address, token, root)


def _print_robots() -> int:
    from vicode.bica.net_session import find_watched
    from vicode.services.robot_search import is_reachable

    robots = find_watched()
    for robot, host, address in robots:
        print(escape_text(f"{robot}  {address}") + ("" if is_reachable(host, address) else f"  (only on {host})"))
    if not robots:
        print("vicode: no robot was found; connect robots with --net NAME --watch ADDRESS", file=sys.stderr)
    return 0 if robots else 1


def _needs_live(path: Path) -> bool:
    from vicode.store import open_project

    project = open_project(path if path.is_dir() else path.parent).project
    return "cpp" in project.languages and not project.live


async def _try(address: "RobotAddress", token: str) -> str:
    """Connect once; returns the root component of the robot that the editor shows first."""
    from vicode.robots import connect

    transport, hello = await connect(address, token)
    transport.close()
    await transport.wait_closed()
    print(_describe(address, hello), flush=True)
    return hello.robots[0].root if hello.robots else ""


def _edit(args: argparse.Namespace, address: "RobotAddress", token: str, root: str) -> int:
    from vicode.cli.edit import serve_editor

    serve_editor(
        args.path,
        "127.0.0.1",
        args.port,
        open_browser=not args.no_open,
        tour=False,
        robots=(str(address), token, root),
    )
    return 0


async def _print_changes(address: "RobotAddress", token: str) -> int:
    """Print the state changes of all robots until the connection ends; 1 if robots closed it."""
    from vicode.robots import connect

    transport, hello = await connect(address, token)
    print(_describe(address, hello), file=sys.stderr, flush=True)
    try:
        await _print_lines(transport, hello)
    finally:
        transport.close()
    print(f"vicode: {(await transport.explain_end())[0].lower()}", file=sys.stderr)
    return 1


async def _print_lines(transport: "SocketTransport", hello: "Hello") -> None:
    from vicode.robots import decode_line

    seen: set[str] = set()
    while line := await transport.receive():
        message = decode_line(line)
        if "tree" in message:
            for each in describe_changes(message, seen, is_alone=len(hello.robots) == 1):
                print(each, flush=True)


def describe_changes(message: "TraceRecord", seen: set[str], *, is_alone: bool) -> list[str]:
    """The lines of a message; each has the name of its robot if there are several. `seen` gets the name."""
    from vicode.traces.descriptions import describe_message

    robot = escape_text(str(message.get("robot")))
    lines = describe_message(message, is_first=robot not in seen)
    seen.add(robot)
    return lines if is_alone and len(seen) == 1 else [f"{robot}  {each}" for each in lines]


def describe_connection(address: "RobotAddress", robots: "Iterable[str]", *, control: bool) -> str:
    names = escape_text(", ".join(robots)) or "no robot yet"
    return f"attached to {address}: {names} ({'with control' if control else 'may only be watched'})"


def _describe(address: "RobotAddress", hello: "Hello") -> str:
    return describe_connection(address, (robot.name for robot in hello.robots), control=hello.control)
