"""Reads traces (docs/traces.md): JSON lines that the runtime and the XABSL engine write."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vicode.bica.recorder import find_segments, split_segment
from vicode.simulation.messages import IterationResult, ProtocolError, decode_iteration

VERSION = 1


class TraceError(ValueError):
    """The text is not a trace; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceFiles:
    """A trace on the disk, read in pieces; a record of a robot has several files."""

    files: tuple[Path, ...]
    header: dict[str, Any]

    def iterations(self) -> Iterator[IterationResult]:
        """Read the iterations one by one.

        Raises:
            TraceError: A line is not part of a trace.
        """
        is_empty = True
        for file in self.files:
            for number, line in _complete_lines(file):
                record = _parse(number, line)
                if "summary" not in record and "vicode-trace" not in record:
                    is_empty = False
                    yield _iteration(number, record)
        if is_empty:
            raise TraceError("the trace has no iterations")


def open_trace(path: Path) -> TraceFiles:
    """Open a trace, or the latest run of a record (`Root.record`) by its name.

    Raises:
        TraceError: It is not a trace.
        OSError: It does not exist or cannot be read.
    """
    runs = {} if path.is_file() else find_segments(path)
    files = tuple(runs[max(runs)]) if runs else (path,)
    with files[0].open("rb") as stream:
        line = stream.readline(10_000)
    header = _parse_header(1, line.decode(errors="replace"))
    return TraceFiles(files=files, header=header)


def open_runs(paths: Iterable[Path]) -> list[TraceFiles]:
    """Open traces and records, one for each run: segments of one run that are given by themselves belong together.

    Raises:
        TraceError: A path is no trace; the message names it.
        OSError: A path does not exist or cannot be read.
    """
    runs: dict[object, list[TraceFiles]] = {}
    for number, path in enumerate(paths):
        try:
            trace = open_trace(path)
        except TraceError as error:
            raise TraceError(f"{path}: {error}") from error
        place = split_segment(path.resolve()) if "segment" in trace.header and len(trace.files) == 1 else None
        runs.setdefault(number if place is None else place[:2], []).append(trace)
    return [_join(traces) for traces in runs.values()]


def _join(traces: list[TraceFiles]) -> TraceFiles:
    """The trace of a run, of which segments are given."""
    if len(traces) == 1:
        return traces[0]
    files = sorted({file for trace in traces for file in trace.files}, key=_segment_number)
    return TraceFiles(files=tuple(files), header=traces[0].header)


def _segment_number(file: Path) -> int:
    place = split_segment(file)
    return place[2] if place is not None else 0


def _complete_lines(file: Path) -> Iterator[tuple[int, str]]:
    """The numbered lines of a file; a last line without an end was cut off by a crash and is left out."""
    with file.open(encoding="utf-8", errors="replace", newline="\n") as stream:
        for number, line in enumerate(stream, start=1):
            if line.strip() and (line.endswith("\n") or _is_json(line)):
                yield number, line


def _is_json(line: str) -> bool:
    try:
        json.loads(line)
    except (ValueError, RecursionError):
        return False
    return True


def trace_schema() -> dict[str, Any]:
    """The JSON Schema of one line of a trace."""
    schema: dict[str, Any] = json.loads(Path(__file__).with_name("trace.schema.json").read_text(encoding="utf-8"))
    return schema


def read_trace(text: str, max_iterations: int | None = None) -> tuple[IterationResult, ...]:
    """Read the iterations of a trace, at most the first `max_iterations`.

    Raises:
        TraceError: A line is not part of a trace, or the trace has another version.
    """
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
    _parse_header(*lines[0] if lines else (1, "{}"))
    iterations: list[IterationResult] = []
    for number, line in lines[1:]:
        record = _parse(number, line)
        is_summary = isinstance(record.get("summary"), dict)
        if not is_summary and (max_iterations is None or len(iterations) < max_iterations):
            iterations.append(_iteration(number, record))
    if not iterations:
        raise TraceError("the trace has no iterations")
    return tuple(iterations)


def _parse_header(number: int, line: str) -> dict[str, Any]:
    header = _parse(number, line)
    if "vicode-trace" not in header:
        raise TraceError("this is not a trace: its first line is no header; record one with vicode run --trace FILE")
    if header["vicode-trace"] != VERSION:
        raise TraceError(
            f"this trace has version {str(header['vicode-trace'])[:20]}; this vicode reads version {VERSION}"
        )
    return header


def decode_line(number: int, line: bytes) -> IterationResult:
    """Decode the line of an iteration.

    Raises:
        TraceError: It is not an iteration record.
    """
    return _iteration(number, _parse(number, line.decode(errors="replace")))


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
