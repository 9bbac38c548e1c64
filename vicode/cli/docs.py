"""Write the documentation of projects as a site of plain files."""

import argparse
import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from vicode.cli.console import print_findings


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `vicode docs`."""
    parser.add_argument(
        "path",
        metavar="PATH",
        nargs="+",
        type=Path,
        help="a design, a project's folder, a folder of projects, an agents.xabsl",
    )
    parser.add_argument("--out", metavar="DIR", type=Path, default=Path("site"), help="where to write (site)")
    parser.add_argument(
        "--format", choices=("html", "markdown"), default="html", help="markdown: pages for mkdocs and Sphinx (html)"
    )
    parser.add_argument(
        "--title", metavar="TEXT", default="", help="what the site is called, or the home of several (their own names)"
    )
    parser.add_argument("--strict", action="store_true", help="fail on findings; the site is written all the same")
    parser.add_argument("--fresh", action="store_true", help="make every page anew, whatever is known of the last time")
    parser.add_argument(
        "--watch", action="store_true", help="go on: build again after every change, and show the site in the browser"
    )
    parser.add_argument("--port", type=int, default=0, help="with --watch: the port on this machine (a free one)")
    parser.add_argument("--no-open", action="store_true", help="with --watch: print the address, open no browser")


def run(args: argparse.Namespace) -> int:
    """Write the sites; 1 when a design or behavior cannot be read, or with --strict has findings."""
    from vicode.cli.docs_build import DocsBuilder, describe_build
    from vicode.cli.docs_inputs import load_site_inputs
    from vicode.cli.progress import progress_bar

    is_markdown = args.format == "markdown"
    if args.watch and is_markdown:
        print("vicode: --watch shows pages in HTML; mkdocs and Sphinx watch Markdown themselves", file=sys.stderr)
        return 2
    if args.watch:
        from vicode.cli.docs_watch import watch_docs

        sites = DocsBuilder(out=args.out, ignores_cache=args.fresh, title=args.title)
        return watch_docs(args.path, sites, port=args.port, open_browser=not args.no_open)
    sites = DocsBuilder(out=args.out, ignores_cache=args.fresh, is_markdown=is_markdown, title=args.title)
    with _gc_disabled(), sites, progress_bar() as step:
        readings = load_site_inputs(args.path)
        for reading in readings:
            print_findings(reading.read_errors, to_stderr=True)
        built = sites.build(readings, step)
    if built.foreign:
        print(f"vicode: {built.foreign} is no page of ours; choose another --out", file=sys.stderr)
        return 2
    if built.files:
        print(describe_build(built, readings, args.out))
    has_findings = any(reading.site_input.findings for reading in readings if reading.site_input)
    return int(any(reading.is_incomplete for reading in readings) or (args.strict and has_findings))


@contextmanager
def _gc_disabled() -> Iterator[None]:
    """Let nothing look for circles meanwhile: that takes a tenth of the time, and finds none."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
