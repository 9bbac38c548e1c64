"""The command that runs a component in a world.

Exit codes: 0 success, 1 a component failed with `--on-error stop`, 2 could not run, 128 + number of a signal.
"""

from __future__ import annotations

import json
import math
import os
import sys
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TextIO

from .clock import PacedClock, SimulatedClock
from .errors import ComponentError, CyclicUseError, print_error
from .loader import UserCodeError, describe_user_error, load_component, make_world, wrap_user_errors
from .observer import TRACE_HEADER, IterationRecord, Observer, to_json_value
from .options import make_parser
from .reload import Reloader
from .root import Root
from .stop_signals import StopSignals
from .tick import choose_tick_ns, describe_wrong_frequencies

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    from .component import Component


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    return _run_command(make_parser().parse_args(arguments))


def run_project(components: Mapping[str, str], *, world: str = "", arguments: Sequence[str] | None = None) -> int:
    """Run the command of a project, `python -m PACKAGE [COMPONENT]`, and return its exit code.

    Args:
        components: The root components as "module:Class" by name; the first is the default.
        world: The default world as "module:Class".
        arguments: By default those of the process.
    """
    package = next(iter(components.values())).partition(".")[0]
    options = make_parser(components, world=world, program=package).parse_args(arguments)
    options.component = components[options.component]
    return _run_command(options)


def _run_command(options: argparse.Namespace) -> int:
    sys.path[:0] = [str(Path(folder).resolve()) for folder in options.path]
    # Bytecode has the time of its source in seconds, and would be taken for that of a later edit.
    sys.dont_write_bytecode = sys.dont_write_bytecode or options.reload
    _open_missing_streams()
    signals = StopSignals(is_silent=options.stream)
    try:
        try:
            with ExitStack() as files:
                return _run(*_prepare(options, files), signals)
        except UserCodeError as error:
            return _fail(str(error), is_streamed=options.stream)
    except KeyboardInterrupt:
        return signals.exit_code
    except BrokenPipeError:
        # The reader of the stream closed it. Redirect standard output, or the final flush of the interpreter fails.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _open_missing_streams() -> None:
    """Replace standard streams that were closed before the start: files opened later must not take their place."""
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    if sys.stdout is None or sys.stderr is None:
        nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - open until the end
        sys.stdout = sys.stdout or nowhere
        sys.stderr = sys.stderr or nowhere


def _prepare(options: argparse.Namespace, files: ExitStack) -> tuple[Root, _RecordWriter]:
    _check_network_options(options)
    component_class = load_component(options.component)
    try:
        # An open descriptor, such as the standard output, keeps what is there.
        mode: Literal["a", "w"] = "a" if str(options.trace).startswith("/dev/fd/") else "w"
        trace = Path(options.trace).open(mode, encoding="utf-8") if options.trace else None  # noqa: SIM115 - by the writer
        writer = _RecordWriter(trace=trace, options=options)
        files.callback(writer.close_trace)
        origin = {"design": options.design, "revision": options.revision}
        writer.write_trace({**TRACE_HEADER, **{name: value for name, value in origin.items() if value}})
        world = make_world(options.world, options.seed)
        with wrap_user_errors(f"cannot create {options.component}"):
            return _make_root(component_class, world, writer), writer
    except (CyclicUseError, OSError) as error:
        raise UserCodeError(str(error)) from error


def _check_network_options(options: argparse.Namespace) -> None:
    if options.net is not None and not options.real_time:
        raise UserCodeError("--net needs --real-time: other robots do not wait for simulated time")
    for name, is_given in {"--team": options.team is not None, "--on-call": options.on_call}.items():
        if is_given and options.net is None:
            raise UserCodeError(f"{name} has no effect without --net; add --net and the name of this robot")


def _fail(message: str, *, is_streamed: bool) -> int:
    """Write the error to standard error, and to the stream so that its reader recognizes the failure."""
    # Errors are one line each.
    line = " ".join(message.split("\n"))
    print_error(line)
    if is_streamed:
        sys.stdout.write(json.dumps({"failed": line}) + "\n")
        sys.stdout.flush()
    return 2


@dataclass(slots=True, kw_only=True)
class _RecordWriter:
    """Writes the records of a run to a trace file, to standard output, or both."""

    trace: TextIO | None
    options: argparse.Namespace
    is_incomplete: bool = False

    def write_trace(self, record: Mapping[str, Any]) -> None:
        """Write a line of the trace; after an error such as a full disk, the run continues without it."""
        if self.trace is not None:
            try:
                self.trace.write(json.dumps(record) + "\n")
            except OSError as error:
                self._report_trace(error)

    def close_trace(self) -> None:
        if self.trace is not None:
            try:
                self.trace.close()
            except OSError as error:
                self._report_trace(error)
            self.trace = None

    def _report_trace(self, error: OSError) -> None:
        print_error(f"cannot write the trace {self.options.trace}: {error.strerror}; the run continues without it")
        if self.trace is not None:
            with suppress(OSError):
                self.trace.close()
        self.trace = None
        self.is_incomplete = True

    def write_iteration(self, world: Any, record: IterationRecord) -> None:
        if self.trace is not None:
            self.write_trace(record)
        if self.options.stream:
            sys.stdout.write(json.dumps({**record, "world": _call_optional(world, "snapshot")}) + "\n")
            if self.options.real_time:
                sys.stdout.flush()

    def write_summary(self, root: Root, stopped: str, tick_ns: int, world_summary: Any) -> None:
        summary = {
            "stopped": stopped,
            "iterations": root.iteration,
            "time_ns": root.now_ns,
            "state": root.main.state,
            "done": root.main.is_done,
            "errors": root.errors.total(),
            "world": world_summary,
        }
        # The trace excludes measured times: it must be the same for each run with one seed.
        self.write_trace({"summary": summary})
        self.close_trace()
        summary["tick_ms"] = tick_ns / 1e6
        if isinstance(root.clock, PacedClock):
            summary["overruns"] = root.clock.overruns
        targets = {type(each).__name__: {"target_hz": each.frequency_hz} for each in root.components}
        cycle_times = {name: {**times.as_plain(), **targets[name]} for name, times in root.cycle_times.items()}
        if self.options.stream:
            sys.stdout.write(json.dumps({"summary": {**summary, "cycle_times": cycle_times}}) + "\n")
        else:
            sys.stdout.write(_format_summary(summary, cycle_times))
        sys.stdout.flush()


