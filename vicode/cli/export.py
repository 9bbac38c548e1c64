"""Take the drawing of a design out: a picture, or text for Mermaid, PlantUML and Graphviz."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings

if TYPE_CHECKING:
    from vicode.model.design import Design

_FORMATS = ("svg", "pdf", "png", "mermaid", "plantuml", "dot")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `vicode export`."""
    parser.add_argument("file", metavar="FILE", help="a design")
    parser.add_argument("--format", choices=_FORMATS, help="as the name of the output ends; else svg")
    parser.add_argument("-o", "--out", metavar="OUT", help="the file to write; - prints it (beside the design)")
    parser.add_argument("--states", metavar="A,B", help="draw only these states and what they use")
    parser.add_argument("--no-links", action="store_true", help="leave used components out")
    parser.add_argument("--dark", action="store_true", help="light on dark")
    parser.add_argument("--scale", type=float, default=2.0, help="pixels of a PNG to a pixel of the drawing (2)")


def run(args: argparse.Namespace) -> int:
    """Write the file; 1 when the design cannot be read or has no such state."""
    design = _read(Path(args.file))
    if design is None:
        return 1
    # Drawing loads Graphviz's and PDF's writers, which --help has no need of.
    from vicode.diagram.export import export_design
    from vicode.diagram.export_formats import ExportFormat, ExportOptions
    from vicode.output import write_atomically

    only = _states(args.states)
    unknown = sorted((only or frozenset()) - {state.name for state in design.states})
    if unknown:
        print(f"vicode: {args.file} has no state {unknown[0]}", file=sys.stderr)
        return 1
    form = ExportFormat(args.format or _format_from_suffix(args.out))
    wish = ExportOptions(only=only, links=not args.no_links, dark=args.dark, scale=min(max(args.scale, 0.1), 16.0))
    content = export_design(design, form, wish)
    if args.out == "-":
        sys.stdout.buffer.write(content)
        return 0
    out = Path(args.out) if args.out else Path(args.file).with_suffix(form.suffix)
    write_atomically(out, content)
    print(f"wrote {out.as_posix()}")
    return 0


def _read(file: Path) -> "Design | None":
    from vicode.store import read_design

    read = read_design(file.read_bytes(), file.as_posix())
    if read.design is None:
        print_findings(read.findings, to_stderr=True)
    return read.design


def _states(text: str | None) -> frozenset[str] | None:
    return frozenset(name.strip() for name in text.split(",") if name.strip()) if text is not None else None


def _format_from_suffix(out: str | None) -> str:
    suffix = Path(out or "").suffix.lower().lstrip(".")
    names = {"mmd": "mermaid", "puml": "plantuml", "gv": "dot"}
    found = names.get(suffix, suffix)
    return found if found in _FORMATS else "svg"
