"""The command-line arguments of the runtime."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping

TICKS, WORLD = "ticks", "world"
"""Who sets the pace of a run."""
HOLD_AFTER_S = 0.5

_MAX_TICK_MS = 3_600_000.0


def make_parser(
    components: Mapping[str, str] | None = None, *, world: str = "", clock: str = TICKS, program: str = ""
) -> argparse.ArgumentParser:
    """Make the parser.

    Args:
        components: Classes as module:Class by name, of which the first is the default; None for any class.
        world: The default world as module:Class.
        clock: Who sets the pace by default.
        program: The name of the command.
    """
    description = "Run a component in a world."
    parser = argparse.ArgumentParser(prog=f"python -m {program or __package__}", description=description)
    add = parser.add_argument
    _add_root_arguments(parser, components, world)
    add("--reload", action="store_true", help=argparse.SUPPRESS)
    add("--changes", action="store_true", help=argparse.SUPPRESS)
    _add_connections(parser)
    add("--path", metavar="DIR", action="append", default=[], help="add DIR to the import path; may be repeated")
    add("--seed", type=int, default=0, metavar="N", help="seed of the world (default: 0)")
    add("--ticks", type=count, metavar="N", help="stop after N iterations")
    add("--seconds", type=seconds, metavar="S", help="stop after S seconds of real or simulated time")
    add("--until-done", action="store_true", help="stop when the root component is done")
    _add_pace(parser, clock)
    add(
        "--on-error",
        choices=("continue", "stop"),
        default="continue",
        help="what to do after an exception in a component (default: continue)",
    )
    add("--trace", metavar="FILE", help="write a trace to FILE: a header, one JSON line per iteration and a summary")
    add("--record", metavar="FILE", help="keep the last minutes, with values, in files next to FILE")
    add("--minutes", type=minutes, default=5.0, metavar="N", help="how much --record keeps (default: 5)")
    add("--design", metavar="HASH", help="hash of the design, for the header of the trace")
    add("--revision", metavar="REV", help="git revision of the design, for the header of the trace")
    add("--stream", action="store_true", help="write JSON lines with snapshots of the world to standard output")
    add("--values", action="store_true", help="include outputs and variables in the JSON lines")
    return parser


def _add_root_arguments(parser: argparse.ArgumentParser, components: Mapping[str, str] | None, world: str) -> None:
    add = parser.add_argument
    if components is None:
        add("component", metavar="MODULE:CLASS", help="the root component")
    else:
        names = list(components)
        help_ = f"the root component: {', '.join(names)} (default: {names[0]})"
        add("component", metavar="COMPONENT", nargs="?", choices=names, default=names[0], help=help_)
    default = f"; default: {world}" if world else ""
    add(
        "--world",
        metavar="MODULE:CLASS",
        default=world or None,
        help=f"the world; created with seed=N if it has that parameter{default}",
    )


def _add_connections(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--watch", metavar="ADDRESS", help="let viewers connect: PORT, HOST:PORT or unix:PATH")
    add("--control", action="store_true", help="with --watch: let viewers pause and change the run")
    add(
        "--without-hold",
        action="store_true",
        help="with --control: also if the world has no hold(), so that a paused robot keeps moving",
    )
    add("--net", metavar="NAME", help="connect to other robots under this name, with --real-time")
    add("--team", metavar="TEAM", help="with --net: coordinate with the robots of this team")
    add("--on-call", action="store_true", help="with --net: step the component only while other robots call it")


def _add_pace(parser: argparse.ArgumentParser, clock: str) -> None:
    add = parser.add_argument
    add(
        "--tick-ms",
        type=tick_ms,
        metavar="MS",
        help="time between iterations (default: a period that fits the frequencies, at most 20 ms)",
    )
    add("--real-time", action="store_true", help="run in real time instead of simulated time")
    add(
        "--clock",
        choices=(TICKS, WORLD),
        default=clock,
        help=f"who sets the pace: ticks of this program, or the world (default: {clock})",
    )
    add(
        "--hold-after",
        type=seconds,
        default=HOLD_AFTER_S,
        metavar="S",
        help="in real time: hold the robot when an iteration is late by more than S seconds; 0: never "
        "(default: %(default)s)",
    )


def count(text: str) -> int:
    """Parse a number of iterations.

    Raises:
        argparse.ArgumentTypeError: It is negative.
    """
    number = int(text)
    if number < 0:
        raise argparse.ArgumentTypeError(f"{text} is negative; write 0 or more")
    return number


def seconds(text: str) -> float:
    """Parse a duration in seconds.

    Raises:
        argparse.ArgumentTypeError: It is negative or not finite.
    """
    number = float(text)
    if not math.isfinite(number) or number < 0:
        raise argparse.ArgumentTypeError(f"{text} is not a valid duration; write seconds, 0 or more")
    return number


def tick_ms(text: str) -> float:
    """Parse the period of the iterations in milliseconds.

    Raises:
        argparse.ArgumentTypeError: It is shorter than a nanosecond or longer than an hour.
    """
    number = float(text)
    if not 1e-6 <= number <= _MAX_TICK_MS:
        raise argparse.ArgumentTypeError(f"{text} is not a valid period; write milliseconds greater than 0, such as 20")
    return number


def minutes(text: str) -> float:
    """Parse a duration in minutes.

    Raises:
        argparse.ArgumentTypeError: It is not greater than 0 or not finite.
    """
    number = float(text)
    if not math.isfinite(number) or number <= 0:
        raise argparse.ArgumentTypeError(f"{text} is not a valid duration; write minutes greater than 0")
    return number
