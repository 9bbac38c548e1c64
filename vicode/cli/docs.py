"""Build a documentation site as static files."""

import argparse
import gc
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from vicode.cli.console import print_findings
from vicode.cli.docs_record import find_unchanged_build, save_record
from vicode.cli.ports import port_number
from vicode.output import cache_path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "path",
        metavar="PATH",
        nargs="+",
        type=Path,
        help="design file, project folder, folder of projects, or XABSL file with the agents",
    )
    parser.add_argument(
        "--out", metavar="DIR", type=Path, default=Path("site"), help="output folder (default: %(default)s)"
    )
    parser.add_argument(
        "--format",
        choices=("html", "markdown"),
        default="html",
        help="output format; markdown is for MkDocs and Sphinx (default: %(default)s)",
    )
    parser.add_argument(
        "--title",
        metavar="TEXT",
        default="",
        help="title of the site, or of the home page of several sites (default: the project's title)",
    )
    parser.add_argument("--strict", action="store_true", help="exit with code 1 on findings; the site is still written")
    parser.add_argument("--fresh", action="store_true", help="rebuild all pages, ignoring the cache")
    parser.add_argument(
        "--watch", action="store_true", help="serve the site on this machine and rebuild it after every change"
    )
    parser.add_argument(
        "--port", type=port_number, default=0, help="with --watch: port to listen on (default: a free port)"
    )
    parser.add_argument("--no-open", action="store_true", help="with --watch: do not open a browser")


def run(args: argparse.Namespace) -> int:
    """Write the sites; return 1 if a design or behavior cannot be read and, with --strict, for findings."""
    is_markdown = args.format == "markdown"
    if args.watch and is_markdown:
        print(
            "vicode: --watch cannot be combined with --format markdown; use the live reload of MkDocs or Sphinx",
            file=sys.stderr,
        )
        return 2
    if args.watch:
        from vicode.cli.docs_build import DocsBuilder
        from vicode.cli.docs_watch import watch_docs

        sites = DocsBuilder(out=args.out, ignores_cache=args.fresh, title=args.title)
        return watch_docs(args.path, sites, port=args.port, open_browser=not args.no_open)
    options = (args.format, args.title)
    record_file, started_s = cache_path(args.out, "docs-builds"), time.time()
    record = None if args.fresh else find_unchanged_build(record_file, options, args.path, args.out)
    if record:
        print(record.summary)
        return int(args.strict and record.has_findings)
    from vicode.cli.docs_build import DocsBuilder, describe_build, record_build
    from vicode.cli.docs_inputs import load_site_inputs
    from vicode.cli.progress import progress_bar

    sites = DocsBuilder(out=args.out, ignores_cache=args.fresh, is_markdown=is_markdown, title=args.title)
    with _gc_disabled(), sites, progress_bar() as step:
        readings = load_site_inputs(args.path)
        for reading in readings:
            print_findings(reading.read_errors, to_stderr=True)
        built = sites.build(readings, step)
    if built.foreign:
        print(f"vicode: {built.foreign} was not written by vicode docs; choose another --out", file=sys.stderr)
        return 2
    if built.files:
        print(describe_build(built, readings, args.out))
        record = record_build(built, readings, options=options, paths=args.path, out=args.out, started_s=started_s)
        if record:
            save_record(record, record_file)
    has_findings = any(reading.site_input.findings for reading in readings if reading.site_input)
    return int(any(reading.is_incomplete for reading in readings) or (args.strict and has_findings))


@contextmanager
def _gc_disabled() -> Iterator[None]:
    """Disable garbage collection: it takes a tenth of the time and there are no reference cycles to collect."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
