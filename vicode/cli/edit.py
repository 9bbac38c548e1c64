"""Open the editor in the browser."""

import argparse
from pathlib import Path


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
    from vicode.cli.opening import refuse_other_files
    from vicode.editor.serve import choose_address, serve

    path = Path(args.path)
    path.stat()
    refuse_other_files(path)
    serve(path, choose_address(args.host, args.port), open_browser=not args.no_open, tour=not args.no_tour)
    return 0
