"""Export a design as a picture of its diagram, or as a text for other tools."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.cli.source_encoding import add_encoding_argument
from vicode.diagram.export_formats import EXPORT_FORMATS, ExportFormat, ExportOptions, NotExportableError

if TYPE_CHECKING:
    from vicode.model.design import Design
    from vicode.model.project import Project


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help="design file, or XABSL file of an option")
    parser.add_argument(
        "--format", choices=EXPORT_FORMATS, help="output format (default: by the suffix of OUT, else svg)"
    )
    parser.add_argument("-o", "--out", metavar="OUT", help="output file, or - for stdout (default: next to the design)")
    parser.add_argument("--states", metavar="A,B", help="export only these states and the components they use")
    parser.add_argument("--no-links", action="store_true", help="omit used components")
    parser.add_argument("--dark", action="store_true", help="use dark colors")
    parser.add_argument(
        "--scale", type=float, default=2.0, help="resolution of a PNG relative to the diagram (default: %(default)g)"
    )
    add_encoding_argument(parser)


def run(args: argparse.Namespace) -> int:
    """Write the file; return 1 if the design cannot be read or expressed, or a state does not exist."""
    if Path(args.file).is_dir():
        print(f"vicode: {args.file} is a folder; name one design file in it", file=sys.stderr)
        return 2
    design = _read(Path(args.file), args.encoding)
    if design is None:
        return 1
    from vicode.output import resolve_below, write_atomically

    only = _states(args.states)
    unknown = sorted((only or frozenset()) - {state.name for state in design.states})
    if unknown:
        print(f"vicode: {args.file} has no state {unknown[0]}", file=sys.stderr)
        return 1
    form = EXPORT_FORMATS[args.format] if args.format else _format_from_suffix(args.out)
    wish = ExportOptions(
        project=_read_project(Path(args.file)) if form.needs_project else None,
        only=only,
        links=not args.no_links,
        dark=args.dark,
        scale=min(max(args.scale, 0.1), 16.0),
    )
    try:
        content = form.write(design, wish)
    except NotExportableError as error:
        print(f"{args.file}: {error}", file=sys.stderr)
        return 1
    if args.out == "-":
        sys.stdout.buffer.write(content)
        return 0
    out = Path(args.out) if args.out else Path(args.file).with_suffix(form.suffixes[0])
    # A link that was there before is followed if the user names it.
    write_atomically(out if args.out else resolve_below(out.parent, out.name), content)
    print(f"wrote {out.as_posix()}")
    return 0


def _read(file: Path, encoding: str) -> "Design | None":
    from vicode.store import read_design
    from vicode.xabsl.source_loader import EXTENSIONS

    if file.suffix in EXTENSIONS:
        return _read_option(file, encoding)
    read = read_design(file.read_bytes(), file.as_posix())
    if read.design is None:
        print_findings(read.findings, to_stderr=True)
    return read.design


def _read_project(file: Path) -> "Project | None":
    from vicode.store import find_projects, open_project
    from vicode.xabsl.source_loader import EXTENSIONS

    return None if file.suffix in EXTENSIONS else open_project(find_projects(file)[0]).project


def _read_option(file: Path, encoding: str) -> "Design | None":
    from vicode.services.imported_behavior.option_design import read_option

    read = read_option(file, encoding)
    print_findings(read.errors, to_stderr=True, encoding=read.encoding)
    print_findings(read.doubts, to_stderr=True)
    if read.design is None and not read.errors:
        print(f"vicode: {file} defines no option", file=sys.stderr)
    return read.design


def _states(text: str | None) -> frozenset[str] | None:
    return frozenset(name.strip() for name in text.split(",") if name.strip()) if text is not None else None


def _format_from_suffix(out: str | None) -> ExportFormat:
    suffix = Path(out or "").suffix.lower()
    return next((each for each in EXPORT_FORMATS.values() if suffix in each.suffixes), EXPORT_FORMATS["svg"])
