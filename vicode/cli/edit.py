"""Open the editor in the browser."""

import argparse
import os
import sys
from pathlib import Path

_ALLOCATOR = "PYTHONMALLOC"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `vicode edit`."""
    parser.add_argument("path", metavar="PATH", nargs="?", default=".", help="a design or a folder (this one)")
    parser.add_argument("--host", default="127.0.0.1", help="who may connect: an address of this machine (only itself)")
    parser.add_argument("--port", type=_port, help="port to listen on (a free one)")
    parser.add_argument("--no-tour", action="store_true", help="do not begin the tour in a browser that is new here")
    parser.add_argument("--no-open", action="store_true", help="print the address, open no browser")


def _port(text: str) -> int:
    port = int(text)
    if not 0 <= port < 2**16:
        raise ValueError(text)
    return port


def run(args: argparse.Namespace) -> int:
    """Serve the editor until it is ended."""
    from vicode.cli.project_loader import require_design_file
    from vicode.editor.serve import choose_address, serve

    path = Path(args.path)
    path.stat()
    require_design_file(path)
    address = choose_address(args.host, args.port)
    if address.token:
        _reexec_with_system_malloc()
    serve(path, address, open_browser=not args.no_open, tour=not args.no_tour)
    return 0


def _reexec_with_system_malloc() -> None:
    """Be the same command, which gives memory back when people leave; done already, or chosen otherwise: go on.

    Python's own allocator keeps most of what many windows took. It can be chosen only before Python starts.
    """
    if sys.platform == "linux" and _ALLOCATOR not in os.environ:
        os.execve(sys.executable, [sys.executable, *sys.orig_argv[1:]], {**os.environ, _ALLOCATOR: "malloc"})  # noqa: S606 - itself, no shell
