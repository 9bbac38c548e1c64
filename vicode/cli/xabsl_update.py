"""Writes the edits of imported designs back to the XABSL files."""

import argparse
import os
import sys
from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.cli.source_encoding import add_encoding_argument
from vicode.cli.xabsl_behavior import print_behavior_findings, print_encoding_doubts
from vicode.findings import count_findings
from vicode.services.xabsl_encoding import project_encoding

if TYPE_CHECKING:
    from vicode.services.imported_behavior.behavior_update import UpdateProblem
    from vicode.services.imported_behavior.import_record import ImportRecord
    from vicode.store import OpenProject
    from vicode.xabsl.patching.program_patch import FileTexts
    from vicode.xabsl.source_loader import ProgramSource
    from vicode.xabsl.source_text import ReadText


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("designs", metavar="DIR", type=Path, help="project folder that 'vicode import' created")
    parser.add_argument(
        "--into", metavar="AGENTS.xabsl", type=Path, help="XABSL file with the agents (default: the imported one)"
    )
    add_encoding_argument(parser)
    parser.add_argument("--check", action="store_true", help="write nothing; list the files that would change")
    parser.add_argument("--diff", action="store_true", help="write nothing; print the changes")


def run(args: argparse.Namespace) -> int:
    """Write the changed files; return 1 if an edit is not written, or with --check or --diff if files differ."""
    from vicode.services.imported_behavior.import_record import read_record
    from vicode.services.imported_behavior.updated_files import behavior_folder
    from vicode.store import open_project
    from vicode.transactions import complete_interrupted, is_interrupted
    from vicode.xabsl.behavior_loader import load_behavior
    from vicode.xabsl.compiler import compile_source
    from vicode.xabsl.source_text import read_source

    complete_interrupted(args.designs)
    opened = open_project(args.designs)
    record = read_record(opened.folder)
    agents = args.into or (record.agents if record else None)
    if agents is None:
        raise OSError(f"{args.designs} has no record of its import; specify the XABSL file with --into")
    agents = Path(os.path.relpath(agents))
    encoding = args.encoding or opened.project.xabsl_encoding or project_encoding(agents)
    source = load_behavior(agents, encoding)
    if is_interrupted(behavior_folder(source)):
        complete_interrupted(behavior_folder(source))
        source = load_behavior(agents, encoding)
    compiled = compile_source(source)
    print_encoding_doubts(source, agents)
    if compiled.program is None:
        print_behavior_findings([each for each in compiled.findings if each.severity == "error"], agents, encoding)
        print(f"nothing written: {count_findings(compiled.findings)}", file=sys.stderr)
        return 1
    if record is not None and not record.is_current(source):
        print(
            f"vicode: the behavior of {agents} has changed since the import; merge the changes first: "
            f"vicode import {agents} --out {args.designs}",
            file=sys.stderr,
        )
        return 1
    return _update(args, opened, record, source, partial(read_source, encoding=encoding))


def _update(
    args: argparse.Namespace,
    opened: "OpenProject",
    record: "ImportRecord | None",
    source: "ProgramSource",
    read: "ReadText",
) -> int:
    from vicode.services.imported_behavior.behavior_update import EditedProject, update_behavior
    from vicode.services.imported_behavior.updated_files import (
        find_faulty_designs,
        list_errors,
        write_update,
    )

    errors = list_errors(opened)
    print_findings(errors, to_stderr=True)
    left_out = find_faulty_designs(errors, opened)
    if left_out is None:
        print(f"nothing written: {count_findings(errors)}", file=sys.stderr)
        return 1
    paths, has_comments = opened.design_paths, record is not None and record.has_comments
    edited = EditedProject(
        project=opened.project,
        files=opened.texts if has_comments else {},
        paths=paths,
        known_paths=record.designs if record else {},
        left_out=left_out,
    )
    texts, problems = update_behavior(source, edited, read)
    if record is not None and not has_comments:
        print("vicode: an earlier version imported these designs: their comments are not written", file=sys.stderr)
    _print_problems(problems, opened)
    count = len(errors) + len(problems)
    if args.check or args.diff:
        return _show(texts, source, is_diff=args.diff) or int(bool(count))
    if count and not texts:
        print(f"nothing written: {count} error{'s' if count > 1 else ''}", file=sys.stderr)
        return 1
    designs = {**paths, **{name: edited.known_paths.get(name, paths[name]) for name in left_out & paths.keys()}}
    write_update(texts, source, opened.folder, designs, read, has_comments=has_comments or record is None)
    _print_written(texts)
    return int(bool(count))


def _print_problems(problems: "Iterable[UpdateProblem]", opened: "OpenProject") -> None:
    for problem in problems:
        where = ""
        if problem.component in opened.sources:
            path = ("states", problem.state) if problem.state else ("component",)
            location = opened.sources[problem.component].locate(path, of_key=True)
            place = f"{problem.line}" if problem.line else f"{location.line}:{location.column}"
            where = f"{location.file}:{place}: " if problem.component or problem.line else ""
        print(f"{where}error: {problem.message}", file=sys.stderr)


def _show(texts: "FileTexts", source: "ProgramSource", *, is_diff: bool) -> int:
    from vicode.output import FileDiff, FileStatus, format_diff

    for path, new in sorted(texts.items()):
        old = source.files[path].tokens.text if path in source.files else None
        shown = Path(os.path.relpath(path)).as_posix()
        status = FileStatus.STALE if new is None else FileStatus.NEW if old is None else FileStatus.CHANGED
        if is_diff:
            print(format_diff(FileDiff(path=shown, status=status, old=old, new=new)), end="")
        else:
            print(f"{shown}: would be {'deleted' if new is None else 'changed' if old is not None else 'written'}")
    return int(bool(texts))


def _print_written(texts: "FileTexts") -> None:
    for path in sorted(texts):
        print(f"{'deleted' if texts[path] is None else 'wrote'} {Path(os.path.relpath(path)).as_posix()}")
    if not texts:
        print("no changes")
