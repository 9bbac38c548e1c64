"""Run the recorded inputs of a trace through the current design and report the first state that differs."""

import argparse
import asyncio
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.console import print_findings
from vicode.cli.project_loader import LoadedProject, load_projects
from vicode.cli.root_selection import find_unsynced_edits

if TYPE_CHECKING:
    from collections.abc import Iterator

    from vicode.model.design import Design
    from vicode.runs.replay import ReplayResult
    from vicode.simulation import IterationResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("trace", metavar="TRACE", help="a trace recorded with --values, or the name of a robot's record")
    add("--design", metavar="PATH", default=".", help="design or project folder (default: the current folder)")
    add(
        "--tolerance",
        type=options.seconds,
        default=0.0,
        metavar="S",
        help="how long states may differ, in seconds (default: 0)",
    )
    add("--allow-missing", action="store_true", help="use initial values for outputs that the trace lacks")


def run(args: argparse.Namespace) -> int:
    """Replay; return 1 if the states differ, 2 if the trace cannot be replayed."""
    from vicode.generators import UnsoundDesignError
    from vicode.runs import NotReadyError
    from vicode.runs.client import RunFailedError
    from vicode.runs.replay import MissingValuesError
    from vicode.simulation.trace import TraceError, open_trace

    try:
        trace = open_trace(Path(args.trace))
        iterations = trace.iterations()
        first = next(iterations)
        opened, design = _find_design(args.design, str(first.tree[0]["component"]))
        if opened.errors_for("python"):
            print_findings(opened.errors_for("python"), to_stderr=True)
            return 2
        edits = find_unsynced_edits(opened, design.component)
        if edits:
            print_findings(edits, to_stderr=True)
            return 2
        result = _replay(args, opened, design, _chain(first, iterations))
    except TraceError as error:
        raise OSError(f"{args.trace}: {error}") from error
    except (MissingValuesError, NotReadyError, UnsoundDesignError, RunFailedError) as error:
        raise OSError(f"cannot replay {args.trace}: {error}") from error
    return _report(result, opened, design)


def _find_design(path: str, component: str) -> "tuple[LoadedProject, Design]":
    """The design of the root component of a trace.

    Raises:
        OSError: There is none.
    """
    for opened in load_projects([path]):
        design = opened.open_project.project.design(component)
        if design is not None and component in opened.selected_designs:
            return opened, design
    raise OSError(f"{path} has no design of {component}, the root component of the trace; give it with --design")


def _replay(
    args: argparse.Namespace, opened: LoadedProject, design: "Design", iterations: "Iterator[IterationResult]"
) -> "ReplayResult":
    from vicode.runs import RunConfig, prepare_run, used_components
    from vicode.runs.replay import replay_trace

    project, folder = opened.open_project.project, opened.open_project.folder.resolve()
    prepared = prepare_run(project, design, RunConfig(), opened.design_paths, folder)
    names = (design.component, *used_components(project, design))
    return asyncio.run(
        replay_trace(
            prepared,
            folder,
            iterations,
            components=frozenset(name for name in names if project.design(name) is not None),
            tolerance_ns=round(args.tolerance * 1e9),
            allows_missing=args.allow_missing,
        )
    )


def _report(result: "ReplayResult", opened: LoadedProject, design: "Design") -> int:
    from vicode.runs.replay_report import describe_difference

    if result.difference is None:
        print(f"{design.component}: same states in {result.iterations} iterations, {result.time_ns / 1e9:.2f} s")
        return 0
    for line in describe_difference(opened.open_project.project, result.difference):
        print(line)
    return 1


def _chain(first: "IterationResult", rest: "Iterator[IterationResult]") -> "Iterator[IterationResult]":
    yield first
    yield from rest
