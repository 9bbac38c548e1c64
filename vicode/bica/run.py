"""The command that runs a component in a world: simulated or real time, trace, live stream, summary.

Exit codes: 0 ran to its end, 1 a component failed and `--on-error stop` was given, 2 could not start, 130 interrupted.
"""

from __future__ import annotations

import argparse
import importlib
import inspect
import json
import math
import os
import signal
import sys
import time
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from .clock import RealClock, SimulatedClock
from .component import Component
from .errors import ComponentError, CyclicUseError
from .observer import IterationRecord, Observer, to_plain
from .root import Root

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import FrameType

EXIT_CODES = {"error": 1, "interrupted": 130}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    options = _make_parser().parse_args(arguments)
    sys.path[:0] = [str(Path(folder).resolve()) for folder in options.path]
    with ExitStack() as files:
        try:
            component_class = _load(options.component)
            world = _make_world(options.world, options.seed)
            trace = files.enter_context(Path(options.trace).open("w", encoding="utf-8")) if options.trace else None
            lines = _Lines(trace=trace, world=world, options=options)
            root = _make_root(component_class, lines)
        except (_StartError, CyclicUseError, OSError) as error:
            sys.stderr.write(f"error: {error}\n")
            return 2
        try:
            return _run(root, lines)
        except BrokenPipeError:
            # Whoever read the stream has gone; nothing is left to say, also not by the interpreter's last flush.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 1


class _StartError(Exception):
    """What was named on the command line cannot be loaded."""


@dataclass(slots=True, kw_only=True)
class _Lines:
    """Where the records of a run go: a trace file, the standard output of a live stream, both, or nowhere."""

    trace: TextIO | None
    world: Any
    options: argparse.Namespace

    def write_iteration(self, record: IterationRecord) -> None:
        if self.trace is not None:
            self.trace.write(json.dumps(record) + "\n")
        if self.options.stream:
            sys.stdout.write(json.dumps({**record, "world": _ask(self.world, "snapshot")}) + "\n")
            if self.options.real_time:
                sys.stdout.flush()

    def write_summary(self, summary: dict[str, Any], cycle_times: dict[str, Any]) -> None:
        # Measured times differ from run to run, and the trace of a seed must not.
        if self.trace is not None:
            self.trace.write(json.dumps({"summary": summary}) + "\n")
        if self.options.stream:
            sys.stdout.write(json.dumps({"summary": {**summary, "cycle_times": cycle_times}}) + "\n")
        else:
            sys.stdout.write(_describe(summary, cycle_times))
        sys.stdout.flush()


class _Interrupt:
    """Notes the first Ctrl-C, so that the iteration ends whole; the second one interrupts as usual."""

    def __init__(self) -> None:
        self.has_come = False
        signal.signal(signal.SIGINT, self._note)

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        self.has_come = True
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _make_root(component_class: type[Component], lines: _Lines) -> Root:
    options = lines.options
    is_watched = lines.trace is not None or options.stream
    root = Root(
        component_class,
        clock=RealClock() if options.real_time else SimulatedClock(),
        world=lines.world,
        on_error=options.on_error,
        observer=Observer(lines.write_iteration, values=options.values) if is_watched else None,
    )
    root.measure = True
    return root


def _run(root: Root, lines: _Lines) -> int:
    stopped = _loop(root, lines.options)
    summary = {
        "stopped": stopped,
        "iterations": root.iteration,
        "time_ns": root.now_ns,
        "state": root.main.state,
        "done": root.main.is_done,
        "errors": root.errors.total(),
        "world": _ask(root.world, "summary"),
    }
    lines.write_summary(summary, {name: times.as_plain() for name, times in root.cycle_times.items()})
    return EXIT_CODES.get(stopped, 0)


def _loop(root: Root, options: argparse.Namespace) -> str:
    """Iterate until something says stop, and return what it was."""
    interrupt, world = _Interrupt(), root.world
    tick_ns = round(options.tick_ms * 1e6)
    limit = _count_ticks(options, tick_ns)
    advance_world = getattr(world, "advance", None)
    while root.iteration < limit:
        if advance_world is not None:
            advance_world(root.clock.now_ns())
        try:
            root.step()
        except ComponentError as error:
            sys.stderr.write(f"error: {error}\n")
            return "error"
        if interrupt.has_come:
            return "interrupted"
        if getattr(world, "finished", False):
            return "finished"
        if options.until_done and root.main.is_done:
            return "done"
        _wait(root, tick_ns)
    return "limit"


def _wait(root: Root, tick_ns: int) -> None:
    """Let time pass until the next tick; a late one is not caught up."""
    clock = root.clock
    if isinstance(clock, SimulatedClock):
        clock.advance(tick_ns)
        return
    spare_ns = root.now_ns + tick_ns - clock.now_ns()
    if spare_ns > 0:
        time.sleep(spare_ns / 1e9)


def _count_ticks(options: argparse.Namespace, tick_ns: int) -> float:
    by_seconds = math.inf if options.seconds is None else math.ceil(options.seconds * 1e9 / tick_ns)
    return min(by_seconds, math.inf if options.ticks is None else options.ticks)


def _load(name: str) -> type[Component]:
    found = _find(name)
    if not (isinstance(found, type) and issubclass(found, Component)):
        raise _StartError(f"{name} is not a component of this runtime, {Component.__module__}")
    return found


def _make_world(name: str | None, seed: int) -> Any:
    if name is None:
        return None
    make = _find(name)
    return make(seed=seed) if "seed" in inspect.signature(make).parameters else make()


def _find(name: str) -> Any:
    module, colon, attribute = name.partition(":")
    if not colon:
        raise _StartError(f"{name}: write it as module:Class")
    try:
        return getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        raise _StartError(f"cannot load {name}: {error}") from error


def _ask(world: Any, question: str) -> Any:
    answer = getattr(world, question, None)
    return to_plain(answer()) if answer is not None else None


def _describe(summary: dict[str, Any], cycle_times: dict[str, Any]) -> str:
    lines = [f"{name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in summary.items()]
    for name, times in cycle_times.items():
        numbers = ", ".join(f"{key} {value:g}" for key, value in times.items())
        lines.append(f"{name}: {numbers}")
    return "\n".join(lines) + "\n"


def _make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f"python -m {__package__}", description="Run a component in a world.")
    add = parser.add_argument
    add("component", metavar="MODULE:CLASS", help="the root component")
    add("--world", metavar="MODULE:CLASS", help="made with seed=N if it takes that; may have advance, finished, …")
    add("--path", metavar="DIR", action="append", default=[], help="import from here too; may be repeated")
    add("--seed", type=int, default=0, metavar="N", help="seed of the world (0)")
    add("--ticks", type=int, metavar="N", help="stop after N iterations")
    add("--seconds", type=float, metavar="S", help="stop after S seconds of the clock")
    add("--until-done", action="store_true", help="stop when the root component is done")
    add("--tick-ms", type=float, default=20.0, metavar="MS", help="time between two iterations (20)")
    add("--real-time", action="store_true", help="let real time pass instead of simulated time")
    add("--on-error", choices=("continue", "stop"), default="continue", help="what an exception in a component does")
    add("--trace", metavar="FILE", help="write one JSON line an iteration, and a summary")
    add("--stream", action="store_true", help="write JSON lines with the world's snapshot on standard output")
    add("--values", action="store_true", help="add outputs and variables to the lines")
    return parser
