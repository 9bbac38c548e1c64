"""Index of a long trace: where each iteration begins, with times, states and values, in a cache of the user."""

from __future__ import annotations

import hashlib
import json
import math
import os
import tempfile
import time
from array import array
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

from vicode.simulation.messages import IterationResult
from vicode.traces.reader import TraceError, TraceFiles, decode_line

_VERSION = 1
_MAX_CELLS = 24_000_000
"""Limit of values by iterations: about 100 MB."""
_MAX_COLUMNS = 400
_CACHED_INDEXES = 20
_ABANDONED_S = 3600.0
_PROGRESS_LINES = 2_000

RootStep = tuple[str, str | None, str | None]
"""State, left state, and id of the transition of the root component."""


@dataclass(slots=True, kw_only=True)
class TraceIndex:
    """One entry per iteration; `steps` are indices into `step_table`. Columns are shorter where values are missing."""

    files: tuple[Path, ...]
    file_starts: array[int] = field(default_factory=lambda: array("Q"))
    """The number of iterations before each file."""
    offsets: array[int] = field(default_factory=lambda: array("Q"))
    times_ns: array[int] = field(default_factory=lambda: array("q"))
    steps: array[int] = field(default_factory=lambda: array("L"))
    with_output: array[int] = field(default_factory=lambda: array("Q"))
    step_table: list[RootStep] = field(default_factory=list)
    columns: dict[str, array[float]] = field(default_factory=dict)
    root: str = ""

    def __len__(self) -> int:
        return len(self.offsets)

    def read(self, index: int) -> IterationResult:
        """Read one iteration.

        Raises:
            TraceError: The file has changed.
            OSError: It cannot be read.
        """
        file = max(number for number, start in enumerate(self.file_starts) if start <= index)
        with self.files[file].open("rb") as stream:
            stream.seek(self.offsets[index])
            return decode_line(0, stream.readline())


def load_index(trace: TraceFiles, on_progress: Callable[[float], None] = lambda _part: None) -> TraceIndex:
    """Load the index of a trace from the cache, or build it.

    Args:
        trace: The trace.
        on_progress: Called with the part that has been read, from 0 to 1.

    Raises:
        TraceError: A line is not part of a trace.
        OSError: A file cannot be read.
    """
    cache = _cache_file(trace.files)
    with suppress(OSError, ValueError, KeyError, EOFError, TypeError):
        return _read_cache(cache, trace.files)
    index = _build(trace.files, on_progress)
    with suppress(OSError):
        _write_cache(cache, index)
    return index


def _build(files: tuple[Path, ...], on_progress: Callable[[float], None]) -> TraceIndex:
    index = TraceIndex(files=files)
    known_steps: dict[RootStep, int] = {}
    total, done = sum(file.stat().st_size for file in files) or 1, 0
    for file in files:
        index.file_starts.append(len(index))
        with file.open("rb") as stream:
            offset = 0
            for number, line in enumerate(stream, start=1):
                if line.endswith(b"\n") and line.strip():
                    _add_line(index, known_steps, (number, offset), line)
                offset += len(line)
                if number % _PROGRESS_LINES == 0:
                    on_progress((done + offset) / total)
        done += offset
    if not len(index):
        raise TraceError("the trace has no iterations")
    return index


def _add_line(index: TraceIndex, known_steps: dict[RootStep, int], place: tuple[int, int], line: bytes) -> None:
    number, offset = place
    try:
        record = json.loads(line)
        if "summary" in record or "vicode-trace" in record:
            return
        root = record["tree"][0]
        time_ns, component = int(record["time_ns"]), str(root["component"])
        step = (str(root["state"]), root.get("changed_from"), root.get("transition"))
        steps = record["tree"]
        values = [(str(each["component"]), each.get("values")) for each in steps if each.get("values")]
    except (ValueError, KeyError, IndexError, TypeError, RecursionError) as error:
        raise TraceError(f"line {number} is not an iteration record") from error
    index.root = index.root or component
    if component != index.root:
        raise TraceError(f"line {number} is an iteration of {component[:60]}, not of {index.root[:60]}")
    entry = len(index.offsets)
    index.offsets.append(offset)
    index.times_ns.append(time_ns)
    if step not in known_steps:
        known_steps[step] = len(index.step_table)
        index.step_table.append(step)
    index.steps.append(known_steps[step])
    if record.get("errors") or record.get("prints"):
        index.with_output.append(entry + 1)
    for name, known in (*values, *record.get("inputs", {}).items()):
        _add_values(index, entry, name, known)


def _add_values(index: TraceIndex, entry: int, component: str, values: dict[str, Any]) -> None:
    columns = index.columns
    for name, value in values.items():
        if not isinstance(value, int | float):
            continue
        key = f"{component}.{name}"
        column = columns.get(key)
        if column is None:
            if len(columns) >= _MAX_COLUMNS or len(columns) * entry > _MAX_CELLS:
                continue
            column = columns[key] = array("f")
        missing = entry - len(column)
        if missing > 0:
            column.extend([math.nan] * missing)
        with suppress(OverflowError):
            if missing < 0:
                # If a component is stepped twice in an iteration, the later value counts.
                column[entry] = value
            else:
                column.append(value)


_ARRAYS = ("file_starts", "offsets", "times_ns", "steps", "with_output")


def _cache_file(files: tuple[Path, ...]) -> Path:
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    name = hashlib.sha256(repr(_identity(files)).encode()).hexdigest()[:24]
    return base / "vicode" / "traces" / f"{name}.index"


def _identity(files: tuple[Path, ...]) -> list[list[str | int]]:
    stats = ((file, file.stat()) for file in files)
    return [[str(file.resolve()), stat.st_size, stat.st_mtime_ns] for file, stat in stats]


def _write_cache(cache: Path, index: TraceIndex) -> None:
    """Write the index as a line of JSON and arrays; keep only the newest indexes."""
    cache.parent.mkdir(parents=True, exist_ok=True)
    arrays = [getattr(index, name) for name in _ARRAYS] + list(index.columns.values())
    header = {
        "version": _VERSION,
        "identity": _identity(index.files),
        "root": index.root,
        "steps": index.step_table,
        "columns": list(index.columns),
        "lengths": [len(each) for each in arrays],
    }
    with tempfile.NamedTemporaryFile(dir=cache.parent, suffix=".new", delete=False) as stream:
        stream.write(json.dumps(header).encode() + b"\n")
        for each in arrays:
            each.tofile(stream)
    Path(stream.name).replace(cache)
    abandoned = (file for file in cache.parent.glob("*.new") if time.time() - file.stat().st_mtime > _ABANDONED_S)
    known = sorted(cache.parent.glob("*.index"), key=lambda file: file.stat().st_mtime_ns)
    for old in (*known[:-_CACHED_INDEXES], *abandoned):
        old.unlink(missing_ok=True)


def _read_cache(cache: Path, files: tuple[Path, ...]) -> TraceIndex:
    with cache.open("rb") as stream:
        header = json.loads(stream.readline())
        if header["version"] != _VERSION or header["identity"] != _identity(files):
            raise ValueError("another version or file")
        index = TraceIndex(files=files, root=header["root"], step_table=[tuple(each) for each in header["steps"]])
        lengths = iter(header["lengths"])
        for name in _ARRAYS:
            _fill(getattr(index, name), stream, next(lengths))
        for name in header["columns"]:
            _fill(index.columns.setdefault(name, array("f")), stream, next(lengths))
    return index


def _fill(target: array[Any], stream: BinaryIO, length: int) -> None:
    target.fromfile(stream, length)
