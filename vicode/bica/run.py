"""The command that runs a component in a world.

Exit codes: 0 success, 1 a component failed with `--on-error stop`, 2 could not run, 3 an output could not be written,
128 + number of a signal.
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

from .clock import PacedClock, SimulatedClock, WorldClock
from .errors import ComponentError, CyclicUseError, OutputError, print_error
from .live import NoHoldError
from .loader import UserCodeError, describe_user_error, load_component, make_world, wrap_user_errors
from .observer import TRACE_HEADER, IterationRecord, Observer, only_changes, to_json_value
from .options import TICKS, WORLD, make_parser
from .reload import Reloader
from .root import Root
from .stop_signals import StopSignals
from .tick import choose_tick_ns, describe_wrong_frequencies
from .watchdog import Watchdog

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    from .component import Component


EXIT_OUTPUT_LOST = 3
"""A trace, a record or the standard output could not be written, whatever else happened."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    return _run_command(make_parser().parse_args(arguments))


def run_project(
    components: Mapping[str, str], *, world: str = "", clock: str = TICKS, arguments: Sequence[str] | None = None
) -> int:
    """Run the command of a project, `python -m PACKAGE [COMPONENT]`, and return its exit code.

    Args:
        components: The root components as "module:Class" by name; the first is the default.
        world: The default world as "module:Class".
        clock: Who sets the pace by default: "ticks" or "world".
        arguments: By default those of the process.
    """
    package = next(iter(components.values())).partition(".")[0]
    options = make_parser(components, world=world, clock=clock, program=package).parse_args(arguments)
    options.component = components[options.component]
    return _run_command(options)


def _run_command(options: argparse.Namespace) -> int:
    sys.path[:0] = [str(Path(folder).resolve()) for folder in options.path]
    # Bytecode has the time of its source in seconds, and would be taken for that of a later edit.
    sys.dont_write_bytecode = sys.dont_write_bytecode or options.reload
    open_missing_streams()
    signals = StopSignals(is_silent=options.stream)
    try:
        try:
            with ExitStack() as files:
                return _run(*_prepare(options, files), signals)
        except UserCodeError as error:
            return _fail(str(error), 2, is_streamed=options.stream)
        except OutputError as error:
            return _fail(str(error), EXIT_OUTPUT_LOST, is_streamed=options.stream)
    except KeyboardInterrupt:
        return signals.exit_code
    except BrokenPipeError:
        # The reader of the stream closed it.
        _discard_output()
        return 1


