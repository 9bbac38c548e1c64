"""Run the recorded inputs of a trace through the current design and report the first state that differs.

With --set, report what another value of a parameter or constant changes.
With --bag, run a design with the topics of ROS 2 that a bag contains.
"""

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options
from vicode.cli.console import print_findings
from vicode.cli.root_selection import select_root
from vicode.services.project_loader import LoadedProject

if TYPE_CHECKING:
    from collections.abc import Iterator

    from vicode.model.design import Design
    from vicode.runs.replay import ReplayResult
    from vicode.simulation import IterationResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("source", metavar="TRACE", help="a trace recorded with --values, a robot's record, or with --bag a design")
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
    add("--bag", metavar="FILE", help="run the design TRACE with the topics of a bag, in simulated time (docs/ros2.md)")
    add("--profile", metavar="NAME", default="", help="with --bag: the profile whose components are topics")
    add("--trace", metavar="FILE", help="with --bag: write a trace with values")


def run(args: argparse.Namespace) -> int:
    """Replay; return 1 if the states differ, 2 if the trace cannot be replayed."""
    from vicode.generators import UnsoundDesignError
    from vicode.runs import NotReadyError
    from vicode.runs.client import RunFailedError
    from vicode.runs.recorded_inputs import MissingValuesError
    from vicode.services.root_component import find_unsynced_edits
    from vicode.services.trace_replay import find_design, replay_design
    from vicode.traces.reader import TraceError, open_trace

    if args.bag is not None:
        return _replay_bag(args)
    if args.profile or args.trace is not None:
        raise OSError("--profile and --trace have no effect without --bag; leave them out")
    if args.set and args.tolerance:
        raise OSError("--tolerance has no effect with --set; leave it out")
    try:
        trace = open_trace(Path(args.source))
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
        raise OSError(f"{args.source}: {error}") from error
    except (MissingValuesError, NotReadyError, UnsoundDesignError, RunFailedError) as error:
        raise OSError(f"cannot replay {args.source}: {error}") from error
    return _report(result, opened, design)


def _replay_bag(args: argparse.Namespace) -> int:
    """Run a design with the messages of a bag until it ends."""
    from vicode.bica.ros_messages import read_bag
    from vicode.bica.ros_session import BAG
    from vicode.cli import run as run_command
    from vicode.services.run_preparation import find_topics

    if args.set or args.tolerance or args.allow_missing or args.design != ".":
        raise OSError("--set, --tolerance, --allow-missing and --design have no effect with --bag; leave them out")
    _messages, duration_ns = read_bag(args.bag, ())
    selected = select_root(args.source, args.profile, "replay")
    if isinstance(selected, int):
        return selected
    if not find_topics(selected[0].open_project.project, selected[1]):
        raise OSError(f"{selected[1]} uses no topics; name a profile with topics: --profile NAME")
    parser = argparse.ArgumentParser()
    run_command.add_arguments(parser)
    # A bag ends 1 ns after its last message. The first iteration from then on reads it, at most 20 ms later.
    end_s = max(0, duration_ns - 1) / 1e9 + 0.02
    given = [args.source, "--profile", args.profile, "--seconds", str(end_s), "--plain", "--clock", options.TICKS]
    given += ["--trace", args.trace, "--values"] if args.trace is not None else []
    os.environ[BAG] = str(Path(args.bag).resolve())
    try:
        return run_command.run(parser.parse_args(given))
    finally:
        del os.environ[BAG]


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
