"""Prints the trace stream of a running component: one line per state change and a final summary."""

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import FrameType
from typing import IO, Any, Protocol

from vicode.bica.run import EXIT_OUTPUT_LOST
from vicode.findings import escape_text

_SHUTDOWN_TIMEOUT_S = 5.0
_INTERRUPT_TIMEOUT_S = 2.0
_FAILED = 2

TraceRecord = Mapping[str, Any]
"""One parsed line of the stream."""


class TracePrinter(Protocol):
    """Displays a run."""

    def show_iteration(self, record: TraceRecord, changes: list[str], /) -> None:
        """Show an iteration; `changes` describes its state changes."""

    def show_text(self, text: str) -> None:
        """Show output of the component or its runtime."""

    def show_notice(self, text: str) -> None:
        """Show a message of the runner; called from any thread."""

    def close(self) -> None:
        """Stop displaying; only the summary follows."""


class PlainTracePrinter:
    """Prints one line per state change."""

    def show_iteration(self, _record: TraceRecord, changes: list[str], /) -> None:
        for change in changes:
            print(change, flush=True)

    def show_text(self, text: str) -> None:
        """Print it to stdout."""
        print(text, flush=True)

    def show_notice(self, text: str) -> None:
        """Print it to stderr: a program may read stdout."""
        print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        """Do nothing."""


def follow_process(child: "subprocess.Popen[str]", printer: TracePrinter) -> int:
    """Display a process until it ends, forward signals, print the summary; return the exit code.

    The process must be a session leader.
    """
    assert child.stdout is not None
    changes, ending = StateChangeTracker(), _RunOutcome()
    signals = _SignalForwarder(child, printer)
    reader = _start_stderr_reader(child.stderr, printer) if child.stderr is not None else None
    try:
        with signals.forwarding():
            for line in child.stdout:
                _show_line(line, changes, printer, ending)
            child.wait()
    finally:
        _terminate(child)
        if reader is not None:
            reader.join(_SHUTDOWN_TIMEOUT_S)
        printer.close()
    if ending.summary is not None:
        print(describe_summary(ending.summary), end="", flush=True)
    if signals.received is not None and child.returncode != EXIT_OUTPUT_LOST:
        return 128 + signals.received
    return _exit_code(child.returncode, ending)


class StateChangeTracker:
    """Describes state changes between iterations."""

    def __init__(self) -> None:
        self._states: dict[str, str] = {}

    def describe_changes(self, record: TraceRecord) -> list[str]:
        """Describe the state changes of an iteration, one per line."""
        return [line for step in record["tree"] for line in self._describe_step(step, record["time_ns"] / 1e9)]

    def _describe_step(self, step: TraceRecord, time_s: float) -> list[str]:
        component, state = step["component"], step["state"]
        before = step["changed_from"] or self._states.get(component)
        self._states[component] = state
        if not state or before == state:
            return []
        cause = f"  ({step['transition']})" if step["transition"] else ""
        arrow = f"{before} → {state}" if before else state
        return [escape_text(f"{time_s:8.2f} s  {component}: {arrow}{cause}")]


def describe_world(world: object) -> str:
    if not isinstance(world, Mapping):
        return "" if world is None else str(world)
    return "  ".join(f"{name} {_format_value(value)}" for name, value in world.items())


def describe_summary(summary: TraceRecord) -> str:
    """Format the summary of a run: cause of the end, world, cycle times, errors."""
    passed = f"{summary['time_ns'] / 1e9:.2f} s in {summary['iterations']} iterations"
    lines = ["", f"{passed}, stopped: {summary['stopped']}, last state: {summary['state'] or '-'}"]
    if summary.get("world") is not None:
        lines += _wrap(f"world: {describe_world(summary['world'])}")
    times: Mapping[str, TraceRecord] = summary.get("cycle_times") or {}
    if times:
        width = max(len(name) for name in times)
        lines.append(f"{'component':{max(width, 9)}}    works   mean ms    max ms target Hz   real Hz")
        for name, each in times.items():
            figures = f"{each['mean_ms']:9.3f} {each['max_ms']:9.3f}"
            figures += f" {_format_frequency(each.get('target_hz'))} {_format_frequency(each['real_frequency_hz'])}"
            lines.append(f"{name:{max(width, 9)}} {each['count']:8} {figures}")
    if "missed_cycles" in summary:
        latency = f"{summary['latency_mean_ms']:.3g} ms, at most {summary['latency_max_ms']:.3g} ms"
        lines.append(f"missed cycles: {summary['missed_cycles']} of {summary['cycles']}")
        lines.append(f"commands: sent {latency} after the inputs")
    if "overruns" in summary:
        tick = f"{summary['tick_ms']:.4g} ms"
        lines.append(f"overruns: {summary['overruns']} iterations took longer than the tick of {tick}")
    lines.append(f"errors: {summary['errors']}")
    return "\n".join(lines) + "\n"


