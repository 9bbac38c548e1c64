"""Import an XABSL behavior as designs, or merge its changes; or import SCXML, C++ sources, or files of other tools."""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.source_encoding import add_encoding_argument
from vicode.cli.xabsl_behavior import print_behavior_findings, print_encoding_doubts
from vicode.findings import count_findings
from vicode.services.project_loader import XABSL_SUFFIXES
from vicode.services.xabsl_encoding import project_encoding

if TYPE_CHECKING:
    from vicode.importers import ImportResult
    from vicode.importers.scxml import ScxmlImport
    from vicode.services.imported_behavior.import_record import ImportRecord
    from vicode.xabsl.source_loader import ProgramSource


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "agents",
        metavar="PATH",
        type=Path,
        help="XABSL file with the agents, SCXML file, C++ file or folder with options of CABSL or boost::sml tables, "
        "or file or folder of VICODE (X.xml), rqt BICA (X.bica), FlexBE (x_sm.py) or YASMIN (x.xml)",
    )
    parser.add_argument(
        "--out", metavar="DIR", type=Path, required=True, help="project folder to create, such as designs/NAME"
    )
    parser.add_argument("--name", help="project name (default: the name of the folder)")
    add_encoding_argument(parser)
    parser.add_argument(
        "--event-queue", action="store_true", help="of SCXML: let events arrive through a queue, so that none is lost"
    )
    parser.add_argument("--force", action="store_true", help="overwrite existing designs instead of merging")


def run(args: argparse.Namespace) -> int:
    """Write the designs; return 1 if the behavior has errors, files would be overwritten, or there are conflicts."""
    if args.agents.suffix == ".scxml":
        return _import_scxml(args)
    if args.event_queue:
        raise OSError("--event-queue is an option of SCXML files")
    if args.agents.is_dir() or args.agents.suffix not in XABSL_SUFFIXES:
        return _import_machines(args)
    from vicode.findings import Severity
    from vicode.importers import import_behavior, render_robot_class
    from vicode.services.imported_behavior.design_files import design_paths, format_files, with_layout, write_files
    from vicode.services.imported_behavior.import_record import RECORD_FILE, format_record, read_record
    from vicode.store.documents import default_project_name
    from vicode.xabsl.behavior_loader import load_behavior
    from vicode.xabsl.compiler import compile_source

    encoding = args.encoding or project_encoding(args.out) or project_encoding(args.agents)
    source = load_behavior(args.agents, encoding)
    compiled = compile_source(source)
    print_encoding_doubts(source, args.agents)
    if compiled.program is None:
        errors = [each for each in compiled.findings if each.severity is Severity.ERROR]
        print_behavior_findings(errors, args.agents, encoding)
        print(f"nothing written: {count_findings(compiled.findings)}", file=sys.stderr)
        return 1
    imported = import_behavior(source, compiled, args.name or default_project_name(args.out.resolve().name))
    imported = replace(imported, project=replace(imported.project, xabsl_encoding=encoding))
    record = None if args.force else read_record(args.out)
    if record is not None:
        return _merge(args.out, record, source, args.name, encoding)
    texts = format_files(replace(imported, project=with_layout(imported.project)))
    if _would_overwrite(args, texts):
        return 1
    write_files(args.out, {**texts, RECORD_FILE: format_record(args.out, source, design_paths(imported))})
    robot = args.out / "robot.py"
    # Edited by hand: never overwritten.
    if not robot.exists():
        write_files(args.out, {robot.name: render_robot_class(imported.project)})
    print(_summary(imported, args.out))
    _print_notes(imported, args.agents.parent, "XABSL files")
    return 0


def _print_notes(imported: "ImportResult", folder: Path, sources: str) -> None:
    if imported.notes:
        print(f"the designs cannot express {_count(len(imported.notes), 'detail')} of the {sources}:")
    for note in imported.notes:
        path = Path(os.path.relpath(note.file.resolve(), folder.resolve()))
        print(f"  {path.as_posix()}:{note.line}: {note.text}")


