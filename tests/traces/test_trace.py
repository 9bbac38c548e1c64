"""Both writers of traces follow the schema, and the reader returns what they wrote."""

import json
from collections.abc import Iterable
from types import SimpleNamespace
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.bica.sample_player import Player
from tests.xabsl.xabsl_cases import PROGRAMS, read_case
from vicode.bica import Component, Observer, Root, SimulatedClock
from vicode.bica.observer import TRACE_HEADER
from vicode.cli import main
from vicode.simulation.messages import IterationResult, decode_iteration, encode_response
from vicode.traces.reader import TraceError, read_trace, trace_schema
from vicode.xabsl.engine.code_reader import read_code
from vicode.xabsl.engine.replay import read_rows, replay, replay_team
from vicode.xabsl.engine.symbols import read_symbols

VALIDATOR = Draft202012Validator(trace_schema())


class Broken(Component):
    """Divides by zero in each step."""

    def work(self) -> None:
        _ = 1 / 0


def text_of(lines: Iterable[str]) -> str:
    """Join lines, each of which follows the schema."""
    listed = list(lines)
    for line in listed:
        VALIDATOR.validate(json.loads(line))
    return "\n".join(listed)


def bica_trace(main_class: type[Component], iterations: int) -> list[str]:
    world = SimpleNamespace(ball_seen=False, ball_distance=float("inf"), fallen=False, log=[])
    clock, observer = SimulatedClock(), Observer(values=True)
    root = Root(main_class, clock=clock, world=world, observer=observer, on_error=lambda _error: None)
    for number in range(iterations):
        world.fallen = number > 1
        root.step()
        clock.advance(100_000_000)
    return [json.dumps(TRACE_HEADER), *(json.dumps(record, allow_nan=False) for record in observer.records)]


def xabsl_trace(program: str) -> list[str]:
    code, symbols = read_code(read_case(program, "intermediate.dat")), read_symbols(read_case(program, "symbols.txt"))
    return list(replay(code, symbols, read_rows(read_case(program, "inputs.csv").splitlines()[:40])))


def test_the_runtime_follows_the_schema() -> None:
    lines = bica_trace(Player, 4)
    summary = {
        "stopped": "limit",
        "iterations": 4,
        "time_ns": 0,
        "state": "",
        "done": False,
        "errors": 0,
        "world": None,
    }
    iterations = read_trace(text_of([*lines, json.dumps({"summary": summary})]))
    changed = iterations[2]
    assert (changed.changed_from, changed.state, changed.transition) == ("LookForBall", "GetUp", "falls")
    assert [dict(iteration.tree[0])["worked"] for iteration in iterations] == [True] * 4


def test_the_runtime_records_errors_without_folders() -> None:
    (iteration,) = read_trace(text_of(bica_trace(Broken, 1)))
    (error,) = iteration.errors
    assert (error["component"], error["method"], error["file"]) == ("Broken", "work", "test_trace.py")
    assert error["message"] == "ZeroDivisionError: division by zero"


def test_an_error_that_stops_the_run_is_recorded() -> None:
    observer = Observer()
    root = Root(Broken, clock=SimulatedClock(), observer=observer, on_error="stop")
    with pytest.raises(Exception, match="division by zero"):
        root.step()
    assert [error["method"] for error in observer.records[0]["errors"]] == ["work"]


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_xabsl_engine_follows_the_schema(program: str) -> None:
    iterations = read_trace(text_of(xabsl_trace(program)))
    states: dict[str, str] = {}
    for iteration in iterations:
        before, states = states, {}
        for step in iteration.tree:
            # An option that was not restarted either changed from its last state or kept it.
            if step["component"] in before and step["component"] not in states and step["component_time_ns"] > 0:
                assert (step["changed_from"] or step["state"]) == before[step["component"]]
            states[step["component"]] = step["state"]


def test_the_trace_of_a_team_names_the_robots() -> None:
    code, symbols = (read_case("drive_circle", name) for name in ("intermediate.dat", "symbols.txt"))
    lines = replay_team(read_code(code), read_symbols(symbols), read_rows(["time", "0", "20"]), 2, 0)
    _header, *records = text_of(lines).splitlines()
    assert [json.loads(record)["robot"] for record in records] == [0, 1, 0, 1]


def test_an_iteration_of_the_simulation_is_a_record_of_a_trace() -> None:
    step = json.loads(bica_trace(Player, 1)[1])["tree"][0]
    result = IterationResult(iteration=1, time_ns=0, tree=[step], prints=["a"], guards={"a/0": {"holds": None}})
    record = json.loads(encode_response(result))
    VALIDATOR.validate(record)
    assert decode_iteration({**record, "robot": 3}) == result


@pytest.mark.parametrize(
    "record",
    [
        {"vicode-trace": 2, "runtime": "bica"},
        {"iteration": 0, "time_ns": 0, "tree": [], "errors": []},
        {"iteration": 1, "time_ns": 0, "tree": [{"component": "A", "state": "B"}], "errors": []},
        {"iteration": 1, "time_ns": 0, "tree": [], "errors": [{"line": 1}]},
    ],
)
def test_the_schema_rejects(record: dict[str, Any]) -> None:
    assert not VALIDATOR.is_valid(record)


HEADER = json.dumps(TRACE_HEADER)
RECORD = '{"iteration": 1, "time_ns": 0, "tree": [{"component": "Lamp", "state": "Dark"}]}'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "its first line is no header"),
        (RECORD, "its first line is no header"),
        ("{", "line 1 is not JSON"),
        ("[]", "line 1 is not an iteration record"),
        ('{"vicode-trace": 2}', "version 2"),
        (HEADER, "no iterations"),
        (f"{HEADER}\n{{}}", "line 2 is not an iteration record"),
        (
            f'{HEADER}\n{RECORD}\n{{"iteration": 2, "time_ns": 0, "tree": []}}',
            "line 3 is not an iteration record: .*tree",
        ),
        (f"{HEADER}\n{RECORD.replace(chr(34) + 'Dark' + chr(34), '4')}", "line 2 is not an iteration record: .*state"),
    ],
)
def test_an_invalid_trace_is_rejected_with_a_reason(text: str, words: str) -> None:
    with pytest.raises(TraceError, match=words):
        read_trace(text)


def test_only_the_first_iterations_are_read() -> None:
    assert len(read_trace(f"{HEADER}\n{RECORD}\n{RECORD}", 1)) == 1


def test_the_schema_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema", "--trace"]) == 0
    assert json.loads(capsys.readouterr().out) == trace_schema()
