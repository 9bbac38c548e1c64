"""Run a design in every language on the same inputs and report the first difference."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.coverage_report import report_coverage, report_mutants
from vicode.cli.root_selection import select_root
from vicode.output import temporary_folder

if TYPE_CHECKING:
    from vicode.conformance.inputs import ConformanceRun
    from vicode.conformance.result import LanguageComparison
    from vicode.model.project import Project
    from vicode.store import OpenProject

_MAX_ITERATIONS = 20_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("design", metavar="DESIGN", help="a design, or the folder of a project with one agent")
    add(
        "--inputs",
        metavar="TRACE",
        default="chosen",
        help="a trace recorded with --values, whose inputs and times are used (default: chosen inputs)",
    )
    add("--seed", type=int, default=0, metavar="N", help="seed of chosen inputs (default: 0)")
    add("--iterations", type=options.count, default=500, metavar="N", help="number of iterations (default: 500)")
    add(
        "--cxx",
        metavar='"COMMAND FLAGS"',
        default="",
        help="the C++ compiler of the robot with its flags (default: $CXX, g++ or clang++, with -O2)",
    )
    add(
        "--emulator",
        metavar='"COMMAND ARGUMENTS"',
        default="",
        help="a command that runs the program of another processor, such as qemu-aarch64",
    )
    add(
        "--mutants",
        action="store_true",
        help="instead, show which small faults of the design the inputs would not notice",
    )


def run(args: argparse.Namespace) -> int:
    """Compare; return 1 if traces differ or code fails, 2 if there is nothing to compare."""
    from vicode.conformance.comparison import compare_languages
    from vicode.conformance.cpp import ToolError, find_tools

    selected = select_root(args.design, "", "compare")
    if isinstance(selected, int):
        return selected
    opened, component = selected
    try:
        tools = find_tools(args.cxx, args.emulator)
    except ToolError as error:
        raise OSError(f"--cxx, --emulator: {error}") from error
    project = opened.open_project
    runs = _make_runs(args, project.project, component)
    if args.mutants:
        return _try_mutants(runs, component, project)
    with temporary_folder("conform") as folder:
        comparison = compare_languages(runs, folder, project.folder.resolve(), tools=tools)
    code = _report(args, component, comparison)
    if comparison.coverage is not None:
        report_coverage(comparison.coverage, project)
    return code


def _make_runs(args: argparse.Namespace, project: "Project", component: str) -> "tuple[ConformanceRun, ...]":
    from itertools import islice

    from vicode.conformance.comparison import choose_inputs
    from vicode.conformance.recorded_inputs import recorded_run
    from vicode.traces.reader import TraceError, open_trace

    if args.inputs == "chosen":
        return choose_inputs(project, component, iterations=min(args.iterations, _MAX_ITERATIONS), seed=args.seed)
    try:
        iterations = open_trace(Path(args.inputs)).iterations()
        return (recorded_run(project, component, islice(iterations, _MAX_ITERATIONS)),)
    except TraceError as error:
        raise OSError(f"{args.inputs}: {error}") from error


def _report(args: argparse.Namespace, component: str, comparison: "LanguageComparison") -> int:
    from vicode.conformance.report import describe
    from vicode.conformance.result import LANGUAGE_TITLES, verdict

    source = f"seed {args.seed}" if args.inputs == "chosen" else args.inputs
    print(f"{component}: {verdict(comparison)} ({source})")
    for absent in comparison.absent:
        print(f"{LANGUAGE_TITLES[absent.language]} is not compared: {absent.reason}")
    for limited in comparison.limited:
        print(f"{LANGUAGE_TITLES[limited.language]} is not compared {limited.reason}")
    for partial in comparison.partial:
        print(f"{LANGUAGE_TITLES[partial.language]} is compared in {partial.reason}")
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


def _try_mutants(runs: "tuple[ConformanceRun, ...]", component: str, project: "OpenProject") -> int:
    """Print which mutants of the design are not noticed; return 2 if it cannot be interpreted."""
    from vicode.conformance.design_mutants import try_mutants
    from vicode.semantics import NotInterpretableError

    try:
        report = try_mutants(runs)
    except NotInterpretableError as error:
        print(f"vicode: the reference interpreter cannot run {component}: {error}", file=sys.stderr)
        return 2
    report_mutants(report, component, project)
    return 0
