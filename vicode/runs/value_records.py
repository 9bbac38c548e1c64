"""The records that a changed value is tried on: that of a watched robot, and the traces of the project folder."""

import asyncio
from collections.abc import AsyncIterator, Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import chain, islice
from pathlib import Path

from vicode.generators import UnsoundDesignError
from vicode.model.project import Project
from vicode.runs.changed_values import ChangedValue
from vicode.runs.client import RunFailedError
from vicode.runs.recorded_inputs import MissingValuesError
from vicode.runs.recording import MAX_ITERATIONS, Recording
from vicode.runs.setup import NotReadyError
from vicode.runs.trace_recording import find_traces
from vicode.runs.value_replay import ValueEffect, bridge_gaps, concerns, prepare_value_replay, replay_values
from vicode.simulation import IterationResult
from vicode.traces.reader import TraceError, open_trace

MAX_TRACES = 10
LIVE = "This robot, so far"


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordResult:
    """What a value changes in one record, or why that is not known; neither while it is replayed.

    `note` says which iterations are not replayed.
    """

    name: str
    effect: ValueEffect | None = None
    problem: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordReplays:
    """Replays of the records of a project with a changed value."""

    project: Project
    value: ChangedValue
    sources: Mapping[str, str]
    folder: Path
    on_progress: Callable[[int], None]
    """Called with the number of iterations of the record so far; may raise to end it."""

    async def results(self, live: Recording | None) -> AsyncIterator[RecordResult]:
        """For each record an empty result when it begins, and one when it ends."""
        if live is not None and len(live):
            async for result in self._try(LIVE, lambda: bridge_gaps(live.iterations()), _describe_gaps(live)):
                yield result
        for name in find_traces(self.folder)[:MAX_TRACES]:
            async for result in self._try(f"Trace {name}", partial(_read_trace, self.folder / name), ""):
                yield result

    async def _try(
        self, name: str, read: Callable[[], Iterator[IterationResult]], note: str
    ) -> AsyncIterator[RecordResult]:
        try:
            iterations = read()
            first = next(iterations, None)
            root = str(first.tree[0]["component"]) if first is not None else ""
            design = self.project.design(root)
            if first is None or design is None or not concerns(self.project, design, self.value):
                return
            yield RecordResult(name=name, note=note)
            prepared = await asyncio.to_thread(
                prepare_value_replay, self.project, design, (self.value,), self.sources, self.folder
            )
            whole = chain([first], islice(iterations, MAX_ITERATIONS - 1))
            effect = await replay_values(prepared, self.folder, whole, on_progress=self.on_progress)
            rest = next(iterations, None) is not None
            note = f"Only the first {MAX_ITERATIONS} iterations are replayed." if rest else note
            yield RecordResult(name=name, effect=effect, note=note)
        except (MissingValuesError, NotReadyError, UnsoundDesignError, RunFailedError, TraceError, OSError) as error:
            yield RecordResult(name=name, problem=f"{error}")


def _read_trace(path: Path) -> Iterator[IterationResult]:
    return open_trace(path).iterations()


def _describe_gaps(live: Recording) -> str:
    first, last = live.iteration(1), live.iteration(len(live))
    assert first is not None
    assert last is not None
    whole = last.iteration - first.iteration + 1
    if whole <= len(live):
        return ""
    return f"The editor received {len(live)} of {whole} iterations; only these are replayed."
