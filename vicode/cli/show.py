"""Show the design that ran: find it in git by the hash in a trace."""

import argparse
import json
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.output import resolve_below, write_atomically

if TYPE_CHECKING:
    from vicode.services.design_diff.revision_search import FoundDesign

_HASH = re.compile(r"[0-9a-f]{6,12}\Z")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("hash", metavar="HASH|TRACE", help="hash of a design, at least 6 digits, or a trace with it")
    parser.add_argument(
        "path", metavar="PATH", nargs="?", default=".", help="folder to search (default: the current folder)"
    )
    parser.add_argument(
        "-o", "--out", metavar="OUT", help="write the design to a .yaml file, or its project to a folder"
    )


def run(args: argparse.Namespace) -> int:
    """Print or write the design; return 1 if no revision has it."""
    from vicode.services.design_diff.revision_search import find_design

    wanted = _read_trace(Path(args.hash)) if Path(args.hash).is_file() else args.hash.lower()
    if not _HASH.match(wanted):
        raise OSError(f"'{args.hash}' is neither a file nor a hash of 6 to 12 hexadecimal digits")
    found = find_design(Path(args.path), wanted)
    if found is None:
        print(f"vicode: no revision has a design with the hash {wanted} in {args.path}", file=sys.stderr)
        return 1
    print(_describe(found), file=sys.stderr)
    if args.out is None:
        print(found.texts[found.path], end="")
    else:
        _write(found, Path(args.out))
    return 0


def _read_trace(file: Path) -> str:
    with file.open(encoding="utf-8", errors="replace") as stream:
        line = stream.readline(10_000)
    try:
        header = json.loads(line)
    except ValueError:
        header = None
    if not isinstance(header, dict) or not isinstance(header.get("design"), str):
        raise OSError(f"{file} is not a trace with the hash of a design; 'vicode run --trace FILE' records one")
    return str(header["design"])


def _describe(found: "FoundDesign") -> str:
    if found.commit is None:
        return f"{found.component}, {found.path} in the work tree, not committed"
    commit = found.commit
    place = f"{found.path} in {commit.revision[:12]}"
    return f"{found.component}, {place}, {commit.date[:10]}, {commit.author}: {commit.subject}"


def _write(found: "FoundDesign", out: Path) -> None:
    if out.suffix in (".yaml", ".yml") and not out.is_dir():
        write_atomically(out, found.texts[found.path])
        print(f"wrote {out.as_posix()}")
        return
    top = _common_folder(list(found.texts))
    for path, text in found.texts.items():
        file = resolve_below(out, Path(path).relative_to(top))
        file.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(file, text)
        print(f"wrote {(out / Path(path).relative_to(top)).as_posix()}")


def _common_folder(paths: list[str]) -> Path:
    """The folder that contains all paths."""
    parents = [set(Path(path).parents) for path in paths]
    return max(set.intersection(*parents), key=lambda folder: len(folder.parts))
