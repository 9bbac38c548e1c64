"""Run an experiment with simulated robots for several seeds, and write a page with its figures."""

import argparse
import asyncio
import contextlib
import signal
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.bica import options

if TYPE_CHECKING:
    from vicode.experiments.definitions import Experiment
    from vicode.experiments.page import VersionResult

_NAMES = ("circle", "corridor", "meeting")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("name", metavar="NAME", choices=_NAMES, help=f"one of: {', '.join(_NAMES)} (docs/experiments.md)")
    add("--out", metavar="DIR", required=True, help="folder of the page; it is created if needed")
    add("--seeds", type=options.count, default=20, metavar="N", help="seeds 1 to N in each world (default: 20)")
    add("--project", metavar="DIR", help="take the behavior from this project instead of the sample")
    add("--faults", action="store_true", help="add runs in real time with faults of the robot, 12 s for each")
    add("--no-real-time", action="store_true", help="leave out the runs in real time, up to a minute for each version")


def run(args: argparse.Namespace) -> int:
    """Run both versions of the behavior, print their figures, and write the page; 1 if a run has failed."""
    try:
        from vicode.experiments.definitions import EXPERIMENTS
    except ModuleNotFoundError as error:
        if error.name != "pymunk":
            raise
        from vicode.cli.sim import MISSING_EXTRA

        print(MISSING_EXTRA, file=sys.stderr)
        return 2
    from vicode.experiments.bridge_process import BridgeStartError
    from vicode.experiments.versions import ExperimentError
    from vicode.simulated_robot.client import BridgeError

    try:
        with ending_at_sigterm():
            return _run(EXPERIMENTS[args.name], args)
    except (ExperimentError, BridgeStartError, BridgeError) as error:
        print(f"vicode: {error}", file=sys.stderr)
        return 2


@contextlib.contextmanager
def ending_at_sigterm() -> Iterator[None]:
    """Treat SIGTERM as Ctrl-C, so that started processes end, too."""
    previous = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, previous)


def _run(experiment: "Experiment", args: argparse.Namespace) -> int:
    from vicode.cli.progress import progress_bar
    from vicode.experiments.page import write_page
    from vicode.experiments.versions import prepare_behavior, run_versions
    from vicode.output import write_atomically

    out = Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    project = Path(args.project) if args.project else None
    with prepare_behavior(experiment, project) as prepared, progress_bar() as advance:
        versions = asyncio.run(
            run_versions(
                experiment,
                prepared,
                seeds=args.seeds,
                has_real_time=not args.no_real_time,
                has_faults=args.faults,
                on_progress=advance,
            )
        )
    page = out / f"{experiment.name}.html"
    write_atomically(page, write_page(experiment, prepared.design, versions))
    problems = _print_results(versions)
    print(f"wrote {page}")
    return 1 if problems else 0


def _print_results(versions: "Sequence[VersionResult]") -> int:
    """Print a line per version, and one per failed run; return the number of failed runs."""
    problems = 0
    for version in versions:
        runs = version.result.runs
        failed = [each for each in runs if each.problem]
        problems += 0 if version.is_reference else len(failed)
        overshoots = [each.overshoot_deg for each in runs if each.overshoot_deg is not None]
        words = [f"{len(runs) - len(failed)} of {len(runs)} runs succeeded"]
        words += [f"overshoot {min(overshoots):.2f}° to {max(overshoots):.2f}°"] if overshoots else []
        words += [f"{sum(each.contacts for each in runs)} contacts", f"{version.result.speed:.0f} × real time"]
        words += [f"bridge {version.cpu_s:.1f} s, {version.memory_mb:.0f} MB"]
        print(f"{version.title}: {', '.join(words)}")
        for each in failed:
            print(f"  {each.world_map.name}, seed {each.seed}: {each.problem}")
    return problems