def _wrap(line: str) -> list[str]:
    """Wrap a line at the width of the terminal, if the output is one."""
    if not sys.stdout.isatty():
        return [line]
    return textwrap.wrap(line, shutil.get_terminal_size().columns, subsequent_indent="       ")


@dataclass(slots=True)
class _RunOutcome:
    """The last record of a program: a summary or a failure; neither if it exited by itself."""

    summary: TraceRecord | None = None
    has_failed: bool = False


def _exit_code(code: int, ending: _RunOutcome) -> int:
    """Convert the exit code of the program; report an unexpected exit."""
    if code == EXIT_OUTPUT_LOST:
        return code
    if ending.has_failed:
        return _FAILED
    if ending.summary is None:
        cause = f"unexpectedly with exit code {code}" if code >= 0 else f"by signal {signal.Signals(-code).name}"
        print(f"the program ended {cause}", file=sys.stderr)
        return 1
    return code if code == 1 or code > 128 else int(ending.summary["errors"] > 0 or code != 0)


def _show_line(line: str, changes: StateChangeTracker, watcher: TracePrinter, ending: _RunOutcome) -> None:
    try:
        record = json.loads(line)
    except ValueError:
        record = None
    if isinstance(record, dict) and "summary" in record:
        ending.summary = record["summary"]
    elif isinstance(record, dict) and "failed" in record:
        ending.has_failed = True
    elif isinstance(record, dict) and "tree" in record:
        watcher.show_iteration(record, changes.describe_changes(record))
    else:
        # Output of hand-written code.
        watcher.show_text(line.rstrip("\n"))


class _SignalForwarder:
    """Forwards Ctrl-C, SIGTERM and SIGHUP to a program and kills it if it does not end.

    After the first signal, the program finishes its iteration. After the second, which follows by itself, it stops
    immediately. In both cases, it closes its components and the world, and prints a summary.
    """

    def __init__(self, child: "subprocess.Popen[str]", watcher: TracePrinter) -> None:
        self.received: int | None = None
        self._is_repeated = False
        self._child = child
        self._printer = watcher
        self._has_ended = threading.Event()
        self._waiter: threading.Thread | None = None

    @contextlib.contextmanager
    def forwarding(self) -> Iterator[None]:
        """Handle signals inside the context."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.signal(number, self._on_signal) for number in _forwarded_signals()}
        try:
            yield
        finally:
            self._has_ended.set()
            for number, handler in before.items():
                signal.signal(number, handler)
            if self._waiter is not None:
                self._waiter.join(_SHUTDOWN_TIMEOUT_S)

    def _on_signal(self, number: int, _frame: FrameType | None) -> None:
        if self._is_repeated:
            _kill(self._child)
        elif self.received is not None:
            self._repeat(number)
        else:
            self.received = number
            self._child.send_signal(number)
            # The interrupted code may hold the lock of the output stream, so write from another thread.
            self._waiter = threading.Thread(target=self._wait_for_end, args=(number,), daemon=True)
            self._waiter.start()

    def _repeat(self, number: int) -> None:
        self._is_repeated = True
        self._child.send_signal(number)

    def _wait_for_end(self, number: int) -> None:
        self._printer.show_notice("stopping after this iteration; press Ctrl-C again to stop immediately")
        if not self._has_ended.wait(_INTERRUPT_TIMEOUT_S) and not self._is_repeated:
            self._repeat(number)
        if not self._has_ended.wait(_INTERRUPT_TIMEOUT_S) and self._child.returncode is None:
            self._printer.show_notice("the program did not stop and was killed")
            _kill(self._child)


def _forwarded_signals() -> list[int]:
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    return [number for number in numbers if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN]


def _kill(child: "subprocess.Popen[str]") -> None:
    """Kill a program and its children, which could keep its output open."""
    if child.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGKILL)


def _terminate(child: "subprocess.Popen[str]") -> None:
    """Close the output, whose reader has ended, and let the program close its components."""
    if child.stdout is not None:
        child.stdout.close()
    if child.poll() is None:
        child.terminate()
        try:
            child.wait(_SHUTDOWN_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()


def _start_stderr_reader(stream: IO[str], watcher: TracePrinter) -> threading.Thread:
    def read() -> None:
        for line in stream:
            watcher.show_text(line.rstrip("\n"))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    return thread


def _format_frequency(hertz: float | None) -> str:
    return f"{hertz:9.2f}" if hertz else f"{'-':>9}"


def _format_value(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else "-" if value is None else str(value)
