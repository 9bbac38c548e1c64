"""vicode replay --set: what another value changes, compared with runs of a design edited by hand."""

import json
import re
from collections import Counter
from pathlib import Path

import pytest

from tests.cli import test_replay_command
from tests.cli.command_runner import vicode
from tests.cli.test_replay_command import change, edit_trace

cars = test_replay_command.cars

TICK_S = 0.02
RUN = ("run", "cars/car.yaml", "--seconds", "30", "--values", "--trace")
CASES = [
    ("Car.limit=0.5", "car.yaml", "limit: {type: float, default: 1.0}", "limit: {type: float, default: 0.5}"),
    ("steep = 2.95", "project.yaml", "steep: 2.9", "steep: 2.95"),
    ("Turn.duration=0.1", "turn.yaml", "duration: 0.4", "duration: 0.1"),
]

ROW = r"  (\w+) (\w+) +([\d.]+) s +([\d.]+) s$"

States = list[dict[str, str]]


def states_of(file: str) -> States:
    lines = [json.loads(line) for line in Path(file).read_text().splitlines()]
    named = ({step["component"]: step["state"] for step in line["tree"]} for line in lines if "tree" in line)
    return [{name: each[name] for name in ("Car", "Turn") if name in each} for each in named]


def seconds_in(states: States) -> Counter[str]:
    # The last iteration has no duration.
    return Counter(f"{name} {state}" for each in states[:-1] for name, state in each.items())


def prepare(folder: Path) -> None:
    """The values of all inputs depend on the time only, so that another run has the same ones."""
    change(folder / "project.yaml", "world: hands:World", "world: hands:World\nconstants: {steep: 2.9}")
    change(folder / "car.yaml", "road.slope > 2.9", "road.slope > steep")
    change(folder / "turn.yaml", "component: Turn", "component: Turn\nparameters: {duration: 0.4}")
    change(folder / "turn.yaml", "after: 0.4", "when: state_time >= duration")


@pytest.mark.parametrize(("given", "file", "old", "new"), CASES)
def test_what_changes_is_what_a_run_with_the_edited_file_changes(
    cars: Path, capsys: pytest.CaptureFixture[str], given: str, file: str, old: str, new: str
) -> None:
    prepare(cars)
    assert vicode(*RUN, "run.jsonl") == 0
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars", "--set", given) == 1
    lines = capsys.readouterr().out.splitlines()
    assert old in (cars / file).read_text()

    change(cars / file, old, new)
    assert vicode(*RUN, "edited.jsonl") == 0
    before, after = states_of("run.jsonl"), states_of("edited.jsonl")
    numbers = [index for index, states in enumerate(zip(before, after, strict=True)) if states[0] != states[1]]
    assert lines[0].startswith(
        f"{len(numbers)} of {len(before)} iterations change; first at {numbers[0] * TICK_S:.3f} s: "
    )
    assert lines[-1] == "The recorded inputs do not react to the changed behavior."
    times = seconds_in(before), seconds_in(after)
    told = {f"{row[1]} {row[2]}": (row[3], row[4]) for line in lines if (row := re.match(ROW, line))}
    assert told == {
        name: tuple(f"{each[name] * TICK_S:.2f}" for each in times)
        for name in times[0] | times[1]
        if times[0][name] != times[1][name]
    }


@pytest.mark.parametrize("start", [210, 633])
@pytest.mark.parametrize(("given", "file", "old", "new"), CASES)
def test_a_record_with_gaps_is_entered_with_the_new_value(
    cars: Path, capsys: pytest.CaptureFixture[str], given: str, file: str, old: str, new: str, start: int
) -> None:
    """Where the record of the edited design and that of the present one agree, so must the replays."""
    prepare(cars)
    change(cars / file, old, new)
    assert vicode(*RUN, "run.jsonl") == 0
    change(cars / file, new, old)
    edit_trace(lambda lines: [lines[0], *lines[start : start + 20], *lines[start + 60 : -1]])
    capsys.readouterr()
    vicode("replay", "run.jsonl", "--design", "cars", "--set", given)
    told = capsys.readouterr().out
    changed, unlike = (re.search(words, told) for words in (r"^(\d+) of", r"the states of (\d+) iteration"))
    # With the value, the replay gives the record: so all iterations that are unlike it change.
    assert (changed and changed[1]) == (unlike and unlike[1])
    assert changed or told.startswith("No iteration changes")


def test_a_value_without_effect_changes_nothing(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode(*RUN[:3], "5", *RUN[4:], "run.jsonl") == 0
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars", "--set", "Car.limit=1") == 0
    assert capsys.readouterr().out == "No iteration changes (250 iterations)\n"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("Car.limt=2", "Car has no parameter 'limt'; did you mean 'limit'?"),
        ("Car.laps=2", "Car.laps is a variable; only parameters and constants can be changed"),
        ("Car.limit=far", "'far' is no value of Car.limit, which has the type float"),
        ("Carr.limit=2", "no design of component 'Carr'; did you mean 'Car'?"),
        ("limit=2", "the project has no constant 'limit'; a parameter is written as Component.parameter"),
        ("Car.limit", "write Component.parameter=VALUE or constant=VALUE"),
    ],
)
def test_wrong_values_are_reported(cars: Path, capsys: pytest.CaptureFixture[str], given: str, message: str) -> None:
    test_replay_command.record(1)
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars", "--set", given) == 2
    assert capsys.readouterr().err == f"vicode: --set {given}: {message}\n"


def test_a_trace_without_values_says_why(cars: Path, capsys: pytest.CaptureFixture[str]) -> None:
    test_replay_command.record(1, "--seed", "0")
    capsys.readouterr()
    assert vicode("replay", "run.jsonl", "--design", "cars", "--set", "Car.limit=2") == 2
    assert "the trace has no values; record it with --values" in capsys.readouterr().err
    assert vicode("replay", "run.jsonl", "--design", "cars", "--set", "Car.limit=2", "--tolerance", "1") == 2
