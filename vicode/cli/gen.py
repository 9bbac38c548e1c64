"""Write the code of designs."""

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
    """Declare the arguments of `vicode gen`."""
    parser.add_argument("paths", metavar="PATH", nargs="+", help="a design, a project's folder, a folder of projects")
    parser.add_argument("--check", action="store_true", help="write nothing; name missing, changed and stale files")
    parser.add_argument("--diff", action="store_true", help="write nothing; show what would change")
    parser.add_argument("--out", metavar="DIR", help="write here (where project.yaml says, else generated/ beside it)")
    parser.add_argument("--language", metavar="L", action="append", help="only this language; may be repeated")
    parser.add_argument(
        "--standalone", action="store_true", help="copy the runtime beside the code: it needs no vicode"
    )
    parser.add_argument("--force", action="store_true", help="write over edited files too, keeping them as NAME.edited")


def run(args: argparse.Namespace) -> int:
    """Generate every project; 1 when something was refused, or with --check and --diff is not up to date."""
    from vicode.generators import GENERATORS

    unknown = sorted(set(args.language or ()) - set(GENERATORS))
    if unknown:
        print(f"vicode: cannot generate {unknown[0]}; there is {', '.join(GENERATORS)}", file=sys.stderr)
        return 2
    return max(_generate_or_report(opened, args) for opened in load_projects(args.paths))


def _generate_or_report(opened: LoadedProject, args: argparse.Namespace) -> int:
    """Generate one project; what the outside world has against it does not keep the others from being done."""
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
    # `designs/forward/../../generated` reads worse than where that is.
    return Path(os.path.relpath(folder)) if not folder.is_absolute() else folder


def _differences(opened: LoadedProject, folder: Path, args: argparse.Namespace) -> tuple[FileDiff, ...]:
    """All that is not as it should be in the folder."""
    from vicode.generators import list_outputs

    files = _files(opened, args)
    keep = list_outputs(opened.open_project.project, languages=args.language, standalone=args.standalone)
    compared = compare_files(files, folder, kept_paths=keep, is_generated=has_header)
    # While a design cannot be read nobody knows what it is called, so nothing is stale for sure.
    spared = {FileStatus.UNCHANGED, FileStatus.STALE} if opened.open_project.broken_files else {FileStatus.UNCHANGED}
    return tuple(difference for difference in compared if difference.status not in spared)


def _files(opened: LoadedProject, args: argparse.Namespace) -> "list[OutputFile]":
    """What is to be: of each language all designs that nothing stands in the way of."""
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
    """Write what loses nobody's work, or with force all; returns how many files were refused."""
    from vicode.sync import find_hand_edits_by_file

    edits = find_hand_edits_by_file(differences, display_folder=folder.as_posix())
    if is_forced:
        for path in edits:
            print(f"kept {back_up_edited(folder / path).as_posix()}")
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
    """Say which file stands where a folder is needed: the system names another path, or a reason hard to read."""
    for parent in path.parents:
        if parent.exists() and not parent.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, "this file is in the way of a folder", parent.as_posix())


def _outdated_findings(differences: tuple[FileDiff, ...], folder: Path) -> Iterator[Finding]:
    """What is out of date; of edited files the edit, since generating would refuse them."""
    from vicode.sync import find_hand_edits_by_file

    edits = find_hand_edits_by_file(differences, display_folder=folder.as_posix())
    for difference in differences:
        yield from edits.get(difference.path) or (_outdated_finding(difference, folder),)


def _outdated_finding(difference: FileDiff, folder: Path) -> Finding:
    problem = {
        FileStatus.NEW: "missing: no such file",
        FileStatus.CHANGED: "changed: not what the design gives",
        FileStatus.STALE: "stale: no design gives this file any more",
    }[difference.status]
    place = SourceLocation(file=(folder / difference.path).as_posix(), line=1, column=1)
    return Finding(rule=get_rule("G502"), message=problem, fix="run 'vicode gen'", location=place)
