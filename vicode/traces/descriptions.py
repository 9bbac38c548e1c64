"""Describes records of runs in words: changes of states, worlds, and the summary at the end."""

import textwrap
from collections.abc import Mapping
from typing import Any

from vicode.findings import escape_text

TraceRecord = Mapping[str, Any]
"""One parsed line of a trace or of the live protocol."""


class StateChangeTracker:
    """Describes state changes between iterations."""

    def __init__(self) -> None:
        self._states: dict[str, str] = {}

    def describe_changes(self, record: TraceRecord) -> list[str]:
        """Describe the state changes of an iteration, one per line."""
        return [line for step in record["tree"] for line in self._describe_step(step, record["time_ns"])]

    def _describe_step(self, step: TraceRecord, time_ns: int) -> list[str]:
        component, state = step["component"], step["state"]
        before = step["changed_from"] or self._states.get(component)
        self._states[component] = state
        if not state or before == state:
            return []
        arrow = f"{before} → {state}" if before else state
        return [_line(time_ns, f"{component}: {arrow}{_cause(step)}")]


def describe_message(message: TraceRecord, *, is_first: bool) -> list[str]:
    """Describe a message of the live protocol, one line for each change.

    Args:
        message: An iteration of a watched robot.
        is_first: Whether it is the first of its robot: then the active states are listed.
    """
    if is_first:
        active = [step for step in message["tree"] if step["state"]]
        lines = [_line(message["time_ns"], f"{step['component']}: {step['state']}") for step in active]
    else:
        lines = [
            _line(each["time_ns"], f"{each['component']}: {each['source']} → {each['target']}{_cause(each)}")
            for each in message.get("changes", ())
        ]
    for error in message.get("errors", ()):
        lines.append(_line(message["time_ns"], f"error in {error.get('component')}: {error.get('message')}"))
    return lines


def describe_world(world: object) -> str:
    if not isinstance(world, Mapping):
        return "" if world is None else str(world)
    return "  ".join(f"{name} {_format_value(value)}" for name, value in world.items())


def describe_summary(summary: TraceRecord, width: int | None = None) -> str:
    """Format the summary of a run: cause of the end, world, cycle times, errors.

    Args:
        summary: The last record of the run.
        width: The number of columns at which the line of the world is wrapped; None: it is not wrapped.
    """
    passed = f"{summary['time_ns'] / 1e9:.2f} s in {summary['iterations']} iterations"
    lines = ["", f"{passed}, stopped: {summary['stopped']}, last state: {summary['state'] or '-'}"]
    if summary.get("world") is not None:
        line = f"world: {describe_world(summary['world'])}"
        lines += textwrap.wrap(line, width, subsequent_indent="       ") if width else [line]
    times: Mapping[str, TraceRecord] = summary.get("cycle_times") or {}
    if times:
        name_width = max(9, *(len(name) for name in times))
        lines.append(f"{'component':{name_width}}    works   mean ms    max ms target Hz   real Hz")
        for name, each in times.items():
            figures = f"{each['mean_ms']:9.3f} {each['max_ms']:9.3f}"
            figures += f" {_format_frequency(each.get('target_hz'))} {_format_frequency(each['real_frequency_hz'])}"
            lines.append(f"{name:{name_width}} {each['count']:8} {figures}")
    if "missed_cycles" in summary:
        latency = f"{summary['latency_mean_ms']:.3g} ms, at most {summary['latency_max_ms']:.3g} ms"
        lines.append(f"missed cycles: {summary['missed_cycles']} of {summary['cycles']}")
        lines.append(f"commands: sent {latency} after the inputs")
    if "overruns" in summary:
        tick = f"{summary['tick_ms']:.4g} ms"
        lines.append(f"overruns: {summary['overruns']} iterations took longer than the tick of {tick}")
    lines.append(f"errors: {summary['errors']}")
    return "\n".join(lines) + "\n"


def _line(time_ns: int, words: str) -> str:
    return escape_text(f"{time_ns / 1e9:8.2f} s  {words}")


def _cause(change: TraceRecord) -> str:
    return f"  ({change['transition']})" if change["transition"] else ""


def _format_frequency(hertz: float | None) -> str:
    return f"{hertz:9.2f}" if hertz else f"{'-':>9}"


def _format_value(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else "-" if value is None else str(value)
