"""A long trace as a recording: only the index is in memory, iterations are read when they are shown."""

import math
import os
import re
from array import array
from bisect import bisect_right
from collections.abc import Callable
from itertools import islice
from pathlib import Path

from vicode.model.design import Design
from vicode.runs.design_trace import TransitionKeys, require_root
from vicode.runs.recording import MAX_ITERATIONS, Recording
from vicode.simulation import IterationResult
from vicode.traces.index import TraceIndex, load_index
from vicode.traces.reader import TraceError, open_trace

_SUFFIXES = (".jsonl", ".trace")
_SEGMENT = re.compile(r"\.\d+\.\d{6,}\.(?=[^.]+$)")
_MAX_LISTED = 100


class TraceRecording(Recording):
    """The recording of a trace that is not changed."""

    def __init__(self, index: TraceIndex, design: Design) -> None:
        super().__init__()
        if index.root != design.component:
            raise TraceError(f"this is a trace of {index.root[:60]}, not of {design.component}")
        self._index = index
        self._keys = TransitionKeys(design)
        table = [(state, self._keys.find(left, state, given) or "") for state, left, given in index.step_table]
        self.states = [table[number][0] for number in index.steps]
        self.transitions = [table[number][1] for number in index.steps]
        self.times_ns = list(index.times_ns)

    def __len__(self) -> int:
        return len(self._index)

    @property
    def is_full(self) -> bool:
        return True

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._index.columns)

    def iteration(self, number: int) -> IterationResult | None:
        if not 0 < number <= len(self):
            return None
        return self._keys.complete(self._index.read(number - 1))

    def column(self, name: str) -> "array[float]":
        column = self._index.columns.get(name, array("f"))
        missing = len(self) - len(column) if column else 0
        return column + array("f", [math.nan]) * missing

    def iterations_with_output(self, number: int, limit: int) -> list[int]:
        end = bisect_right(self._index.with_output, number)
        return list(self._index.with_output[max(0, end - limit) : end])


def read_recording(
    path: Path, design: Design, on_progress: Callable[[float], None] = lambda _part: None
) -> TraceRecording:
    """Open a trace or a robot's record of any length.

    Raises:
        TraceError: It is not a trace, or it is a trace of another component.
        OSError: It cannot be read.
    """
    return TraceRecording(load_index(open_trace(path), on_progress), design)


def read_beginning(path: Path, design: Design) -> tuple[IterationResult, ...]:
    """The first iterations of a trace, as many as a simulation records.

    Raises:
        TraceError: It is not a trace, or it is a trace of another component.
        OSError: It cannot be read.
    """
    iterations = tuple(islice(open_trace(path).iterations(), MAX_ITERATIONS))
    require_root(iterations, design)
    return iterations


def find_traces(folder: Path) -> tuple[str, ...]:
    """The traces and records in a folder, relative to it, the newest first; of a record the name of its latest run."""
    found: dict[Path, float] = {}
    for parent, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith((".", "_", "node_modules"))]
        for name in files:
            if name.endswith(_SUFFIXES):
                path = Path(parent, _SEGMENT.sub(".", name))
                found[path] = max(found.get(path, 0.0), Path(parent, name).stat().st_mtime)
    newest = sorted(found, key=lambda path: -found[path])[:_MAX_LISTED]
    return tuple(path.relative_to(folder).as_posix() for path in newest)
