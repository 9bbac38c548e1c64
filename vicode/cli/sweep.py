"""Run a design for several values and seeds, and compare the results."""

import argparse
import os
import re
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import as_completed
from contextlib import AbstractContextManager
from dataclasses import replace
from hashlib import sha256
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.root_selection import select_root
from vicode.services.project_loader import LoadedProject

if TYPE_CHECKING:
    from vicode.runs.sweep import Combination, Row, Submit, SweepRun
    from vicode.runs.sweep_page import Result

_TABLE, _PAGE = "runs.csv", "sweep.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("path", metavar="DESIGN", help="design of the root component, or folder of a project with one agent")
    set_help = "values of a parameter (Component.parameter) or a constant, as 0.2,0.3 or 0.2..0.6:5; may be repeated"
    add("--set", action="append", required=True, metavar="NAME=VALUES", help=set_help)
    add_run_arguments(parser)
    add("--seeds", type=options.count, default=20, metavar="N", help="seeds 1 to N (default: %(default)s)")
    add("--seconds", type=options.seconds, default=60.0, metavar="S", help="stop a run after S seconds (default: 60)")
    add("--until-done", action="store_true", help="stop a run when the root component is done")
    goal = parser.add_mutually_exclusive_group()
    goal.add_argument("--minimize", metavar="FIGURE", help="find the value with the lowest figure, such as time_s")
    goal.add_argument("--maximize", metavar="FIGURE", help="find the value with the highest figure")


