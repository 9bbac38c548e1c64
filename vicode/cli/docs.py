"""Build a documentation site as static files."""

import argparse
import gc
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from vicode.cli.console import print_findings
from vicode.cli.docs_output import find_output_problem, find_source_url_problem
from vicode.cli.ports import port_number
from vicode.cli.source_encoding import add_encoding_argument
from vicode.output import cache_path
from vicode.services.docs.build_record import find_unchanged_build, save_record
from vicode.services.project_loader import DESIGN_SUFFIXES
from vicode.services.xabsl_encoding import find_encoding


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
    parser.add_argument(
        "--source-url",
        metavar="URL",
        default="",
        help="link sources to a repository: an address with {path}, from the root of the repository, and {line}",
    )
    add_encoding_argument(parser)
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
    options = (args.format, args.title, args.source_url, *_encodings(args))
    record_file = cache_path(args.out, "docs-builds")
    is_incremental = not args.fresh and not args.watch
    record = find_unchanged_build(record_file, options, args.path, args.out) if is_incremental else None
    if record:
        print(record.summary)
        return int(args.strict and record.has_findings)
    problem = _find_option_problem(args)
    if problem:
        print(f"vicode: {problem}", file=sys.stderr)
        return 2
    if not args.watch:
        return _build(args, options, record_file)
    from vicode.cli.docs_watch import watch_docs
    from vicode.services.docs.builder import DocsBuilder

    sites = DocsBuilder(out=args.out, ignores_cache=args.fresh, title=args.title, source_url=args.source_url)
    return watch_docs(args.path, sites, encoding=args.encoding, port=args.port, open_browser=not args.no_open)


def _encodings(args: argparse.Namespace) -> Iterator[str]:
    """The encodings of XABSL files at the paths; those of projects do not count."""
    for path in args.path:
        if path.suffix not in DESIGN_SUFFIXES and not (path / "project.yaml").exists():
            yield find_encoding(path, args.encoding)


def _find_option_problem(args: argparse.Namespace) -> str:
    is_markdown = args.format == "markdown"
    if args.watch and is_markdown:
        return "--watch cannot be combined with --format markdown; use the live reload of MkDocs or Sphinx"
    if not _is_utf8(args.title + args.source_url):
        return "--title and --source-url must be encoded in UTF-8"
    problem = find_source_url_problem(args.source_url)
    return problem or find_output_problem(args.out, args.path, is_markdown=is_markdown)


def _is_utf8(text: str) -> bool:
    """Whether an argument was decoded without errors; other bytes are surrogates."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _build(args: argparse.Namespace, options: Sequence[str], record_file: Path) -> int:
    from vicode.cli.progress import progress_bar
    from vicode.services.docs.builder import DocsBuilder, describe_build, record_build
    from vicode.services.docs.inputs import load_site_inputs

    started_s = time.time()
    sites = DocsBuilder(
        out=args.out,
        ignores_cache=args.fresh,
        is_markdown=args.format == "markdown",
        title=args.title,
        source_url=args.source_url,
    )
    with _gc_disabled(), sites, progress_bar() as step:
        readings = load_site_inputs(args.path, args.encoding)
        for reading in readings:
            print_findings(reading.read_errors, to_stderr=True, encoding=reading.encoding)
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
