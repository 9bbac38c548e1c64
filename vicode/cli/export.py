"""Export the diagram of a design as an image or as Mermaid, PlantUML, or Graphviz text."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings

if TYPE_CHECKING:
    from vicode.model.design import Design

_FORMATS = ("svg", "pdf", "png", "mermaid", "plantuml", "dot")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help="design file")
    parser.add_argument("--format", choices=_FORMATS, help="output format (default: by the suffix of OUT, else svg)")
    parser.add_argument("-o", "--out", metavar="OUT", help="output file, or - for stdout (default: next to the design)")
    parser.add_argument("--states", metavar="A,B", help="export only these states and the components they use")
    parser.add_argument("--no-links", action="store_true", help="omit used components")
    parser.add_argument("--dark", action="store_true", help="use dark colors")
    parser.add_argument(
        "--scale", type=float, default=2.0, help="resolution of a PNG relative to the diagram (default: %(default)g)"
    )


def run(args: argparse.Namespace) -> int:
    """Write the file; return 1 if the design cannot be read or a state does not exist."""
    design = _read(Path(args.file))
    if design is None:
        return 1
    # Deferred: these imports load the writers of Graphviz and PDF.
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
