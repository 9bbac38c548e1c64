"""Long traces are read in pieces: an index, kept in the cache of the user, says where each iteration begins."""

import json
import math
import random
from pathlib import Path
from typing import Any

import pytest

from vicode.traces.index import load_index
from vicode.traces.reader import TraceError, open_trace


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "vicode" / "traces"


def step(component: str, state: str = "", **values: Any) -> dict[str, Any]:
    rest = {"by": None, "link": "root", "worked": True, "state_time_ns": 0, "parameters": {}, "done": False}
    return {"component": component, "state": state, "changed_from": None, "transition": None, **rest, "values": values}


def write(path: Path, numbers: range, *, cut: bool = False) -> Path:
    lines = [{"vicode-trace": 1, "runtime": "bica"}]
    for number in numbers:
        tree = [step("Car", "Drive" if number % 7 else "Wait", laps=number)]
        if number % 2:
            tree += [step("Eye", distance=number / 2, far=True, mood="Mood.calm"), step("Eye", distance=number)]
        errors = [{"message": "x"}] if number == 9 else []
        lines.append({"iteration": number, "time_ns": number * 20_000_123, "tree": tree, "errors": errors})
    text = "".join(json.dumps(line) + "\n" for line in lines)
    path.write_text(text[:-30] if cut else text, encoding="utf-8")
    return path


def test_every_iteration_of_all_segments_is_found(tmp_path: Path) -> None:
    write(tmp_path / "run.1.000001.jsonl", range(1, 40))
    write(tmp_path / "run.1.000002.jsonl", range(40, 80))
    write(tmp_path / "run.1.000003.jsonl", range(80, 100), cut=True)
    index = load_index(open_trace(tmp_path / "run.jsonl"))
    assert len(index) == 98
    for entry in random.Random(1).sample(range(98), 20):
        assert index.read(entry).iteration == entry + 1
        assert index.times_ns[entry] == (entry + 1) * 20_000_123
    assert [*index.with_output] == [9]
    assert {index.step_table[number][0] for number in index.steps} == {"Drive", "Wait"}


def test_columns_have_the_last_value_of_an_iteration(tmp_path: Path) -> None:
    index = load_index(open_trace(write(tmp_path / "a.jsonl", range(1, 6))))
    assert [*index.columns["Car.laps"]] == [1, 2, 3, 4, 5]
    distance = index.columns["Eye.distance"]
    assert [each for each in distance if not math.isnan(each)] == [1, 3, 5]
    assert sorted(index.columns) == ["Car.laps", "Eye.distance", "Eye.far"]


def test_the_index_is_cached_until_the_trace_changes(tmp_path: Path, cache: Path) -> None:
    path = write(tmp_path / "a.jsonl", range(1, 50))
    first = load_index(open_trace(path))
    [file] = cache.glob("*.index")
    stamp = file.stat().st_mtime_ns
    again = load_index(open_trace(path))
    assert file.stat().st_mtime_ns == stamp
    assert (again.offsets, again.times_ns, again.step_table, again.root) == (
        first.offsets, first.times_ns, first.step_table, "Car",
    )  # fmt: skip
    assert again.columns["Car.laps"] == first.columns["Car.laps"]
    write(path, range(1, 60))
    assert len(load_index(open_trace(path))) == 59


def test_a_broken_cache_is_built_again(tmp_path: Path, cache: Path) -> None:
    path = write(tmp_path / "a.jsonl", range(1, 50))
    load_index(open_trace(path))
    for file in cache.glob("*.index"):
        file.write_bytes(file.read_bytes()[:-100])
    assert len(load_index(open_trace(path))) == 49


def test_a_line_that_is_no_iteration_is_reported(tmp_path: Path) -> None:
    path = write(tmp_path / "a.jsonl", range(1, 5))
    with path.open("a") as stream:
        stream.write('{"iteration": 5}\n')
    with pytest.raises(TraceError, match="line 6 is not an iteration record"):
        load_index(open_trace(path))
