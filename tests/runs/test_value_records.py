"""The records that a changed value is tried on: with gaps, without values, of other designs."""

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from tests.cli import test_replay_command
from vicode.runs import Recording
from vicode.runs.changed_values import ChangedValue
from vicode.runs.value_records import LIVE, RecordReplays, RecordResult
from vicode.runs.value_replay import bridge_gaps
from vicode.simulation import IterationResult
from vicode.store import open_project
from vicode.traces.reader import open_trace

cars = test_replay_command.cars

LIMIT = ChangedValue(component="Car", name="limit", text="0.5")


def replay(folder: Path, live: Recording | None, value: ChangedValue = LIMIT) -> dict[str, RecordResult]:
    opened = open_project(folder)
    sources = {"Car": "car.yaml", "Turn": "turn.yaml"}
    replays = RecordReplays(
        project=opened.project, value=value, sources=sources, folder=folder, on_progress=lambda _count: None
    )

    async def collect() -> dict[str, RecordResult]:
        return {each.name: each async for each in replays.results(live)}

    return asyncio.run(collect())


def record_some(every: int) -> Recording:
    test_replay_command.record(5)
    recording = Recording()
    for each in open_trace(Path("run.jsonl")).iterations():
        if each.iteration % every == 0:
            recording.add(each, {})
    return recording


def test_what_a_live_view_received_is_replayed_as_if_it_were_all(cars: Path) -> None:
    found = replay(cars, record_some(every=2))[LIVE]
    assert found.note == "The editor received 125 of 249 iterations; only these are replayed."
    assert found.effect is not None
    # The distance is 5 - time: below the limit of 1 from 4.00 s on, below 0.5 from 4.5 s on.
    first = found.effect.first
    assert first is not None
    assert (first.before, first.expected, first.got) == ("Drive", "Avoid", "Drive")
    assert 4.0 <= first.time_ns / 1e9 <= 4.2


def test_a_long_gap_is_not_bridged(cars: Path) -> None:
    given = [IterationResult(iteration=n, time_ns=n * 10**8, tree=[{"values": {}}]) for n in (7, 9, 30, 31)]
    early = replace(given[0], iteration=1, tree=[{"component": "Car"}])
    assert [each.iteration for each in bridge_gaps(iter([early, *given]))] == [7, 8, 10, 11]


def test_traces_that_cannot_be_replayed_say_why_and_others_are_left_out(
    cars: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    test_replay_command.record(1, "--seed", "0")
    Path("run.jsonl").rename(cars / "plain.jsonl")
    (cars / "other.jsonl").write_text("{}\n")
    found = replay(cars, None)
    assert found.keys() == {"Trace plain.jsonl", "Trace other.jsonl"}
    assert found["Trace plain.jsonl"].problem == "the trace has no values; record it with --values"
    assert "this is not a trace" in found["Trace other.jsonl"].problem
    # A value of a component that the recorded one does not use has no effect on it.
    assert replay(cars, None, replace(LIMIT, component="Absent")).keys() == {"Trace other.jsonl"}
