"""The command-line arguments of the runtime."""

from __future__ import annotations

import argparse
import math

_MAX_TICK_MS = 3_600_000.0


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f"python -m {__package__}", description="Run a component in a world.")
    add = parser.add_argument
    add("component", metavar="MODULE:CLASS", help="the root component")
    add("--world", metavar="MODULE:CLASS", help="the world; created with seed=N if it has that parameter")
    add("--path", metavar="DIR", action="append", default=[], help="add DIR to the import path; may be repeated")
    add("--seed", type=int, default=0, metavar="N", help="seed of the world (default: 0)")
    add("--ticks", type=count, metavar="N", help="stop after N iterations")
    add("--seconds", type=seconds, metavar="S", help="stop after S seconds of real or simulated time")
    add("--until-done", action="store_true", help="stop when the root component is done")
    add(
        "--tick-ms",
        type=tick_ms,
        metavar="MS",
        help="time between iterations (default: fits the frequencies, up to 20)",
    )
    add("--real-time", action="store_true", help="run in real time instead of simulated time")
    add(
        "--on-error",
        choices=("continue", "stop"),
        default="continue",
        help="what to do after an exception in a component (default: continue)",
    )
    add("--trace", metavar="FILE", help="write a trace to FILE: a header, one JSON line per iteration and a summary")
    add("--record", metavar="FILE", help="keep the last minutes, with values, in files beside FILE")
    add("--minutes", type=minutes, default=5.0, metavar="N", help="how much --record keeps (default: 5)")
    add("--design", metavar="HASH", help="hash of the design, for the header of the trace")
    add("--revision", metavar="REV", help="git revision of the design, for the header of the trace")
    add("--stream", action="store_true", help="write JSON lines with snapshots of the world to standard output")
    add("--values", action="store_true", help="include outputs and variables in the JSON lines")
    return parser


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
