"""Write the code of designs."""

import argparse
import errno
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.opening import Opened, open_paths
from vicode.cli.printing import describe_os_error, print_findings
from vicode.findings import Finding, Place, Severity, rule
from vicode.output import Difference, Status, apply, compare, diff, set_aside
from vicode.regions import is_sealed

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
    return max(_generate_or_tell(opened, args) for opened in open_paths(args.paths))


def _generate_or_tell(opened: Opened, args: argparse.Namespace) -> int:
    """Generate one project; what the outside world has against it does not keep the others from being done."""
    try:
        return _generate(opened, args)
    except BrokenPipeError:
        raise
    except OSError as error:
        sys.stdout.flush()
        print(f"vicode: {describe_os_error(error)}", file=sys.stderr)
        return 2


def _generate(opened: Opened, args: argparse.Namespace) -> int:
    errors = [finding for finding in opened.findings if finding.severity is Severity.ERROR]
    print_findings(errors, to_stderr=True)
    folder = _folder(opened, args.out)
    differences = _differences(opened, folder, args)
    if args.diff:
        print("".join(diff(difference) for difference in differences), end="")
    if args.check:
        print_findings(_not_fresh(differences, folder))
    if args.diff or args.check:
        return int(bool(differences or errors))
    refused = _write(differences, folder, is_forced=args.force)
    return int(bool(refused or errors))


def _folder(opened: Opened, out: str | None) -> Path:
    folder = Path(out) if out else opened.opened.folder / opened.opened.project.generated
    # `designs/forward/../../generated` reads worse than where that is.
    return Path(os.path.relpath(folder)) if not folder.is_absolute() else folder


def _differences(opened: Opened, folder: Path, args: argparse.Namespace) -> tuple[Difference, ...]:
    """All that is not as it should be in the folder."""
    from vicode.generators import list_outputs

    files = _files(opened, args)
    keep = list_outputs(opened.opened.project, languages=args.language, standalone=args.standalone)
    compared = compare(files, folder, keep=keep, is_ours=is_sealed)
    # While a design cannot be read nobody knows what it is called, so nothing is stale for sure.
    spared = {Status.UNCHANGED, Status.STALE} if opened.opened.broken else {Status.UNCHANGED}
    return tuple(difference for difference in compared if difference.status not in spared)


def _files(opened: Opened, args: argparse.Namespace) -> "list[OutputFile]":
    """What is to be: of each language all designs that nothing stands in the way of."""
    from vicode.generators import GENERATORS, generate

    project = opened.opened.project
    files: list[OutputFile] = []
    for language in GENERATORS:
        faulty = opened.faulty_in(language)
        wanted = [name for name in opened.meant if name not in faulty]
        if wanted and language in (args.language or project.languages):
            files += generate(
                project,
                components=wanted,
                leave_out=faulty,
                languages=(language,),
                standalone=args.standalone,
                sources=opened.sources,
            )
    return files


def _write(differences: tuple[Difference, ...], folder: Path, *, is_forced: bool) -> int:
    """Write what loses nobody's work, or with force all; returns how many files were refused."""
    from vicode.sync import find_edits_by_file

    edits = find_edits_by_file(differences, shown=folder.as_posix())
    if is_forced:
        for path in edits:
            print(f"kept {set_aside(folder / path).as_posix()}")
        edits = {}
    print_findings((finding for findings in edits.values() for finding in findings), to_stderr=True)
    allowed = [difference for difference in differences if difference.path not in edits]
    for difference in allowed:
        _refuse_file_in_the_way(folder / difference.path)
        apply([difference], folder)
        verb = "deleted" if difference.status is Status.STALE else "wrote"
        print(f"{verb} {(folder / difference.path).as_posix()}")
    return len(edits)


def _refuse_file_in_the_way(path: Path) -> None:
    """Say which file stands where a folder is needed: the system names another path, or a reason hard to read."""
    for parent in path.parents:
        if parent.exists() and not parent.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, "this file is in the way of a folder", parent.as_posix())


def _not_fresh(differences: tuple[Difference, ...], folder: Path) -> Iterator[Finding]:
    """What is out of date; of edited files the edit, since generating would refuse them."""
    from vicode.sync import find_edits_by_file

    edits = find_edits_by_file(differences, shown=folder.as_posix())
    for difference in differences:
        yield from edits.get(difference.path) or (_stale(difference, folder),)


def _stale(difference: Difference, folder: Path) -> Finding:
    problem = {
        Status.NEW: "missing: no such file",
        Status.CHANGED: "changed: not what the design gives",
        Status.STALE: "stale: no design gives this file any more",
    }[difference.status]
    place = Place(file=(folder / difference.path).as_posix(), line=1, column=1)
    return Finding(rule=rule("G502"), message=problem, mend="run 'vicode gen'", place=place)