def _import_machines(args: argparse.Namespace) -> int:
    """Write the machines of C++ sources or other tools; return 1 for unreadable files, or ones to overwrite."""
    from vicode.cli.console import print_findings
    from vicode.services.imported_behavior.cpp_sources import find_cpp_files, load_cpp
    from vicode.services.imported_behavior.design_files import format_files, with_layout, write_files
    from vicode.services.imported_behavior.other_tools import find_other_files, load_other
    from vicode.store.documents import default_project_name

    name = args.name or default_project_name(args.out.resolve().name)
    files = () if find_cpp_files(args.agents) else find_other_files(args.agents)
    folder = args.agents if args.agents.is_dir() else args.agents.parent
    if files:
        result, errors = load_other(files, folder, name)
    else:
        converted = load_cpp([args.agents], name)
        result, errors = converted.result, converted.errors
    print_findings(errors, to_stderr=True)
    if files and not result.designs:
        return 1
    imported = replace(result, project=with_layout(result.project))
    texts = format_files(imported)
    if _would_overwrite(args, texts):
        return 1
    write_files(args.out, texts)
    print(_summary(imported, args.out))
    _print_notes(imported, Path(), "files" if files else "C++ files")
    return int(bool(errors))


def _import_scxml(args: argparse.Namespace) -> int:
    """Write the designs; return 1 if the document cannot be expressed, or files would be overwritten."""
    from vicode.cli.console import print_findings
    from vicode.importers import ImportedDesign, ImportResult
    from vicode.importers.design_names import design_files
    from vicode.importers.scxml import ScxmlError, import_scxml
    from vicode.model.names import name_from_text, snake_case
    from vicode.services.imported_behavior.design_files import format_files, with_layout, write_files
    from vicode.services.imported_behavior.event_queue import render_event_queue
    from vicode.store.documents import default_project_name

    component = name_from_text(args.agents.stem) or "Machine"
    name = args.name or default_project_name(args.out.resolve().name)
    try:
        converted = import_scxml(args.agents.read_bytes(), component, name, has_queue=args.event_queue)
    except ScxmlError as error:
        print_findings([error.finding(args.agents)], to_stderr=True)
        return 1
    names = [design.component for design in converted.project.designs]
    paths = zip(names, design_files(map(snake_case, names)), strict=True)
    about = tuple(
        ImportedDesign(component=name, path=path, comments=(), file=args.agents, anchors=()) for name, path in paths
    )
    imported = ImportResult(project=with_layout(converted.project), designs=about, comments=())
    texts = {**format_files(imported), **render_event_queue(converted)}
    if _would_overwrite(args, texts):
        return 1
    write_files(args.out, texts)
    print(_summary(imported, args.out))
    _print_exactness(converted, args.agents)
    return 0


def _print_exactness(converted: "ScxmlImport", file: Path) -> None:
    """Print how many transitions are exact, and why others are not."""
    from vicode.importers.scxml import Exactness

    found = [each.exactness for each in converted.transitions]
    counts = ", ".join(f"{found.count(each)} {each}" for each in Exactness if each in found)
    print(f"{_count(len(found), 'transition')}{counts and ': '}{counts}")
    inexact = [(each.line, each.text) for each in converted.transitions if each.exactness is not Exactness.EXACT]
    for line, text in sorted([*converted.notes, *inexact]):
        print(f"  {file.as_posix()}:{line}: {text}")
    if Exactness.LOSSY in found and not converted.events.has_queue:
        print("with --event-queue, no event is lost")


def _would_overwrite(args: argparse.Namespace, texts: "dict[str, str]") -> bool:
    there = [path for path in texts if (args.out / path).exists()]
    if there and not args.force:
        more = f" and {len(there) - 1} more" if len(there) > 1 else ""
        print(f"vicode: {args.out / there[0]}{more} would be overwritten; use --force", file=sys.stderr)
        return True
    return False


def _merge(folder: Path, record: "ImportRecord", source: "ProgramSource", name: str | None, encoding: str) -> int:
    """Merge the changes of a behavior since its last import into the designs."""
    from vicode.services.imported_behavior.import_merge import merge_behavior

    merge = merge_behavior(folder, record, source, name=name, encoding=encoding)
    for path, text in sorted(merge.texts.items()):
        print(f"{'deleted' if text is None else 'merged'} {(folder / path).as_posix()}")
    if not merge.texts and not merge.conflicts:
        print(f"{folder.as_posix()}: no changes")
    for conflict in merge.conflicts:
        print(f"vicode: {(folder / conflict).as_posix()}", file=sys.stderr)
    return int(bool(merge.conflicts))


def _summary(imported: "ImportResult", folder: Path) -> str:
    project = imported.project
    remarks = len(imported.comments) + sum(len(each.comments) for each in imported.designs)
    parts = [
        _count(len(project.designs), "design"),
        _count(sum(len(design.states) for design in project.designs), "state"),
        _count(len(project.components), "hand-written component"),
        _count(len(project.agents), "agent"),
        _count(remarks, "comment"),
    ]
    return f"wrote {folder.as_posix()}: {', '.join(parts)}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
