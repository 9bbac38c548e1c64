"""Recorder: keeps the last minutes of a running root in files, written by a separate thread (docs/traces.md)."""

from __future__ import annotations

import atexit
import json
import os
import re
import threading
import time
from collections import deque
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from .errors import print_error
from .observer import TRACE_HEADER, Observer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .base_root import BaseRoot
    from .observer import IterationRecord

FILE, MINUTES = "VICODE_RECORD", "VICODE_RECORD_MINUTES"
DEFAULT_MINUTES = 5.0

_SEGMENTS = 10
"""So many segments hold the minutes; one more is being written."""
_MAX_BYTES = 512_000_000
_MAX_WAITING = 10_000
_WRITE_INTERVAL_S = 0.1
_SYNC_INTERVAL_S = 1.0
_CLOSE_TIMEOUT_S = 5.0
_KEPT_RUNS = 4

_active_runs: set[tuple[Path, int]] = set()


class Recorder:
    """Writes iterations into a ring of segments, each a complete trace: FILE.RUN.SEGMENT.jsonl.

    The thread of the root appends to a queue and never waits for the disk: iterations that find the queue full are
    counted and left out.

    Args:
        path: The name of the record, such as `run.jsonl`; the segments are next to it.
        minutes: How long segments are kept, in the time of the root.
        origin: Further fields of the header.
        start_thread: Whether a thread writes; without it, call `write`.

    Raises:
        OSError: No file can be created there.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        minutes: float = DEFAULT_MINUTES,
        origin: Mapping[str, str] | None = None,
        start_thread: bool = True,
    ) -> None:
        if not 0 < minutes < float("inf"):
            raise ValueError(f"cannot record the last {minutes:g} minutes; pass more than 0")
        self.path = Path(path).resolve()
        self.dropped = 0
        """Iterations that were left out because the disk was too slow."""
        self.written = 0
        """The number of the newest iteration that survives a crash of the process."""
        self._segment_ns = minutes * 60e9 / _SEGMENTS
        self._header = {**TRACE_HEADER, **{name: value for name, value in (origin or {}).items() if value}}
        self._waiting: deque[IterationRecord] = deque()
        self._unreported = 0
        self.is_incomplete = False
        """Whether an error of the disk has ended the record."""
        self._has_failed = False
        self._lock = threading.Lock()
        self._run = _start_run(self.path)
        self._files: deque[Path] = deque()
        self._segment = 0
        self._bytes = self._begin_ns = 0
        self._synced_s = time.monotonic()
        self._stream = self._open_segment()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._write_until_closed, name="vicode recorder", daemon=True)
        if start_thread:
            self._thread.start()
        atexit.register(self.close)

    def add(self, record: IterationRecord) -> None:
        """Queue an iteration; called by the thread of the root."""
        if len(self._waiting) >= _MAX_WAITING or self._has_failed:
            self.dropped += 1
            self._unreported += 1
            return
        if self._unreported:
            record["dropped"], self._unreported = self._unreported, 0
        self._waiting.append(record)

    def write(self) -> None:
        """Write what is queued; after an error such as a full disk, the run continues without the recorder."""
        with self._lock:
            if self._has_failed:
                return
            try:
                self._write_waiting()
            except (OSError, ValueError) as error:
                self._has_failed = self.is_incomplete = True
                self._waiting.clear()
                reason = getattr(error, "strerror", None) or str(error)
                print_error(f"cannot write the record {self.path}: {reason}; the run continues without it")

    def close(self) -> None:
        """Write the rest and end the thread; later calls do nothing."""
        atexit.unregister(self.close)
        if self._closing.is_set():
            return
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join(_CLOSE_TIMEOUT_S)
        self.write()
        with self._lock:
            self._has_failed = True
            # Closing tries again to write what did not fit on a full disk; that was reported.
            with suppress(OSError):
                self._stream.close()
        _active_runs.discard((self.path, self._run))

    def _write_until_closed(self) -> None:
        while not self._closing.wait(_WRITE_INTERVAL_S):
            self.write()

    def _write_waiting(self) -> None:
        newest = 0
        # Iterations that are added during the loop are written the next time.
        for _ in range(len(self._waiting)):
            record = self._waiting.popleft()
            self._write_record(record)
            newest = record["iteration"]
            # Releases the interpreter lock, so that the root waits for the encoding of one iteration at most.
            time.sleep(0)
        if newest:
            self._stream.flush()
            self.written = newest
            if time.monotonic() - self._synced_s >= _SYNC_INTERVAL_S:
                self._sync()

    def _write_record(self, record: IterationRecord) -> None:
        is_old = record["time_ns"] - self._begin_ns >= self._segment_ns
        if self._bytes and (is_old or self._bytes >= _MAX_BYTES // _SEGMENTS):
            self._sync()
            self._stream.close()
            self._stream = self._open_segment()
            self._bytes = 0
        if not self._bytes:
            self._begin_ns = record["time_ns"]
        line = json.dumps(record, separators=(",", ":")) + "\n"
        self._bytes += len(line)
        self._stream.write(line)

    def _sync(self) -> None:
        """Protect what was written from a loss of power."""
        self._stream.flush()
        os.fsync(self._stream.fileno())
        self._synced_s = time.monotonic()

    def _open_segment(self) -> TextIO:
        """Create the next segment, and remove the oldest if there are too many."""
        self._segment += 1
        file = segment_file(self.path, self._run, self._segment)
        stream = file.open("x", encoding="utf-8")
        stream.write(json.dumps({**self._header, "segment": self._segment}) + "\n")
        stream.flush()
        self._files.append(file)
        if len(self._files) > _SEGMENTS + 1:
            self._files.popleft().unlink(missing_ok=True)
        return stream


def segment_file(path: Path, run: int, segment: int) -> Path:
    return path.with_name(f"{path.stem}.{run}.{segment:06}{path.suffix or '.jsonl'}")


def split_segment(file: Path) -> tuple[Path, int, int] | None:
    """The record, run and segment that the name of a file tells; None if it is not the name of a segment."""
    found = re.fullmatch(r"(.+)\.(\d+)\.(\d{6,})(\.[^.]+)", file.name)
    return (file.with_name(found[1] + found[4]), int(found[2]), int(found[3])) if found is not None else None


def find_segments(path: Path) -> dict[int, list[Path]]:
    """The segments of a record by run, the oldest first."""
    record = path if path.suffix else path.with_name(f"{path.name}.jsonl")
    runs: dict[int, list[tuple[int, Path]]] = {}
    for file in path.parent.iterdir() if path.parent.is_dir() else ():
        place = split_segment(file)
        if place is not None and place[0] == record:
            runs.setdefault(place[1], []).append((place[2], file))
    return {run: [file for _number, file in sorted(runs[run])] for run in sorted(runs)}


def record_root(
    root: BaseRoot, path: str | os.PathLike[str], *, minutes: float, values: bool, **origin: str
) -> Recorder:
    """Record a root until it is closed.

    Raises:
        OSError: No file can be created there.
    """
    recorder = Recorder(path, minutes=minutes, origin=origin)
    root._add_observer(Observer(recorder.add, values=values))

    def close() -> None:
        recorder.close()
        root._has_lost_output |= recorder.is_incomplete

    root._closing.callback(close)
    return recorder


def record_from_environment(root: BaseRoot) -> None:
    """Record a root as the environment says; a robot also starts if that is impossible."""
    path = os.environ[FILE]
    try:
        minutes = float(os.environ.get(MINUTES) or DEFAULT_MINUTES)
        record_root(root, path, minutes=minutes, values=True)
    except (OSError, ValueError) as error:
        root._has_lost_output = True
        print_error(f"cannot record to {path}: {error}")


def _start_run(path: Path) -> int:
    """Choose the number of a new run, and remove all but the latest earlier ones."""
    path.parent.mkdir(parents=True, exist_ok=True)
    known = find_segments(path)
    run = max((*known, *(number for file, number in _active_runs if file == path)), default=0) + 1
    earlier = [number for number in known if (path, number) not in _active_runs]
    for number in earlier[: max(0, len(earlier) - _KEPT_RUNS)]:
        for file in known[number]:
            file.unlink(missing_ok=True)
    _active_runs.add((path, run))
    return run
