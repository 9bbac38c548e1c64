"""Let two versions of a design play matches against each other, and say which one is better."""

import argparse
import json
import shutil
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.sweep import add_run_arguments, do_missing, hash_code, run_key, select_simulated

if TYPE_CHECKING:
    from vicode.runs.sweep import Row, SweepRun

_TABLE, _PAGE = "runs.csv", "tournament.md"
_MAX_MATCHES = 4000
_VERSION_HELP = "a design, the folder of a project, or REVISION:PATH in git"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Version:
    """A version that is ready to run; `origin` must stay the same when a tournament continues."""

    class_path: str
    world: str
    origin: str


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("first", metavar="A", help=f"the first version: {_VERSION_HELP}; the matches are played in its world")
    add("second", metavar="B", help="the second version, likewise")
    add_run_arguments(parser)
    matches_help = "number of matches, two for each of the seeds 1 to N/2 (default: %(default)s)"
    add("--matches", type=_even, default=40, metavar="N", help=matches_help)
    add("--seconds", type=options.seconds, default=600.0, metavar="S", help="longest match (default: 600)")
    add("--json", action="store_true", help="print the result as JSON")


def _even(text: str) -> int:
    number = options.count(text)
    if number % 2 or not 0 < number <= _MAX_MATCHES:
        raise argparse.ArgumentTypeError(f"write an even number up to {_MAX_MATCHES}, as sides are exchanged")
    return number


def run(args: argparse.Namespace) -> int:
    """Play the matches that the folder lacks, and write the table and the page; return 1 if a match has failed."""
    from vicode.output import temporary_folder

    with temporary_folder("tournament") as code:
        versions = []
        for name, text in (("a", args.first), ("b", args.second)):
            version = _prepare(text, code / name, args.profile)
            if isinstance(version, int):
                return version
            versions.append(version)
        return _play(versions, code, args)


def _prepare(text: str, folder: Path, profile: str) -> _Version | int:
    """Copy a version to `folder`/project, and generate its code in `folder`/python."""
    from vicode.model.design_hash import hash_design
    from vicode.services.design_version import find_version
    from vicode.services.run_preparation import generate_for_run

    copy = folder / "project"
    selected = select_simulated(str(find_version(text, copy)), profile, "play")
    if isinstance(selected, int):
        return selected
    opened, component = selected
    project = opened.open_project.project
    if not project.world:
        raise OSError(f"{text} has no world in which matches can be played; see docs/team.md")
    if not copy.exists():
        shutil.copytree(opened.open_project.folder, copy, ignore=shutil.ignore_patterns(".*", "__pycache__"))
    origin = f"{component} {hash_design(project, component)} {hash_code(opened)}"
    class_path = generate_for_run(opened.open_project, component, folder)
    return _Version(class_path=class_path, world=project.world, origin=origin)


def _play(versions: list[_Version], code: Path, args: argparse.Namespace) -> int:
    from vicode.runs.sweep import ORIGIN_KEY, check_folder

    out = Path(args.out)
    check_folder(out / "runs.jsonl", [out / _TABLE, out / _PAGE])
    out.mkdir(parents=True, exist_ok=True)
    first, second = (version.origin for version in versions)
    origin = {ORIGIN_KEY: 1, "version A": first, "version B": second, "--seconds": args.seconds}
    matches = _list_matches(versions, args)
    done = do_missing(matches, origin, code, code / "a" / "project", args)
    return _report([done[run_key(match.values, match.seed)] for match in matches], args)


def _list_matches(versions: list[_Version], args: argparse.Namespace) -> "list[SweepRun]":
    from vicode.runs.sweep import SweepRun
    from vicode.runs.tournament import SIDES

    classes = [version.class_path for version in versions]
    arguments = (*classes, "--world", versions[0].world, "--seconds", str(args.seconds))
    match = partial(SweepRun, module="vicode.bica.match", code="a", second=("b/python", "b/project"))
    return [
        match(values={"home": side}, seed=seed, arguments=(*arguments, *["--exchange"] * (side == "B")))
        for seed in range(1, args.matches // 2 + 1)
        for side in SIDES
    ]


def _report(rows: "list[Row]", args: argparse.Namespace) -> int:
    """Write table and page, and print the result."""
    from vicode.output import write_atomically
    from vicode.runs.sweep_page import format_table
    from vicode.runs.tournament import evaluate, format_page

    out, result, versions = Path(args.out), evaluate(rows), {"A": args.first, "B": args.second}
    failed = [row for row in rows if row["error"]]
    write_atomically(out / _TABLE, format_table(rows))
    write_atomically(out / _PAGE, format_page(versions, rows, result))
    if args.json:
        unknown = {} if result.matches else {"difference": None, "p": None}
        errors = [{"home": row["values"]["home"], "seed": row["seed"], "error": row["error"]} for row in failed]
        print(json.dumps({**versions, **asdict(result), **unknown, "failed": len(failed), "errors": errors}))
    else:
        print(f"{len(rows)} matches, {len(failed)} failed")
        for row in failed[:10]:
            print(f"  {row['values']['home']} at home, seed {row['seed']}: {row['error']}")
        print(*result.table(), result, f"wrote {out / _TABLE} and {out / _PAGE}", sep="\n")
    return 1 if failed else 0
