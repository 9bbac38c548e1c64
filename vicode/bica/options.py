"""The command's arguments, and the numbers that make sense in them."""

from __future__ import annotations

import argparse
import math

_MAX_TICK_MS = 3_600_000.0


def make_parser() -> argparse.ArgumentParser:
    """Make the parser of the command's arguments."""
    parser = argparse.ArgumentParser(prog=f"python -m {__package__}", description="Run a component in a world.")
    add = parser.add_argument
    add("component", metavar="MODULE:CLASS", help="the root component")
    add("--world", metavar="MODULE:CLASS", help="made with seed=N if it takes that; may have advance, finished, …")
    add("--path", metavar="DIR", action="append", default=[], help="import from here too; may be repeated")
    add("--seed", type=int, default=0, metavar="N", help="seed of the world (0)")
    add("--ticks", type=count, metavar="N", help="stop after N iterations")
    add("--seconds", type=seconds, metavar="S", help="stop after S seconds of the clock")
    add("--until-done", action="store_true", help="stop when the root component is done")
    add("--tick-ms", type=tick_ms, default=20.0, metavar="MS", help="time between two iterations (20)")
    add("--real-time", action="store_true", help="let real time pass instead of simulated time")
    add("--on-error", choices=("continue", "stop"), default="continue", help="what an exception in a component does")
    add("--trace", metavar="FILE", help="write one JSON line an iteration, and a summary")
    add("--stream", action="store_true", help="write JSON lines with the world's snapshot on standard output")
    add("--values", action="store_true", help="add outputs and variables to the lines")
    return parser


def count(text: str) -> int:
    """Read a number of iterations.

    Raises:
        argparse.ArgumentTypeError: it is below 0.
    """
    number = int(text)
    if number < 0:
        raise argparse.ArgumentTypeError(f"{text} is below 0")
    return number


def seconds(text: str) -> float:
    """Read a length of time.

    Raises:
        argparse.ArgumentTypeError: it is below 0, or no finite number.
    """
    number = float(text)
    if not math.isfinite(number) or number < 0:
        raise argparse.ArgumentTypeError(f"{text} is no length of time; write a number of seconds, 0 or more")
    return number


def tick_ms(text: str) -> float:
    """Read the time between two iterations, from a nanosecond to an hour.

    Raises:
        argparse.ArgumentTypeError: it is outside of that.
    """
    number = float(text)
    if not 1e-6 <= number <= _MAX_TICK_MS:
        raise argparse.ArgumentTypeError(f"{text} is no time between iterations; write milliseconds above 0, as 20")
    return number
