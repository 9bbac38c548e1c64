"""Reads the stream of a running component: changes of state as lines, a summary at the end."""

import contextlib
import json
import signal
import subprocess
import threading
from collections.abc import Iterator, Mapping
from typing import IO, Any, Protocol

_PATIENCE_S = 5.0

Record = Mapping[str, Any]
"""One line of the stream, read from JSON."""


class Watcher(Protocol):
    """Shows a run to somebody."""

    def show_iteration(self, record: Record, changes: list[str], /) -> None:
        """An iteration has passed; `changes` tells the changes of state in it."""

    def show_text(self, text: str) -> None:
        """The component, or its runtime, said something."""

    def close(self) -> None:
        """Nothing more comes but the summary."""


class PlainWatcher:
    """One line a change of state."""

    def show_iteration(self, _record: Record, changes: list[str], /) -> None:
        """Print the changes."""
        for change in changes:
            print(change, flush=True)

    def show_text(self, text: str) -> None:
        """Print it between them."""
        print(text, flush=True)

    def close(self) -> None:
        """Nothing to clear away."""


def follow(child: "subprocess.Popen[str]", watcher: Watcher) -> int:
    """Show a process until it ends, pass an interrupt on to it, print the summary; returns the exit code."""
    assert child.stdout is not None
    changes = Changes()
    summary: Record | None = None
    reader = _follow_errors(child.stderr, watcher) if child.stderr is not None else None
    try:
        with _passing_interrupt_to(child):
            for line in child.stdout:
                summary = _show(line, changes, watcher) or summary
            child.wait()
    finally:
        _end(child)
        if reader is not None:
            reader.join(_PATIENCE_S)
        watcher.close()
    if summary is not None:
        print(describe_summary(summary), end="")
    has_errors = summary is not None and summary["errors"] > 0
    return child.returncode if child.returncode in (1, 2, 130) else int(has_errors or child.returncode != 0)


class Changes:
    """Remembers the state of every component, and tells what is new."""

    def __init__(self) -> None:
        """Nothing is known of any component."""
        self._states: dict[str, str] = {}

    def lines_of(self, record: Record) -> list[str]:
        """The changes of state in an iteration, a line each."""
        return [line for step in record["tree"] for line in self._lines_of(step, record["time_ns"] / 1e9)]

    def _lines_of(self, step: Record, time_s: float) -> list[str]:
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
    return "  ".join(f"{name} {_shown(value)}" for name, value in world.items())


def describe_summary(summary: Record) -> str:
    """The end of a run: how it ended, what the world says, cycle times, errors."""
    passed = f"{summary['time_ns'] / 1e9:.2f} s in {summary['iterations']} iterations"
    lines = ["", f"{passed}, stopped: {summary['stopped']}, last state: {summary['state'] or '-'}"]
    if summary.get("world") is not None:
        lines.append(f"world: {describe_world(summary['world'])}")
    times: Mapping[str, Record] = summary.get("cycle_times") or {}
    if times:
        width = max(len(name) for name in times)
        lines.append(f"{'component':{max(width, 9)}}    works   mean ms    max ms        Hz")
        for name, each in times.items():
            figures = f"{each['mean_ms']:9.3f} {each['max_ms']:9.3f} {each['real_frequency_hz']:9.2f}"
            lines.append(f"{name:{max(width, 9)}} {each['count']:8} {figures}")
    lines.append(f"errors: {summary['errors']}")
    return "\n".join(lines) + "\n"


def _show(line: str, changes: Changes, watcher: Watcher) -> Record | None:
    """Show a line of the stream; returns the summary if it is that."""
    try:
        record = json.loads(line)
    except ValueError:
        record = None
    if isinstance(record, dict) and "summary" in record:
        summary: Record = record["summary"]
        return summary
    if isinstance(record, dict) and "tree" in record:
        watcher.show_iteration(record, changes.lines_of(record))
    else:
        # Hand-written code may print what it likes.
        watcher.show_text(line.rstrip("\n"))
    return None


@contextlib.contextmanager
def _passing_interrupt_to(child: "subprocess.Popen[str]") -> Iterator[None]:
    """While inside, Ctrl-C goes to the child, which then ends its iteration and tells its summary."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, lambda _number, _frame: child.send_signal(signal.SIGINT))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _end(child: "subprocess.Popen[str]") -> None:
    """Leave no process behind, whatever happened."""
    if child.poll() is None:
        child.terminate()
        try:
            child.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()
    if child.stdout is not None:
        child.stdout.close()


def _follow_errors(stream: IO[str], watcher: Watcher) -> threading.Thread:
    def read() -> None:
        for line in stream:
            watcher.show_text(line.rstrip("\n"))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    return thread


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else "-" if value is None else str(value)