def add_run_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of all commands that do many runs."""
    add = parser.add_argument
    add("--out", metavar="DIR", required=True, help="folder of the results; runs that it has are not done again")
    add("--again", action="store_true", help="remove the runs that the folder has")
    add("--profile", metavar="NAME", default="", help="use the implementations and the world of this profile")
    add("--jobs", type=options.count, metavar="N", help="number of runs at a time (default: one per processor core)")
    cluster_help = "do the runs on the Dask cluster of this scheduler, tcp://HOST:PORT (docs/sweeps.md)"
    add("--cluster", type=_address, metavar="ADDRESS", help=cluster_help)


def _address(text: str) -> str:
    if not re.fullmatch(r"((tcp|tls)://)?[^/\s]+:\d+", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no address of a scheduler; write tcp://HOST:PORT")
    return text


def run(args: argparse.Namespace) -> int:
    """Do the runs that the folder lacks, and write the table and the page; return 1 if a run has failed."""
    from vicode.runs.changed_values import ChangedValueError

    selected = select_simulated(args.path, args.profile, "sweep")
    if isinstance(selected, int):
        return selected
    try:
        return _sweep(*selected, args)
    except ChangedValueError as error:
        print(f"vicode: {error}", file=sys.stderr)
        return 2


def select_simulated(path: str, profile: str, verb: str) -> tuple[LoadedProject, str] | int:
    """The project and the root component, as `select_root`, of a design that runs in simulated time."""
    from vicode.services.run_preparation import find_topics, needs_bridge

    selected = select_root(path, profile, verb)
    if isinstance(selected, int):
        return selected
    project, component = selected[0].open_project.project, selected[1]
    if topics := find_topics(project, component):
        print(f"vicode: {topics[0]} is a topic, which needs real time; see --profile", file=sys.stderr)
        return 2
    if project.clock == options.WORLD or needs_bridge(project, component):
        print(f"vicode: a {verb} needs a simulated world that does not set the pace; see --profile", file=sys.stderr)
        return 2
    return selected


def _sweep(opened: LoadedProject, component: str, args: argparse.Namespace) -> int:
    from vicode.output import temporary_folder
    from vicode.runs.sweep import check_folder

    combinations = _combine(opened, component, args)
    out = Path(args.out)
    check_folder(out / "runs.jsonl", [out / _TABLE, out / _PAGE])
    out.mkdir(parents=True, exist_ok=True)
    origin = _describe_origin(opened, component, args)
    with temporary_folder("sweep") as code:
        runs = _prepare(opened, component, combinations, code, args)
        done = do_missing(runs, origin, code, opened.open_project.folder.resolve(), args)
    seeds = range(1, args.seeds + 1)
    return _report([(each, [done[run_key(each.values, seed)] for seed in seeds]) for each in combinations], args)


def do_missing(
    runs: "Sequence[SweepRun]", origin: "Row", code: Path, project: Path, args: argparse.Namespace
) -> "dict[object, Row]":
    """Do the runs that the folder of the results lacks; return the rows of all, by `run_key`."""
    from vicode.cli.experiment import ending_at_sigterm
    from vicode.runs.sweep import open_runs

    with ending_at_sigterm(), open_runs(Path(args.out, "runs.jsonl"), origin, is_new=args.again) as (rows, append):
        done = {run_key(row["values"], row["seed"]): row for row in rows if not row["error"]}
        waiting = [run for run in runs if run_key(run.values, run.seed) not in done]
        if not waiting:
            return done
        try:
            with _start(project, code, args) as submit:
                for row in _follow(submit, waiting):
                    append(row)
                    done[run_key(row["values"], row["seed"])] = row
        except KeyboardInterrupt:
            print("vicode: stopped; the same command continues", file=sys.stderr)
            raise
        return done


def run_key(values: "Row", seed: int) -> object:
    return frozenset(values.items()), seed


def _combine(opened: LoadedProject, component: str, args: argparse.Namespace) -> "list[Combination]":
    from vicode.runs.changed_values import ChangedValueError
    from vicode.runs.sweep import MAX_RUNS, combine, parse_values
    from vicode.runs.value_replay import concerns

    project, axes = opened.open_project.project, []
    design = project.design(component)
    assert design is not None
    for text in args.set:
        try:
            axes.append(parse_values(text, project))
        except ChangedValueError as error:
            raise ChangedValueError(f"--set {text}: {error}") from error
        if not concerns(project, design, axes[-1][0]):
            raise ChangedValueError(f"--set {text}: {component} does not use {axes[-1][0].component}")
    if (count := prod(map(len, axes)) * args.seeds) > MAX_RUNS:
        raise ChangedValueError(f"{count} runs are too many: a sweep has at most {MAX_RUNS}")
    return combine(axes, project)


def _describe_origin(opened: LoadedProject, component: str, args: argparse.Namespace) -> "Row":
    """What must stay the same when a sweep continues."""
    from vicode.model.design_hash import hash_design
    from vicode.runs.sweep import ORIGIN_KEY

    design = f"{component} {hash_design(opened.open_project.project, component)}"
    limits = {"--seconds": args.seconds, "--until-done": args.until_done}
    return {ORIGIN_KEY: 1, "design": design, "Python code": hash_code(opened), **limits}


def hash_code(opened: LoadedProject) -> str:
    """The hash of the Python files of a project, without generated ones."""
    from vicode.services.generation.project_output import output_folder

    folder, generated = opened.open_project.folder.resolve(), output_folder(opened).resolve()
    code = sha256()
    for file in sorted(folder.rglob("*.py")):
        if not file.is_relative_to(generated) and not any(part[0] == "." for part in file.relative_to(folder).parts):
            code.update(file.relative_to(folder).as_posix().encode() + file.read_bytes())
    return code.hexdigest()


def _prepare(
    opened: LoadedProject, component: str, combinations: "Sequence[Combination]", code: Path, args: argparse.Namespace
) -> "list[SweepRun]":
    """Generate the code of each combination; the runs of one seed follow each other."""
    from vicode.runs.changed_values import apply_values
    from vicode.runs.sweep import SweepRun
    from vicode.services.run_preparation import generate_for_run

    project, runs = opened.open_project.project, []
    limits = ["--stream", "--changes", "--seconds", str(args.seconds)] + ["--until-done"] * args.until_done
    limits += ["--world", project.world] if project.world else []
    for number, each in enumerate(combinations):
        changed = replace(opened.open_project, project=apply_values(project, each.changes))
        class_path = generate_for_run(changed, component, code / str(number))
        runs += [
            SweepRun(values=each.values, seed=seed, code=str(number), arguments=(class_path, *limits))
            for seed in range(1, args.seeds + 1)
        ]
    return sorted(runs, key=lambda run: run.seed)


def _start(project: Path, code: Path, args: argparse.Namespace) -> "AbstractContextManager[Submit]":
    from vicode.runs.sweep import local_runs

    if args.cluster is None:
        return local_runs(args.jobs or os.cpu_count() or 1, code, project)
    try:
        from vicode.runs.sweep_cluster import cluster_runs
    except ModuleNotFoundError as error:
        if error.name != "distributed":
            raise
        raise OSError("--cluster needs Dask; install it with: pip install 'vicode-fsm[cluster]'") from None
    return cluster_runs(args.cluster, code, project)


def _follow(submit: "Submit", runs: "Sequence[SweepRun]") -> "Iterator[Row]":
    """Yield the rows of the runs as they end."""
    from vicode.cli.progress import progress_bar

    with progress_bar() as advance:
        # Nothing else refers to a future, so that a cluster forgets a run once its row is here.
        for number, future in enumerate(as_completed([submit(run) for run in runs]), start=1):
            try:
                yield future.result()
            except Exception as error:
                raise OSError(f"a run was not done, the others are kept: {type(error).__name__}: {error}") from error
            advance("Runs", number, len(runs))


def _report(results: "Sequence[Result]", args: argparse.Namespace) -> int:
    """Write table and page, and print what was found."""
    from vicode.findings.nearest import did_you_mean
    from vicode.output import write_atomically
    from vicode.runs.sweep_page import MAXIMIZE, MINIMIZE, compare, format_table, list_figures, write_page

    out, wanted, best = Path(args.out), args.minimize or args.maximize, None
    rows = [row for _combination, own in results for row in own]
    if wanted:
        if wanted not in (known := list_figures(rows)):
            fix = did_you_mean(wanted, known, f"known are {', '.join(known[:12])}")
            print(f"vicode: no run has the figure '{wanted}'; {fix}", file=sys.stderr)
            return 2
        best = compare(results, wanted, MINIMIZE if args.minimize else MAXIMIZE)
    failed = [row for row in rows if row["error"]]
    print(f"{len(rows)} runs, {len(failed)} failed")
    for row in failed[:10]:
        print(f"  {row['values']}, seed {row['seed']}: {row['error']}")
    if len(results) > 1 and len({repr([{**row, "values": None} for row in own]) for _combination, own in results}) == 1:
        print("the values make no difference; that of a parameter has no effect where a state passes another one")
    write_atomically(out / _TABLE, format_table(rows))
    write_atomically(out / _PAGE, write_page(f"Sweep of {args.path}", results, best))
    print(*([best.describe_best()] if best else []), f"wrote {out / _TABLE} and {out / _PAGE}", sep="\n")
    return 1 if failed else 0
