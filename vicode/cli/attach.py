"""Watch running robots in the editor or in the terminal, and control them if they allow it."""

import argparse
import asyncio
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vicode.cli.edit import port_number

if TYPE_CHECKING:
    from vicode.simulation.robots import Hello, RobotAddress, SocketTransport


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("address", metavar="ADDRESS", help="PORT, HOST:PORT or unix:PATH, as the robot prints it")
    add("path", metavar="PATH", nargs="?", default=".", help="design file or folder (default: the current folder)")
    add("--token", help="token that the robot prints (default: VICODE_WATCH_TOKEN)")
    add("--print", action="store_true", help="print one line per state change instead of opening the editor")
    add("--port", type=port_number, help="port of the editor (default: a free port)")
    add("--no-open", action="store_true", help="do not open a browser")


def run(args: argparse.Namespace) -> int:
    """Connect once, so that mistakes are reported here; then print, or serve the editor."""
    from vicode.simulation.robots import TOKEN_VARIABLE, parse_address

    address = parse_address(args.address)
    token = args.token if args.token is not None else os.environ.get(TOKEN_VARIABLE, "")
    if args.print:
        return asyncio.run(_print_changes(address, token))
    asyncio.run(_try(address, token))
    return _edit(args, address, token)


async def _try(address: "RobotAddress", token: str) -> None:
    from vicode.simulation.robots import connect

    transport, hello = await connect(address, token)
    transport.close()
    await transport.wait_closed()
    print(_describe(address, hello), flush=True)


def _edit(args: argparse.Namespace, address: "RobotAddress", token: str) -> int:
    from vicode.cli.project_loader import require_design_file
    from vicode.editor.serve import choose_address, serve

    path = Path(args.path)
    path.stat()
    require_design_file(path)
    here = choose_address("127.0.0.1", args.port)
    serve(path, here, open_browser=not args.no_open, tour=False, robots=(str(address), token))
    return 0


async def _print_changes(address: "RobotAddress", token: str) -> int:
    """Print the state changes of all robots until the connection ends; 1 if robots closed it."""
    from vicode.simulation.robots import connect

    transport, hello = await connect(address, token)
    print(_describe(address, hello), file=sys.stderr, flush=True)
    try:
        await _print_lines(transport, hello)
    finally:
        transport.close()
    print(f"vicode: {(await transport.explain_end())[0].lower()}", file=sys.stderr)
    return 1


async def _print_lines(transport: "SocketTransport", hello: "Hello") -> None:
    from vicode.simulation.robots import decode_line

    is_alone = len(hello.robots) == 1
    seen: set[str] = set()
    while line := await transport.receive():
        message = decode_line(line)
        if "tree" in message:
            robot = str(message.get("robot"))
            lines = _lines(message, is_first=robot not in seen)
            seen.add(robot)
            for each in lines:
                print(each if is_alone and len(seen) == 1 else f"{robot}  {each}", flush=True)


def _lines(message: Mapping[str, Any], *, is_first: bool) -> list[str]:
    """The active states at first, then the changes since the last message, and errors."""
    lines = []
    if is_first:
        lines = [
            _line(message["time_ns"], f"{step['component']}: {step['state']}")
            for step in message["tree"]
            if step["state"]
        ]
    else:
        for change in message.get("changes", ()):
            cause = f"  ({change['transition']})" if change["transition"] else ""
            words = f"{change['component']}: {change['source']} → {change['target']}{cause}"
            lines.append(_line(change["time_ns"], words))
    for error in message.get("errors", ()):
        lines.append(_line(message["time_ns"], f"error in {error.get('component')}: {error.get('message')}"))
    return lines


def _line(time_ns: int, words: str) -> str:
    return f"{time_ns / 1e9:8.2f} s  {words}"


def _describe(address: "RobotAddress", hello: "Hello") -> str:
    names = ", ".join(robot.name for robot in hello.robots) or "no robot yet"
    access = "with control" if hello.control else "may only be watched"
    return f"attached to {address}: {names} ({access})"