def _make_root(component_class: type[Component], world: Any, writer: _RecordWriter) -> Root:
    options = writer.options
    is_observed = writer.trace is not None or options.stream
    root = Root(
        component_class,
        clock=PacedClock() if options.real_time else SimulatedClock(),
        world=world,
        on_error=options.on_error,
        observer=Observer(partial(writer.write_iteration, world), values=options.values) if is_observed else None,
    )
    root.measure = True
    if options.record:
        root.record(
            options.record, minutes=options.minutes, design=options.design or "", revision=options.revision or ""
        )
    if options.net is not None:
        root.connect(options.net, team=options.team or "", on_call=options.on_call)
    if options.watch is not None:
        _watch(root, options)
    return root


def _watch(root: Root, options: argparse.Namespace) -> None:
    try:
        root.watch(options.watch, token=os.environ.get("VICODE_WATCH_TOKEN", ""), control=options.control)
    except (OSError, OverflowError) as error:
        number = getattr(error, "errno", None)
        reason = os.strerror(number) if number and number > 0 else error
        raise UserCodeError(f"viewers cannot connect to {options.watch}: {reason}; choose another --watch") from error


def _find_tick_ns(root: Root, options: argparse.Namespace) -> int:
    """Return the given tick or one that fits the frequencies; warn of frequencies that it does not fit."""
    frequencies_hz = [component.frequency_hz for component in root.components if component.frequency_hz]
    tick_ns = round(options.tick_ms * 1e6) if options.tick_ms else choose_tick_ns(frequencies_hz)
    for warning in describe_wrong_frequencies(root.components, tick_ns):
        print_error(warning, kind="warning")
    return tick_ns


def _run(root: Root, writer: _RecordWriter, signals: StopSignals) -> int:
    """Run until the end, close the components and the world, and write the summary."""
    stopped, tick_ns = "error", _find_tick_ns(root, writer.options)
    failure: Exception | None = None
    try:
        with wrap_user_errors("the world failed", only_user_code=True), root:
            stopped = _loop(root, writer.options, tick_ns, signals)
    except KeyboardInterrupt:
        stopped = "interrupted"
    except ComponentError as error:
        stopped = "error"
        print_error(str(error))
    except SystemExit as error:
        stopped = "error"
        print_error(f"the code ended the run: {describe_user_error(error)}")
    except Exception as error:
        stopped, failure = "error", error
    world_summary = None
    try:
        with wrap_user_errors("the world failed"):
            world_summary = _call_optional(root.world, "summary")
    except UserCodeError as error:
        failure = failure or error
    writer.write_summary(root, stopped, tick_ns, world_summary)
    if failure is not None:
        raise failure
    return {"error": 1, "interrupted": signals.exit_code}.get(stopped, int(writer.is_incomplete))


def _loop(root: Root, options: argparse.Namespace, tick_ns: int, signals: StopSignals) -> str:
    """Run iterations and return the reason for the end."""
    world, clock = root.world, root.clock
    most_iterations = math.inf if options.ticks is None else options.ticks
    end_ns = math.inf if options.seconds is None else round(options.seconds * 1e9)
    advance_world = getattr(world, "advance", None)
    reloader = Reloader(root, options.path) if options.reload else None
    root._is_stopping = signals.was_received
    signals.is_deferred = True
    if isinstance(clock, PacedClock):
        clock.start()
    while root.iteration < most_iterations and clock.now_ns() < end_ns and not signals.was_received():
        for message in reloader.reload_if_asked() if reloader is not None else ():
            print_error(message, kind="reload")
        if advance_world is not None:
            advance_world(clock.now_ns())
        root.step()
        if signals.was_received():
            break
        if getattr(world, "finished", False):
            return "finished"
        if options.until_done and root.main.is_done:
            return "done"
        if isinstance(clock, PacedClock):
            clock.wait(tick_ns, end_ns=end_ns, is_cancelled=signals.was_received)
        elif isinstance(clock, SimulatedClock):
            clock.advance(tick_ns)
    return "interrupted" if signals.was_received() else "limit"


def _call_optional(world: Any, name: str) -> Any:
    method = getattr(world, name, None)
    return to_json_value(method()) if method is not None else None


def _format_summary(summary: dict[str, Any], cycle_times: dict[str, Any]) -> str:
    lines = [f"{name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in summary.items()]
    for name, times in cycle_times.items():
        numbers = ", ".join(f"{key} {value:g}" for key, value in times.items() if value is not None)
        lines.append(f"{name}: {numbers}")
    return "\n".join(lines) + "\n"
