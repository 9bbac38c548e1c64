"""Reads the stream of a running component: changes of state as lines, a summary at the end."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import FrameType
from typing import IO, Any, Protocol

_SHUTDOWN_TIMEOUT_S = 5.0
_INTERRUPT_TIMEOUT_S = 2.0
_FAILED = 2
_INTERRUPTED = 130

TraceRecord = Mapping[str, Any]
"""One line of the stream, read from JSON."""


class TracePrinter(Protocol):
    """Shows a run to somebody."""

    def show_iteration(self, record: TraceRecord, changes: list[str], /) -> None:
        """An iteration has passed; `changes` tells the changes of state in it."""

    def show_text(self, text: str) -> None:
        """The component, or its runtime, said something."""

    def show_notice(self, text: str) -> None:
        """We have something to say ourselves; another thread may call this."""

    def close(self) -> None:
        """Nothing more comes but the summary."""


class PlainTracePrinter:
    """One line a change of state."""

    def show_iteration(self, _record: TraceRecord, changes: list[str], /) -> None:
        """Print the changes."""
        for change in changes:
            print(change, flush=True)

    def show_text(self, text: str) -> None:
        """Print it between them."""
        print(text, flush=True)

    def show_notice(self, text: str) -> None:
        """Keep it out of what may be read by a program."""
        print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        """Nothing to clear away."""


def follow_process(child: "subprocess.Popen[str]", printer: TracePrinter) -> int:
    """Show a process until it ends, pass an interrupt on to it, print the summary; returns the exit code.

    The process must lead a session of its own.
    """
    assert child.stdout is not None
    changes, ending = StateChangeTracker(), _RunOutcome()
    interrupt = _InterruptForwarder(child, printer)
    reader = _start_stderr_reader(child.stderr, printer) if child.stderr is not None else None
    try:
        with interrupt.forwarding():
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
    return _INTERRUPTED if interrupt.was_received else _exit_code(child.returncode, ending)


class StateChangeTracker:
    """Remembers the state of every component, and tells what is new."""

    def __init__(self) -> None:
        """Nothing is known of any component."""
        self._states: dict[str, str] = {}

    def describe_changes(self, record: TraceRecord) -> list[str]:
        """The changes of state in an iteration, a line each."""
        return [line for step in record["tree"] for line in self._describe_step(step, record["time_ns"] / 1e9)]

    def _describe_step(self, step: TraceRecord, time_s: float) -> list[str]:
        component, state = step["component"], step["state"]
        before = step["changed_from"] or self._states.get(component)
        self._states[component] = state
        if not state or before == state:
            return []
        cause = f"  ({step['transition']})" if step["transition"] else ""
        arrow = f"{before} → {state}" if before else state
        return [f"{time_s:8.2f} s  {component}: {arrow}{cause}"]


def describe_world(world: object) -> str:
    """What a world says of itself, in one line."""
    if not isinstance(world, Mapping):
        return "" if world is None else str(world)
    return "  ".join(f"{name} {_format_value(value)}" for name, value in world.items())


def describe_summary(summary: TraceRecord) -> str:
    """The end of a run: how it ended, what the world says, cycle times, errors."""
    passed = f"{summary['time_ns'] / 1e9:.2f} s in {summary['iterations']} iterations"
    lines = ["", f"{passed}, stopped: {summary['stopped']}, last state: {summary['state'] or '-'}"]
    if summary.get("world") is not None:
        lines.append(f"world: {describe_world(summary['world'])}")
    times: Mapping[str, TraceRecord] = summary.get("cycle_times") or {}
    if times:
        width = max(len(name) for name in times)
        lines.append(f"{'component':{max(width, 9)}}    works   mean ms    max ms        Hz")
        for name, each in times.items():
            figures = f"{each['mean_ms']:9.3f} {each['max_ms']:9.3f} {each['real_frequency_hz']:9.2f}"
            lines.append(f"{name:{max(width, 9)}} {each['count']:8} {figures}")
    lines.append(f"errors: {summary['errors']}")
    return "\n".join(lines) + "\n"


@dataclass(slots=True)
class _RunOutcome:
    """What a program said last: a summary, or that it failed. One that ends itself says neither."""

    summary: TraceRecord | None = None
    has_failed: bool = False


def _exit_code(code: int, ending: _RunOutcome) -> int:
    """Turn the exit code of a program into ours; an end that nobody asked for is told."""
    if ending.has_failed:
        return _FAILED
    if ending.summary is None:
        cause = f"by itself with exit code {code}" if code >= 0 else f"by signal {signal.Signals(-code).name}"
        print(f"the program ended {cause}", file=sys.stderr)
        return 1
    return code if code in (1, _INTERRUPTED) else int(ending.summary["errors"] > 0 or code != 0)


def _show_line(line: str, changes: StateChangeTracker, watcher: TracePrinter, ending: _RunOutcome) -> None:
    """Show a line of the stream, or note that it tells the end."""
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
        # Hand-written code may print what it likes.
        watcher.show_text(line.rstrip("\n"))


class _InterruptForwarder:
    """Passes Ctrl-C on to a program, which then ends its iteration and tells its summary, or is ended."""

    def __init__(self, child: "subprocess.Popen[str]", watcher: TracePrinter) -> None:
        self.was_received = False
        self._child = child
        self._printer = watcher
        self._has_ended = threading.Event()
        self._waiter: threading.Thread | None = None

    @contextlib.contextmanager
    def forwarding(self) -> Iterator[None]:
        """While inside, Ctrl-C does not end us."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = signal.signal(signal.SIGINT, self._on_signal)
        try:
            yield
        finally:
            self._has_ended.set()
            signal.signal(signal.SIGINT, before)
            if self._waiter is not None:
                self._waiter.join(_SHUTDOWN_TIMEOUT_S)

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        if self.was_received:
            _kill(self._child)
            return
        self.was_received = True
        self._child.send_signal(signal.SIGINT)
        # What a signal came in the middle of may hold the lock of the very stream that we would write to.
        self._waiter = threading.Thread(target=self._wait_for_answer, daemon=True)
        self._waiter.start()

    def _wait_for_answer(self) -> None:
        self._printer.show_notice("stopping after this iteration; press Ctrl-C again to end at once")
        if not self._has_ended.wait(_INTERRUPT_TIMEOUT_S) and self._child.returncode is None:
            self._printer.show_notice("it did not stop, and was ended")
            _kill(self._child)


def _kill(child: "subprocess.Popen[str]") -> None:
    """End a program and all that it started: who still held its output would keep us waiting."""
    if child.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGKILL)


def _terminate(child: "subprocess.Popen[str]") -> None:
    """Leave no process behind, whatever happened."""
    if child.poll() is None:
        child.terminate()
        try:
            child.wait(_SHUTDOWN_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()
    if child.stdout is not None:
        child.stdout.close()


def _start_stderr_reader(stream: IO[str], watcher: TracePrinter) -> threading.Thread:
    def read() -> None:
        for line in stream:
            watcher.show_text(line.rstrip("\n"))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    return thread


def _format_value(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else "-" if value is None else str(value)
