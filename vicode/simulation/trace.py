"""Reads traces (docs/traces.md): JSON lines that the runtime and the XABSL engine write."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vicode.simulation.messages import IterationResult, ProtocolError, decode_iteration

VERSION = 1


class TraceError(ValueError):
    """The text is not a trace; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trace:
    """A recorded run; `runtime` names the writer, and `summary` is None if the run did not end by itself."""

    runtime: str
    iterations: tuple[IterationResult, ...]
    summary: dict[str, Any] | None


def trace_schema() -> dict[str, Any]:
    """The JSON Schema of one line of a trace."""
    schema: dict[str, Any] = json.loads(Path(__file__).with_name("trace.schema.json").read_text(encoding="utf-8"))
    return schema


def read_trace(text: str, max_iterations: int | None = None) -> Trace:
    """Read a trace, at most the first `max_iterations`.

    Raises:
        TraceError: A line is not part of a trace, or the trace has another version.
    """
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
    header = _parse(*lines[0]) if lines else {}
    if "vicode-trace" not in header:
        raise TraceError("this is not a trace: its first line is no header; record one with vicode run --trace FILE")
    if header["vicode-trace"] != VERSION:
        raise TraceError(
            f"this trace has version {str(header['vicode-trace'])[:20]}; this vicode reads version {VERSION}"
        )
    iterations: list[IterationResult] = []
    summary = None
    for number, line in lines[1:]:
        record = _parse(number, line)
        if isinstance(record.get("summary"), dict):
            summary = record["summary"]
        elif max_iterations is None or len(iterations) < max_iterations:
            iterations.append(_iteration(number, record))
    if not iterations:
        raise TraceError("the trace has no iterations")
    return Trace(runtime=str(header.get("runtime", "")), iterations=tuple(iterations), summary=summary)


def _iteration(number: int, record: dict[str, Any]) -> IterationResult:
    try:
        return decode_iteration(record)
    except ProtocolError as error:
        raise TraceError(f"line {number} is not an iteration record: {error}") from error


def _parse(number: int, line: str) -> dict[str, Any]:
    try:
        record = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise TraceError(f"line {number} is not JSON") from error
    if not isinstance(record, dict):
        raise TraceError(f"line {number} is not an iteration record")
    return record
