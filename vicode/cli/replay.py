"""Run the recorded inputs of a trace through the current design and report the first state that differs.

With --set, report what another value of a parameter or constant changes.
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.console import print_findings
from vicode.services.project_loader import LoadedProject

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
    add(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="list what changes with this value of a parameter (Component.parameter) or a constant; may be repeated",
    )
    add("--allow-missing", action="store_true", help="use initial values for outputs that the trace lacks")


def run(args: argparse.Namespace) -> int:
    """Replay; return 1 if the states differ, 2 if the trace cannot be replayed."""
    from vicode.generators import UnsoundDesignError
    from vicode.runs import NotReadyError
    from vicode.runs.client import RunFailedError
    from vicode.runs.recorded_inputs import MissingValuesError
    from vicode.services.root_component import find_unsynced_edits
    from vicode.services.trace_replay import find_design, replay_design
    from vicode.traces.reader import TraceError, open_trace

    if args.set and args.tolerance:
        raise OSError("--tolerance has no effect with --set; leave it out")
    try:
        trace = open_trace(Path(args.trace))
        iterations = trace.iterations()
        first = next(iterations)
        opened, design = find_design(args.design, str(first.tree[0]["component"]))
        if opened.errors_for("python"):
            print_findings(opened.errors_for("python"), to_stderr=True)
            return 2
        edits = find_unsynced_edits(opened, design.component)
        if edits:
            print_findings(edits, to_stderr=True)
            return 2
        if args.set:
            return _replay_values(args, opened, design, _chain(first, iterations))
        result = replay_design(
            opened.open_project,
            design,
            _chain(first, iterations),
            tolerance_ns=round(args.tolerance * 1e9),
            allows_missing=args.allow_missing,
        )
    except TraceError as error:
        raise OSError(f"{args.trace}: {error}") from error
    except (MissingValuesError, NotReadyError, UnsoundDesignError, RunFailedError) as error:
        raise OSError(f"cannot replay {args.trace}: {error}") from error
    return _report(result, opened, design)


def _replay_values(
    args: argparse.Namespace, opened: LoadedProject, design: "Design", iterations: "Iterator[IterationResult]"
) -> int:
    """Print what changes with other values; return 1 if something does."""
    from vicode.runs.changed_values import ChangedValueError, apply_values, parse_changed_value
    from vicode.runs.replay_report import OPEN_LOOP, describe_effect, describe_unlike_record, summarize_effect
    from vicode.services.trace_replay import replay_with_values

    project = opened.open_project.project
    values = []
    for given in args.set:
        try:
            values.append(parse_changed_value(given, project))
        except ChangedValueError as error:
            raise OSError(f"--set {given}: {error}") from error
    effect = replay_with_values(opened.open_project, design, values, iterations, allows_missing=args.allow_missing)
    print(summarize_effect(effect))
    for line in describe_effect(project, apply_values(project, values), effect):
        print(line)
    if effect.changed:
        print(OPEN_LOOP)
    if note := describe_unlike_record(effect):
        print(note)
    return 1 if effect.changed else 0


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
