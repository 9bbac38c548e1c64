"""Writes the edits of imported designs back to the XABSL files."""

import argparse
import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import count_findings, print_findings
from vicode.cli.xabsl_behavior import load_behavior, print_behavior_findings

if TYPE_CHECKING:
    from vicode.cli.behavior_update import UpdateProblem
    from vicode.findings import Finding
    from vicode.store import OpenProject
    from vicode.xabsl.patching.program_patch import FileTexts
    from vicode.xabsl.source_loader import ProgramSource


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("designs", metavar="DIR", type=Path, help="project folder that 'vicode import' created")
    parser.add_argument(
        "--into", metavar="AGENTS.xabsl", type=Path, help="XABSL file with the agents (default: the imported one)"
    )
    parser.add_argument("--check", action="store_true", help="write nothing; list the files that would change")
    parser.add_argument("--diff", action="store_true", help="write nothing; print the changes")


def run(args: argparse.Namespace) -> int:
    """Write the changed files; return 1 if an edit cannot be written, or with --check or --diff if files differ."""
    from vicode.cli.behavior_update import update_behavior
    from vicode.cli.import_record import read_record
    from vicode.store import open_project
    from vicode.transactions import complete_interrupted, is_interrupted
    from vicode.xabsl.compiler import compile_source
    from vicode.xabsl.source_loader import read_text

    complete_interrupted(args.designs)
    opened = open_project(args.designs)
    record = read_record(opened.folder)
    agents = args.into or (record.agents if record else None)
    if agents is None:
        raise OSError(f"{args.designs} has no record of its import; specify the XABSL file with --into")
    agents = Path(os.path.relpath(agents))
    source = load_behavior(agents)
    if is_interrupted(_root(source)):
        complete_interrupted(_root(source))
        source = load_behavior(agents)
    errors = _errors(opened)
    compiled = compile_source(source)
    print_findings(errors, to_stderr=True)
    if compiled.program is None:
        print_behavior_findings([each for each in compiled.findings if each.severity == "error"], agents)
    if errors or compiled.program is None:
        print(
            f"nothing written: {count_findings([*errors, *(compiled.findings if not errors else ())])}", file=sys.stderr
        )
        return 1
    if record is not None and not record.is_current(source):
        print(
            f"vicode: the behavior of {agents} has changed since the import; merge the changes first: "
            f"vicode import {agents} --out {args.designs}",
            file=sys.stderr,
        )
        return 1
    texts, problems = update_behavior(source, opened.project, _folders(opened), read_text)
    if problems:
        _print_problems(problems, opened)
        return 1
    if args.check or args.diff:
        return _show(texts, source, is_diff=args.diff)
    _write(texts, source, opened.folder)
    return 0


def _errors(opened: "OpenProject") -> "list[Finding]":
    """The errors of designs that prevent generating XABSL."""
    from vicode.check import check_project
    from vicode.store import locate_findings

    project = replace(opened.project, languages=("xabsl",))
    findings = locate_findings([*opened.findings, *check_project(project)], opened)
    return [each for each in findings if each.severity == "error"]


def _folders(opened: "OpenProject") -> dict[str, str]:
    """The folder of each design, relative to the project."""
    folder = opened.folder.resolve()
    parents = {name: file.resolve().parent for name, file in opened.files.items() if name}
    return {
        name: parent.relative_to(folder).as_posix()
        for name, parent in parents.items()
        if parent.is_relative_to(folder) and parent != folder
    }


def _print_problems(problems: "Iterable[UpdateProblem]", opened: "OpenProject") -> None:
    count = 0
    for problem in problems:
        where = ""
        if problem.component in opened.sources:
            path = ("states", problem.state) if problem.state else ("component",)
            location = opened.sources[problem.component].locate(path, of_key=True)
            where = f"{location.file}:{location.line}:{location.column}: "
        print(f"{where}error: {problem.message}", file=sys.stderr)
        count += 1
    print(f"nothing written: {count} error{'s' if count > 1 else ''}", file=sys.stderr)


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


def _write(texts: "FileTexts", source: "ProgramSource", folder: Path) -> None:
    """Write all files or none, then the record of the import."""
    from vicode.cli.import_record import RECORD_FILE, format_record
    from vicode.output import write_atomically
    from vicode.transactions import replace_files
    from vicode.xabsl.source_loader import load_source

    if texts:
        contents = _encoded(texts, source)
        root = _root(source)
        replace_files(root, {path.relative_to(root).as_posix(): content for path, content in contents.items()})
    record = folder / RECORD_FILE
    text = format_record(folder, load_source(source.main))
    if not record.exists() or record.read_text("utf-8") != text:
        write_atomically(record, text)
    for path in sorted(texts):
        print(f"{'deleted' if texts[path] is None else 'wrote'} {Path(os.path.relpath(path)).as_posix()}")
    if not texts:
        print("no changes")


def _root(source: "ProgramSource") -> Path:
    """The folder that contains all files of a behavior."""
    return Path(os.path.commonpath([path.parent for path in source.files]))


def _encoded(texts: "FileTexts", source: "ProgramSource") -> Mapping[Path, bytes | None]:
    """Encode each text like its file, a new one like the main file.

    Raises:
        OSError: A file changed since it was read, or its encoding does not have a character.
    """
    from vicode.xabsl.source_loader import decode_text, encode_text

    encoded: dict[Path, bytes | None] = {}
    for path, text in texts.items():
        old = (path if path in source.files else source.main).read_bytes()
        if path in source.files and decode_text(old) != source.files[path].tokens.text:
            raise OSError(f"{path} was changed at the same time; run the command again")
        try:
            encoded[path] = None if text is None else encode_text(text, old)
        except UnicodeEncodeError as error:
            character = error.object[error.start]
            raise OSError(f"{path} is in Windows-1252, which does not have '{character}'; replace it") from error
    return encoded