def _discard_output() -> None:
    """Redirect the standard output, or the final flush of the interpreter fails."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def open_missing_streams() -> None:
    """Replace standard streams that were closed before the start: files opened later must not take their place."""
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    if sys.stdout is None or sys.stderr is None:
        nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - open until the end
        sys.stdout = sys.stdout or nowhere
        sys.stderr = sys.stderr or nowhere
    if sys.stdin is None:
        sys.stdin = Path(os.devnull).open(encoding="utf-8")  # noqa: SIM115 - open until the end


def _prepare(options: argparse.Namespace, files: ExitStack) -> tuple[Root, _RecordWriter]:
    _check_pace_options(options)
    _check_network_options(options)
    component_class = load_component(options.component)
    try:
        writer = _RecordWriter(trace=_open_trace(options.trace), options=options)
        files.callback(writer.close_trace)
        origin = {"design": options.design, "revision": options.revision}
        writer.write_trace({**TRACE_HEADER, **{name: value for name, value in origin.items() if value}})
        world = make_world(options.world, options.seed)
        with wrap_user_errors(f"cannot create {options.component}"):
            return _make_root(component_class, world, writer), writer
    except (CyclicUseError, OSError) as error:
        raise UserCodeError(str(error)) from error


def _open_trace(path: str | None) -> TextIO | None:
    if not path:
        return None
    # An open descriptor, such as the standard output, keeps what is there.
    mode: Literal["a", "w"] = "a" if path.startswith("/dev/fd/") else "w"
    try:
        return Path(path).open(mode, encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write the trace {path}: {error.strerror}") from error


def _check_pace_options(options: argparse.Namespace) -> None:
    for name, is_given in {"--real-time": options.real_time, "--tick-ms": options.tick_ms is not None}.items():
        if options.clock == WORLD and is_given:
            raise UserCodeError(f"{name} has no effect if the world sets the pace (clock: world); leave it out")
    if options.without_hold and not options.control:
        raise UserCodeError("--without-hold has no effect without --control; leave it out")


def _check_network_options(options: argparse.Namespace) -> None:
    if options.net is not None and not options.real_time and options.clock != WORLD:
        raise UserCodeError("--net needs --real-time: other robots do not wait for simulated time")
    for name, is_given in {"--team": options.team is not None, "--on-call": options.on_call}.items():
        if is_given and options.net is None:
            raise UserCodeError(f"{name} has no effect without --net; add --net and the name of this robot")


def _fail(message: str, code: int, *, is_streamed: bool) -> int:
    """Write the error to standard error, and to the stream so that its reader recognizes the failure."""
    # Errors are one line each.
    line = " ".join(message.split("\n"))
    print_error(line)
    try:
        _print_output(json.dumps({"failed": line}) + "\n" if is_streamed else "", is_flushed=True)
    except OutputError:
        _discard_output()
    return code


def _print_output(text: str, *, is_flushed: bool = False) -> None:
    try:
        sys.stdout.write(text)
        if is_flushed:
            sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OutputError(f"cannot write the standard output: {error.strerror}") from error


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
            line = json.dumps({**record, "world": _call_optional(world, "snapshot")})
            _print_output(f"{line}\n", is_flushed=self.options.real_time or self.options.clock == WORLD)

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
        if isinstance(root.clock, WorldClock):
            summary.update(root.clock.as_plain())
        else:
            summary["tick_ms"] = tick_ns / 1e6
        if isinstance(root.clock, PacedClock):
            summary["overruns"] = root.clock.overruns
        targets = {type(each).__name__: {"target_hz": each.frequency_hz} for each in root.components}
        cycle_times = {name: {**times.as_plain(), **targets[name]} for name, times in root.cycle_times.items()}
        text = json.dumps({"summary": {**summary, "cycle_times": cycle_times}}) + "\n"
        _print_output(text if self.options.stream else _format_summary(summary, cycle_times), is_flushed=True)


def _make_root(component_class: type[Component], world: Any, writer: _RecordWriter) -> Root:
    options = writer.options
    is_observed = writer.trace is not None or options.stream
    sink = partial(writer.write_iteration, world)
    root = Root(
        component_class,
        clock=_make_clock(options, world),
        world=world,
        on_error=options.on_error,
        observer=Observer(only_changes(sink) if options.changes else sink, values=options.values)
        if is_observed
        else None,
    )
    root.measure = True
    if options.record:
        _record(root, options)
    if options.net is not None:
        root.connect(options.net, team=options.team or "", on_call=options.on_call)
    if options.watch is not None:
        _watch(root, options)
    return root


def _record(root: Root, options: argparse.Namespace) -> None:
    design, revision = options.design or "", options.revision or ""
    try:
        root.record(options.record, minutes=options.minutes, design=design, revision=revision)
    except OSError as error:
        raise OutputError(f"cannot write the record {options.record}: {error.strerror}") from error


def _make_clock(options: argparse.Namespace, world: Any) -> PacedClock | SimulatedClock | WorldClock:
    if options.clock != WORLD:
        return PacedClock() if options.real_time else SimulatedClock()
    missing = [name for name in ("now_ns", "next_cycle") if not callable(getattr(world, name, None))]
    if missing:
        raise UserCodeError(
            f"the world {options.world or 'None'} cannot set the pace (clock: world): it has no {missing[0]}()"
        )
    return WorldClock(world)


def _watch(root: Root, options: argparse.Namespace) -> None:
    try:
        root.watch(
            options.watch,
            token=os.environ.get("VICODE_WATCH_TOKEN", ""),
            control=options.control,
            without_hold=options.without_hold,
            name=os.environ.get("VICODE_ROBOT", ""),
        )
    except NoHoldError as error:
        raise UserCodeError(f"--control is refused: {error}, or add --without-hold") from error
    except (OSError, OverflowError) as error:
        number = getattr(error, "errno", None)
        reason = os.strerror(number) if number and number > 0 else error
        raise UserCodeError(f"viewers cannot connect to {options.watch}: {reason}; choose another --watch") from error


def _find_tick_ns(root: Root, options: argparse.Namespace) -> int:
    """Return the given tick or one that fits the frequencies; warn of frequencies that it does not fit.

    It is 0 if the world sets the pace.
    """
    if options.clock == WORLD:
        return 0
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
    if writer.is_incomplete or root._has_lost_output:
        return EXIT_OUTPUT_LOST
    return {"error": 1, "interrupted": signals.exit_code}.get(stopped, 0)


def _loop(root: Root, options: argparse.Namespace, tick_ns: int, signals: StopSignals) -> str:
    """Run iterations and return the reason for the end."""
    clock = root.clock
    most_iterations = math.inf if options.ticks is None else options.ticks
    end_ns = math.inf if options.seconds is None else round(options.seconds * 1e9)
    reloader = Reloader(root, options.path) if options.reload else None
    root._is_stopping = signals.was_received
    signals.is_deferred = True
    if isinstance(clock, PacedClock):
        clock.start()
    with _make_watchdog(root, options, tick_ns) as watchdog:
        while root.iteration < most_iterations and not signals.was_received():
            is_due = not isinstance(clock, WorldClock) or clock.wait()
            if clock.now_ns() >= end_ns or signals.was_received():
                break
            if is_due:
                for message in reloader.reload_if_asked() if reloader is not None else ():
                    print_error(message, kind="reload")
                watchdog.begin()
                _run_iteration(root)
                watchdog.end()
            if (reason := _find_end(root, options)) or signals.was_received():
                return reason if not signals.was_received() else "interrupted"
            if isinstance(clock, PacedClock):
                clock.wait(tick_ns, end_ns=end_ns, is_cancelled=signals.was_received)
            elif isinstance(clock, SimulatedClock):
                clock.advance(tick_ns)
    return "interrupted" if signals.was_received() else "limit"


def _make_watchdog(root: Root, options: argparse.Namespace, tick_ns: int) -> Watchdog:
    """The watchdog of a run in real time; in simulated time, the world waits for its robot."""
    if isinstance(root.clock, SimulatedClock) or not options.hold_after:
        return Watchdog(root, 0.0)
    return Watchdog(root, options.hold_after + (tick_ns / 1e9 if isinstance(root.clock, PacedClock) else 0.0))


def _run_iteration(root: Root) -> None:
    """Advance the world, unless it sets the pace itself, and step the root."""
    advance_world = getattr(root.world, "advance", None)
    if advance_world is not None and not isinstance(root.clock, WorldClock):
        advance_world(root.clock.now_ns())
    root.step()


def _find_end(root: Root, options: argparse.Namespace) -> str:
    """Why the run ends after an iteration, "" if it goes on."""
    if getattr(root.world, "finished", False):
        return "finished"
    return "done" if options.until_done and root.main.is_done else ""


def _call_optional(world: Any, name: str) -> Any:
    method = getattr(world, name, None)
    return to_json_value(method()) if method is not None else None


def _format_summary(summary: dict[str, Any], cycle_times: dict[str, Any]) -> str:
    lines = [f"{name}: {value if isinstance(value, str) else json.dumps(value)}" for name, value in summary.items()]
    for name, times in cycle_times.items():
        numbers = ", ".join(f"{key} {value:g}" for key, value in times.items() if value is not None)
        lines.append(f"{name}: {numbers}")
    return "\n".join(lines) + "\n"
