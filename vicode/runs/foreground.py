"""Runs a program in the foreground: shows its trace stream, forwards signals, and finds out how it ended."""

import contextlib
import json
import signal
import subprocess
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from types import FrameType
from typing import IO, Protocol

from vicode.bica.run import EXIT_OUTPUT_LOST
from vicode.platform import end_signals, kill_session, send_end_signal
from vicode.traces.descriptions import StateChangeTracker, TraceRecord

_SHUTDOWN_TIMEOUT_S = 5.0
_INTERRUPT_TIMEOUT_S = 2.0
_FAILED = 2


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


@dataclass(slots=True, kw_only=True)
class RunEnd:
    """How a program ended.

    `summary` is its last record, None if it failed or exited by itself. `problem` describes an unexpected exit.
    """

    exit_code: int = 0
    summary: TraceRecord | None = None
    has_failed: bool = False
    problem: str = ""


def follow_process(child: "subprocess.Popen[str]", printer: TracePrinter) -> RunEnd:
    """Display a process until it ends, and forward signals; the process must be a session leader."""
    assert child.stdout is not None
    changes, ending = StateChangeTracker(), RunEnd()
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
    if signals.received is not None and child.returncode != EXIT_OUTPUT_LOST:
        ending.exit_code = 128 + signals.received
    else:
        _set_exit_code(ending, child.returncode)
    return ending


def _set_exit_code(ending: RunEnd, code: int) -> None:
    """Convert the exit code of the program, and describe an unexpected one."""
    if code == EXIT_OUTPUT_LOST:
        ending.exit_code = code
    elif ending.has_failed:
        ending.exit_code = _FAILED
    elif ending.summary is None:
        cause = f"unexpectedly with exit code {code}" if code >= 0 else f"by signal {signal.Signals(-code).name}"
        ending.exit_code, ending.problem = 1, f"the program ended {cause}"
    else:
        ending.exit_code = code if code == 1 or code > 128 else int(ending.summary["errors"] > 0 or code != 0)


def _show_line(line: str, changes: StateChangeTracker, printer: TracePrinter, ending: RunEnd) -> None:
    try:
        record = json.loads(line)
    except ValueError:
        record = None
    if isinstance(record, dict) and "summary" in record:
        ending.summary = record["summary"]
    elif isinstance(record, dict) and "failed" in record:
        ending.has_failed = True
    elif isinstance(record, dict) and "tree" in record:
        printer.show_iteration(record, changes.describe_changes(record))
    else:
        # Output of hand-written code.
        printer.show_text(line.rstrip("\n"))


class _SignalForwarder:
    """Forwards Ctrl-C, SIGTERM and SIGHUP to a program and kills it if it does not end.

    After the first signal, the program finishes its iteration. After the second, which follows by itself, it stops
    immediately. In both cases, it closes its components and the world, and prints a summary.
    """

    def __init__(self, child: "subprocess.Popen[str]", printer: TracePrinter) -> None:
        self.received: int | None = None
        self._is_repeated = False
        self._child = child
        self._printer = printer
        self._has_ended = threading.Event()
        self._waiter: threading.Thread | None = None

    @contextlib.contextmanager
    def forwarding(self) -> Iterator[None]:
        """Handle signals inside the context."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.signal(number, self._on_signal) for number in end_signals()}
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
            kill_group(self._child)
        elif self.received is not None:
            self._repeat(number)
        else:
            self.received = number
            send_end_signal(self._child, number)
            # The interrupted code may hold the lock of the output stream, so write from another thread.
            self._waiter = threading.Thread(target=self._wait_for_end, args=(number,), daemon=True)
            self._waiter.start()

    def _repeat(self, number: int) -> None:
        self._is_repeated = True
        send_end_signal(self._child, number)

    def _wait_for_end(self, number: int) -> None:
        self._printer.show_notice("stopping after this iteration; press Ctrl-C again to stop immediately")
        if not self._has_ended.wait(_INTERRUPT_TIMEOUT_S) and not self._is_repeated:
            self._repeat(number)
        if not self._has_ended.wait(_INTERRUPT_TIMEOUT_S) and self._child.returncode is None:
            self._printer.show_notice("the program did not stop and was killed")
            kill_group(self._child)


def kill_group(child: "subprocess.Popen[str]") -> None:
    """Kill a program and its children, which could keep its output open."""
    if child.returncode is None:
        kill_session(child.pid)


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


def _start_stderr_reader(stream: IO[str], printer: TracePrinter) -> threading.Thread:
    def read() -> None:
        for line in stream:
            printer.show_text(line.rstrip("\n"))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    return thread
