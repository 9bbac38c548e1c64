"""Let two versions of a design play matches against each other, and say which one is better."""

import argparse
import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.sweep import add_run_arguments, continue_runs, do_missing, hash_code, run_key, select_simulated
from vicode.services.project_loader import LoadedProject

if TYPE_CHECKING:
    from vicode.runs.sweep import Row, SweepRun

_TABLE, _PAGE = "runs.csv", "tournament.md"
_MAX_MATCHES = 4000
_VERSION_HELP = "design or project folder, or REVISION:PATH in git"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Version:
    """A version with its copy: the folder `python` has the generated code, `project` the files of the project."""

    opened: LoadedProject
    component: str
    class_path: str
    folder: Path

    def describe(self) -> str:
        """What must stay the same when a tournament continues."""
        from vicode.model.design_hash import hash_design

        design = hash_design(self.opened.open_project.project, self.component)
        return f"{self.component} {design} {hash_code(self.opened)}"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("first", metavar="A", help=f"first version: {_VERSION_HELP}; the matches are played in its world")
    add("second", metavar="B", help=f"second version: {_VERSION_HELP}")
    add_run_arguments(parser)
    matches_help = "number of matches, two for each of the seeds 1 to N/2 (default: %(default)s)"
    add("--matches", type=_even, default=40, metavar="N", help=matches_help)
    add("--seconds", type=options.seconds, default=600.0, metavar="S", help="stop a match after S seconds (default: 600)")
    add("--json", action="store_true", help="print the result as JSON")
    parser.epilog = "Exit codes: 0 all matches were played, 1 a match has failed, 2 the command could not run."


def _even(text: str) -> int:
    number = options.count(text)
    if number % 2 or number > _MAX_MATCHES:
        raise argparse.ArgumentTypeError(f"{number} must be even, as sides are exchanged, and at most {_MAX_MATCHES}")
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
        if not (world := versions[0].opened.open_project.project.world):
            raise OSError(f"{args.first} has no world, in which matches could be played (docs/team.md)")
        return continue_runs(lambda: _play(versions, world, code, args))


def _prepare(text: str, folder: Path, profile: str) -> _Version | int:
    from vicode.services.design_version import find_version
    from vicode.services.run_preparation import generate_for_run

    project = folder / "project"
    selected = select_simulated(str(find_version(text, project)), profile, "tournament")
    if isinstance(selected, int):
        return selected
    opened, component = selected
    if not project.exists():
        shutil.copytree(opened.open_project.folder, project, ignore=shutil.ignore_patterns(".*", "__pycache__"))
    class_path = generate_for_run(opened.open_project, component, folder)
    return _Version(opened=opened, component=component, class_path=class_path, folder=folder)


def _play(versions: list[_Version], world: str, code: Path, args: argparse.Namespace) -> int:
    from vicode.runs.sweep import ORIGIN_KEY, check_folder
    from vicode.runs.tournament import SIDES

    out = Path(args.out)
    check_folder(out / "runs.jsonl", [out / _TABLE, out / _PAGE])
    out.mkdir(parents=True, exist_ok=True)
    origin = {ORIGIN_KEY: 1, "--seconds": args.seconds}
    origin |= {f"version {side}": version.describe() for side, version in zip(SIDES, versions, strict=True)}
    runs = _list_matches(versions, world, args)
    done = do_missing(runs, origin, code, code / "a" / "project", args)
    return _report([done[run_key(run.values, run.seed)] for run in runs], args)


def _list_matches(versions: list[_Version], world: str, args: argparse.Namespace) -> "list[SweepRun]":
    from vicode.runs.sweep import SweepRun
    from vicode.runs.tournament import SIDES

    arguments = (*(each.class_path for each in versions), "--world", world, "--seconds", str(args.seconds))
    return [
        SweepRun(
            values={"home": side},
            seed=seed,
            code="a",
            second=("b/python", "b/project"),
            module="vicode.bica.match",
            arguments=arguments if side == "A" else (*arguments, "--exchange"),
        )
        for seed in range(1, args.matches // 2 + 1)
        for side in SIDES
    ]


def _report(rows: "list[Row]", args: argparse.Namespace) -> int:
    """Write table and page, and print the result."""
    from vicode.output import write_atomically
    from vicode.runs.sweep_page import format_table
    from vicode.runs.tournament import evaluate, format_page, format_result

    out, result = Path(args.out), evaluate(rows)
    failed = [row for row in rows if row["error"]]
    versions = {"A": args.first, "B": args.second}
    write_atomically(out / _TABLE, format_table(rows))
    write_atomically(out / _PAGE, format_page(versions, args.seconds, rows, result))
    if args.json:
        print(json.dumps({**versions, **result.as_plain(), "failed": len(failed), "rows": rows}))
        return 1 if failed else 0
    print(f"{len(rows)} matches, {len(failed)} failed")
    for row in failed[:10]:
        print(f"  {row['values']['home']} at home, seed {row['seed']}: {row['error']}")
    print(*format_result(result), result, f"wrote {out / _TABLE} and {out / _PAGE}", sep="\n")
    return 1 if failed else 0
