"""The command that runs a component in a world.

Exit codes: 0 success, 1 a component failed with `--on-error stop`, 2 could not run, 130 interrupted.
"""

from __future__ import annotations

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
from .errors import ComponentError, CyclicUseError
from .loader import UserCodeError, load_component, make_world, wrap_user_errors
from .observer import TRACE_HEADER, IterationRecord, Observer, to_json_value
from .options import make_parser
from .root import Root

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from types import FrameType

    from .component import Component

EXIT_CODES = {"error": 1, "interrupted": 130}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    options = make_parser().parse_args(arguments)
    sys.path[:0] = [str(Path(folder).resolve()) for folder in options.path]
    try:
        with ExitStack() as files:
            try:
                writer, root = _prepare(options, files)
            except (CyclicUseError, OSError) as error:
                raise UserCodeError(str(error)) from error
            with wrap_user_errors("the world failed", only_user_code=True):
                return _run(root, writer)
    except UserCodeError as error:
        return _fail(str(error), is_streamed=options.stream)
    except KeyboardInterrupt:
        return EXIT_CODES["interrupted"]
    except BrokenPipeError:
        # The reader of the stream closed it. Redirect standard output, or the final flush of the interpreter fails.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _prepare(options: argparse.Namespace, files: ExitStack) -> tuple[_RecordWriter, Root]:
    component_class = load_component(options.component)
    world = make_world(options.world, options.seed)
    trace = None
    if options.trace:
        trace = Path(options.trace).open("w", encoding="utf-8")  # noqa: SIM115 - closed by the stack
        files.callback(trace.close)
        trace.write(json.dumps(TRACE_HEADER) + "\n")
    writer = _RecordWriter(trace=trace, world=world, options=options)
    with wrap_user_errors(f"cannot create {options.component}"):
        return writer, _make_root(component_class, writer)


def _fail(message: str, *, is_streamed: bool) -> int:
    """Write the error to standard error, and to the stream so that its reader recognizes the failure."""
    # Errors are one line each.
    line = " ".join(message.split("\n"))
    if is_streamed:
        sys.stdout.write(json.dumps({"failed": line}) + "\n")
        sys.stdout.flush()
    sys.stderr.write(f"error: {line}\n")
    return 2


@dataclass(slots=True, kw_only=True)
class _RecordWriter:
    """Writes the records of a run to a trace file, to standard output, or both."""

    trace: TextIO | None
    world: Any
    options: argparse.Namespace

    def write_iteration(self, record: IterationRecord) -> None:
        if self.trace is not None:
            self.trace.write(json.dumps(record) + "\n")
        if self.options.stream:
            sys.stdout.write(json.dumps({**record, "world": _call_optional(self.world, "snapshot")}) + "\n")
            if self.options.real_time:
                sys.stdout.flush()

    def write_summary(self, summary: dict[str, Any], cycle_times: dict[str, Any]) -> None:
        # The trace excludes cycle times: it must be the same for each run with one seed.
        if self.trace is not None:
            self.trace.write(json.dumps({"summary": summary}) + "\n")
        if self.options.stream:
            sys.stdout.write(json.dumps({"summary": {**summary, "cycle_times": cycle_times}}) + "\n")
        else:
            sys.stdout.write(_format_summary(summary, cycle_times))
        sys.stdout.flush()


class _Interrupt:
    """Handles Ctrl-C: the first one stops the run after the current iteration, the second one immediately."""

    def __init__(self, *, is_silent: bool) -> None:
        self.is_requested = False
        self._is_silent = is_silent
        signal.signal(signal.SIGINT, self._handle_signal)

    def _handle_signal(self, _number: int, _frame: FrameType | None) -> None:
        self.is_requested = True
        if not self._is_silent:
            # Bypasses Python's streams: the signal may interrupt a write to them.
            os.write(2, b"stopping after this iteration; press Ctrl-C again to stop immediately\n")
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _make_root(component_class: type[Component], writer: _RecordWriter) -> Root:
    options = writer.options
    is_observed = writer.trace is not None or options.stream
    root = Root(
        component_class,
        clock=RealClock() if options.real_time else SimulatedClock(),
        world=writer.world,
        on_error=options.on_error,
        observer=Observer(writer.write_iteration, values=options.values) if is_observed else None,
    )
    root.measure = True
    return root


def _run(root: Root, writer: _RecordWriter) -> int:
    stopped = _loop(root, writer.options)
    summary = {
        "stopped": stopped,
        "iterations": root.iteration,
        "time_ns": root.now_ns,
        "state": root.main.state,
        "done": root.main.is_done,
        "errors": root.errors.total(),
        "world": _call_optional(root.world, "summary"),
    }
    writer.write_summary(summary, {name: times.as_plain() for name, times in root.cycle_times.items()})
    return EXIT_CODES.get(stopped, 0)


def _loop(root: Root, options: argparse.Namespace) -> str:
    """Run iterations and return the reason for the end."""
    interrupt, world = _Interrupt(is_silent=options.stream), root.world
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
        if interrupt.is_requested:
            return "interrupted"
        if getattr(world, "finished", False):
            return "finished"
        if options.until_done and root.main.is_done:
            return "done"
        _wait(root, tick_ns)
    return "limit"


def _wait(root: Root, tick_ns: int) -> None:
    """Wait for the next tick; delays are not compensated."""
    clock = root.clock
    if isinstance(clock, SimulatedClock):
        clock.advance(tick_ns)
        return
    remaining_ns = root.now_ns + tick_ns - clock.now_ns()
    if remaining_ns > 0:
        time.sleep(remaining_ns / 1e9)


def _count_ticks(options: argparse.Namespace, tick_ns: int) -> float:
    by_seconds = math.inf if options.seconds is None else math.ceil(options.seconds * 1e9 / tick_ns)
    return min(by_seconds, math.inf if options.ticks is None else options.ticks)


def _call_optional(world: Any, name: str) -> Any:
    method = getattr(world, name, None)
    return to_json_value(method()) if method is not None else None


def _format_summary(summary: dict[str, Any], cycle_times: dict[str, Any]) -> str:
    lines = [f"{name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in summary.items()]
    for name, times in cycle_times.items():
        numbers = ", ".join(f"{key} {value:g}" for key, value in times.items())
        lines.append(f"{name}: {numbers}")
    return "\n".join(lines) + "\n"
