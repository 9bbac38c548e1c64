"""Compare two versions of designs in words: files, folders, or git revisions."""

import argparse
import json
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.findings import escape_text

if TYPE_CHECKING:
    from vicode.services.design_diff.file_differences import FileDifference
    from vicode.services.design_diff.file_pairs import FileVersion, VersionPair

_EXTERNAL_ARGUMENTS = 7


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "items",
        metavar="A B | [REVISION [REVISION]] [PATH]",
        nargs="*",
        help="two files or folders; or git revisions (default: HEAD and the work tree) and paths",
    )
    parser.add_argument("--json", action="store_true", help="print the changes as JSON")
    parser.add_argument("--svg", metavar="FILE", help="write the diagram of one design with marked changes")
    parser.add_argument("--dark", action="store_true", help="use dark colors in the SVG")
    parser.add_argument("--html", metavar="FILE", help="write a page with words and diagrams")
    # git calls a diff driver with: path, old file, old hash, old mode, new file, new hash, new mode.
    parser.add_argument("--external", action="store_true", help=argparse.SUPPRESS)
    parser.epilog = "Exit codes: 0 no differences, 1 differences, 2 the command could not run."


def run(args: argparse.Namespace) -> int:
    """Print the differences; return 1 if there are any."""
    from vicode.services.design_diff.file_differences import compare_pair
    from vicode.services.design_diff.file_pairs import find_pairs

    if args.external:
        return _run_external(args.items)
    differences = [compare_pair(pair) for pair in find_pairs(args.items) if _is_relevant(pair)]
    if args.json:
        print(json.dumps({"files": [difference.to_json() for difference in differences]}, ensure_ascii=False, indent=2))
    else:
        _print_lines(line for difference in differences for line in difference.lines())
    _write_pictures(differences, args)
    findings = [finding for difference in differences for finding in difference.errors]
    print_findings(findings, to_stderr=True)
    return 2 if findings else int(any(difference.is_different for difference in differences))


def _write_pictures(differences: "list[FileDifference]", args: argparse.Namespace) -> None:
    if not (args.svg or args.html):
        return
    from vicode.output import write_atomically
    from vicode.services.design_diff.pictures import format_page, format_svg

    if args.svg:
        write_atomically(Path(args.svg), format_svg(differences, dark=args.dark))
    if args.html:
        write_atomically(Path(args.html), format_page(differences))


def _run_external(items: list[str]) -> int:
    """Compare as a diff driver of git, which expects exit code 0."""
    from vicode.services.design_diff.file_differences import compare_pair
    from vicode.services.design_diff.file_pairs import FileVersion, VersionPair

    if len(items) < _EXTERNAL_ARGUMENTS:
        print("".join(f"{item}: not merged\n" for item in items[:1]), end="")
        return 0
    path, old, _hash, _mode, new = items[:5]
    versions = [
        None if file == "/dev/null" else FileVersion(name=path, content=Path(file).read_bytes()) for file in (old, new)
    ]
    difference = compare_pair(VersionPair(old=versions[0], new=versions[1]))
    if difference.errors:
        _print_lines(_plain_diff(path, versions[0], versions[1]))
        return 0
    _print_lines(difference.lines())
    return 0


def _print_lines(lines: Iterable[str]) -> None:
    """Print texts of designs, which may come from others, without commands to the terminal."""
    print("".join(re.sub(r"[^\n\t]+", lambda part: escape_text(part[0]), f"{line}\n") for line in lines), end="")


def _plain_diff(path: str, old: "FileVersion | None", new: "FileVersion | None") -> Iterator[str]:
    """The lines that differ, for a file that is no design."""
    from difflib import unified_diff

    texts = [(b"" if version is None else version.content).decode(errors="replace") for version in (old, new)]
    return unified_diff(texts[0].splitlines(), texts[1].splitlines(), f"a/{path}", f"b/{path}", lineterm="")


def _is_relevant(pair: "VersionPair") -> bool:
    """Whether a file is a design or project file, or was named."""
    from vicode.store import looks_like_design

    versions = [version for version in (pair.old, pair.new) if version is not None]
    return pair.is_explicit or any(looks_like_design(version.content) for version in versions)
