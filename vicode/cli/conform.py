"""Run a design in every language on the same inputs and report the first difference."""

import argparse
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.root_selection import select_root

if TYPE_CHECKING:
    from vicode.conformance.inputs import ConformanceRun
    from vicode.model.project import Project
    from vicode.simulation.language_comparison import LanguageComparison

_MAX_ITERATIONS = 20_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("design", metavar="DESIGN", help="a design, or the folder of a project with one agent")
    add(
        "--inputs",
        metavar="TRACE",
        default="random",
        help="a trace recorded with --values, whose inputs and times are used (default: random)",
    )
    add("--seed", type=int, default=0, metavar="N", help="seed of random inputs (default: 0)")
    add("--iterations", type=options.count, default=500, metavar="N", help="number of iterations (default: 500)")


def run(args: argparse.Namespace) -> int:
    """Compare; return 1 if traces differ or code fails, 2 if there is nothing to compare."""
    from vicode.conformance.comparison import compare_languages

    selected = select_root(args.design, "", "compare")
    if isinstance(selected, int):
        return selected
    opened, component = selected
    inputs = _make_run(args, opened.open_project.project, component)
    with tempfile.TemporaryDirectory(prefix="vicode-conform-") as folder:
        comparison = compare_languages((inputs,), Path(folder), opened.open_project.folder.resolve())
    return _report(args, component, comparison)


def _make_run(args: argparse.Namespace, project: "Project", component: str) -> "ConformanceRun":
    from itertools import islice

    from vicode.conformance.random_inputs import random_run
    from vicode.conformance.recorded_inputs import recorded_run
    from vicode.simulation.trace import TraceError, open_trace

    if args.inputs == "random":
        return random_run(project, component, iterations=min(args.iterations, _MAX_ITERATIONS), seed=args.seed)
    try:
        iterations = open_trace(Path(args.inputs)).iterations()
        return recorded_run(project, component, islice(iterations, _MAX_ITERATIONS))
    except TraceError as error:
        raise OSError(f"{args.inputs}: {error}") from error


def _report(args: argparse.Namespace, component: str, comparison: "LanguageComparison") -> int:
    from vicode.conformance.report import describe
    from vicode.simulation.language_comparison import LANGUAGE_TITLES, verdict

    source = f"seed {args.seed}" if args.inputs == "random" else args.inputs
    print(f"{component}: {verdict(comparison)} ({source})")
    for absent in comparison.absent:
        print(f"{LANGUAGE_TITLES[absent.language]} is not compared: {absent.reason}")
    for failed in comparison.failed:
        print(f"{LANGUAGE_TITLES[failed.language]} fails: {failed.reason}")
    for difference in comparison.differences:
        print(describe(difference))
    if comparison.failed or comparison.differences:
        return 1
    if len(comparison.languages) < 2:
        print("vicode: there is nothing to compare", file=sys.stderr)
        return 2
    return 0
