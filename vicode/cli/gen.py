"""Generate code from designs."""

import argparse
import errno
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import describe_os_error, print_findings
from vicode.cli.project_loader import LoadedProject, load_projects
from vicode.findings import Finding, Severity, SourceLocation, get_rule
from vicode.output import FileDiff, FileStatus, apply_diffs, back_up_edited, compare_files, format_diff
from vicode.regions import has_header

if TYPE_CHECKING:
    from vicode.output import OutputFile


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("paths", metavar="PATH", nargs="+", help="design file, project folder, or folder of projects")
    parser.add_argument("--check", action="store_true", help="write nothing; report missing, changed, and stale files")
    parser.add_argument("--diff", action="store_true", help="write nothing; print a diff")
    parser.add_argument(
        "--out", metavar="DIR", help="output folder (default: as set in project.yaml, else generated/ next to it)"
    )
    parser.add_argument("--language", metavar="L", action="append", help="generate only this language; can be repeated")
    parser.add_argument(
        "--standalone", action="store_true", help="include a copy of the runtime, so that the code runs without vicode"
    )
    parser.add_argument("--force", action="store_true", help="overwrite edited files, keeping a copy as NAME.edited")


def run(args: argparse.Namespace) -> int:
    """Generate every project; return 1 if files were refused or, with --check or --diff, outdated."""
    from vicode.generators import GENERATORS

    unknown = sorted(set(args.language or ()) - set(GENERATORS))
    if unknown:
        print(f"vicode: unknown language {unknown[0]}; choose from {', '.join(GENERATORS)}", file=sys.stderr)
        return 2
    return max(_generate_or_report(opened, args) for opened in load_projects(args.paths))


def _generate_or_report(opened: LoadedProject, args: argparse.Namespace) -> int:
    """Generate one project; an OSError is reported so that the other projects are still generated."""
    try:
        return _generate(opened, args)
    except BrokenPipeError:
        raise
    except OSError as error:
        sys.stdout.flush()
        print(f"vicode: {describe_os_error(error)}", file=sys.stderr)
        return 2


def _generate(opened: LoadedProject, args: argparse.Namespace) -> int:
    errors = [finding for finding in opened.findings if finding.severity is Severity.ERROR]
    print_findings(errors, to_stderr=True)
    folder = _folder(opened, args.out)
    differences = _differences(opened, folder, args)
    if args.diff:
        print("".join(format_diff(difference) for difference in differences), end="")
    if args.check:
        print_findings(_outdated_findings(differences, folder))
    if args.diff or args.check:
        return int(bool(differences or errors))
    refused = _write(differences, folder, is_forced=args.force)
    return int(bool(refused or errors))


def _folder(opened: LoadedProject, out: str | None) -> Path:
    folder = Path(out) if out else opened.open_project.folder / opened.open_project.project.generated
    # Shorten paths such as `designs/forward/../../generated`.
    return Path(os.path.relpath(folder)) if not folder.is_absolute() else folder


def _differences(opened: LoadedProject, folder: Path, args: argparse.Namespace) -> tuple[FileDiff, ...]:
    from vicode.generators import list_outputs

    files = _files(opened, args)
    keep = list_outputs(opened.open_project.project, languages=args.language, standalone=args.standalone)
    compared = compare_files(files, folder, kept_paths=keep, is_generated=has_header)
    # The component name of an unreadable design is unknown, so no file is certainly stale.
    spared = {FileStatus.UNCHANGED, FileStatus.STALE} if opened.open_project.broken_files else {FileStatus.UNCHANGED}
    return tuple(difference for difference in compared if difference.status not in spared)


def _files(opened: LoadedProject, args: argparse.Namespace) -> "list[OutputFile]":
    """The files of all designs without errors, for each language."""
    from vicode.generators import GENERATORS, generate

    project = opened.open_project.project
    files: list[OutputFile] = []
    for language in GENERATORS:
        faulty = opened.components_with_errors(language)
        wanted = [name for name in opened.selected_designs if name not in faulty]
        if wanted and language in (args.language or project.languages):
            files += generate(
                project,
                components=wanted,
                exclude=faulty,
                languages=(language,),
                standalone=args.standalone,
                sources=opened.design_paths,
            )
    return files


def _write(differences: tuple[FileDiff, ...], folder: Path, *, is_forced: bool) -> int:
    """Write all files except those edited by hand, or all if forced; return the number of refused files."""
    from vicode.sync import find_hand_edits_by_file

    edits = find_hand_edits_by_file(differences, display_folder=folder.as_posix())
    if is_forced:
        for path in edits:
            print(f"backed up {back_up_edited(folder / path).as_posix()}")
        edits = {}
    print_findings((finding for findings in edits.values() for finding in findings), to_stderr=True)
    allowed = [difference for difference in differences if difference.path not in edits]
    for difference in allowed:
        _require_no_file_in_path(folder / difference.path)
        apply_diffs([difference], folder)
        verb = "deleted" if difference.status is FileStatus.STALE else "wrote"
        print(f"{verb} {(folder / difference.path).as_posix()}")
    return len(edits)


def _require_no_file_in_path(path: Path) -> None:
    """Raise an error that names the file in place of a folder; the error of the system names another path."""
    for parent in path.parents:
        if parent.exists() and not parent.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, "expected a folder, found a file", parent.as_posix())


def _outdated_findings(differences: tuple[FileDiff, ...], folder: Path) -> Iterator[Finding]:
    """Findings for outdated files; edited files yield their edits, because generating refuses them."""
    from vicode.sync import find_hand_edits_by_file

    edits = find_hand_edits_by_file(differences, display_folder=folder.as_posix())
    for difference in differences:
        yield from edits.get(difference.path) or (_outdated_finding(difference, folder),)


def _outdated_finding(difference: FileDiff, folder: Path) -> Finding:
    problem = {
        FileStatus.NEW: "missing: no such file",
        FileStatus.CHANGED: "changed: differs from the generated code",
        FileStatus.STALE: "stale: no design generates this file",
    }[difference.status]
    place = SourceLocation(file=(folder / difference.path).as_posix(), line=1, column=1)
    return Finding(rule=get_rule("G502"), message=problem, fix="run 'vicode gen'", location=place)
