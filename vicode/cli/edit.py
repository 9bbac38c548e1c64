"""Open the editor in a browser."""

import argparse
import os
import sys
from pathlib import Path

from vicode.cli.ports import port_number

_ALLOCATOR = "PYTHONMALLOC"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "path", metavar="PATH", nargs="?", default=".", help="design file or folder (default: the current folder)"
    )
    parser.add_argument(
        "--host", default="127.0.0.1", help="address to listen on (default: %(default)s, this machine only)"
    )
    parser.add_argument("--port", type=port_number, help="port to listen on (default: a free port)")
    parser.add_argument(
        "--editor",
        metavar="COMMAND",
        type=_command,
        default=(),
        help="open code with this command, such as 'code -g {file}:{line}' (default: $VISUAL, if it is a known editor)",
    )
    parser.add_argument("--no-tour", action="store_true", help="do not start the tour for new users")
    parser.add_argument("--no-open", action="store_true", help="do not open a browser")


def _command(text: str) -> tuple[str, ...]:
    from vicode.editor.session.external_editor import parse_command

    return parse_command(text)


def run(args: argparse.Namespace) -> int:
    """Serve the editor until it is stopped."""
    serve_editor(
        args.path,
        args.host,
        args.port,
        open_browser=not args.no_open,
        tour=not args.no_tour,
        editor_command=args.editor,
    )
    return 0


def serve_editor(
    name: str,
    host: str,
    port: int | None,
    *,
    open_browser: bool,
    tour: bool,
    editor_command: tuple[str, ...] = (),
    robots: tuple[str, str, str] | None = None,
) -> None:
    """Serve the editor for a design or folder until it is stopped: the only place where a command starts it.

    Raises:
        OSError: The path cannot be read, or the address is taken.
    """
    from vicode.editor.serve import choose_address, serve
    from vicode.services.project_loader import require_design_file

    path = Path(name)
    path.stat()
    require_design_file(path)
    address = choose_address(host, port)
    if address.token:
        _reexec_with_system_malloc()
    serve(path, address, open_browser=open_browser, tour=tour, editor_command=editor_command, robots=robots)


def _reexec_with_system_malloc() -> None:
    """Restart this command with the allocator of the system unless an allocator is already selected.

    Python's allocator keeps most of the memory of closed windows. It can be selected only before Python starts.
    """
    if sys.platform == "linux" and _ALLOCATOR not in os.environ:
        os.execve(sys.executable, [sys.executable, *sys.orig_argv[1:]], {**os.environ, _ALLOCATOR: "malloc"})  # noqa: S606 - the same command, no shell
