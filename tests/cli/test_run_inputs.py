"""`vicode run --set`: a run without a world, and the command line that repeats a simulation."""

import json
import random
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.editor.simulation.lamp_project import prepare_lamp, simulate, write_lamps
from vicode.runs import RunConfig, Simulation
from vicode.runs.terminal_command import NotRepeatableError, terminal_command

PROJECT = """
vicode: 1
project: Coffee
components:
  Button: {outputs: {order: bool}}
  Eyes: {outputs: {distance: {type: float, initial: 3}}}
"""
COFFEE_BOT = """
vicode: 1
component: CoffeeBot
uses: {button: Button, eyes: Eyes}
initial: Idle
states:
  Idle: {requires: [button], transitions: [{to: Drive, when: button.order}]}
  Drive: {requires: [eyes], transitions: [{to: Pour, when: eyes.distance < 0.5}]}
  Pour: {transitions: [{to: Idle, after: 2}]}
"""


@pytest.fixture
def coffee_bot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "project.yaml").write_text(PROJECT)
    (tmp_path / "coffee_bot.yaml").write_text(COFFEE_BOT)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "coffee_bot.yaml"


def read_states(trace: Path) -> list[str]:
    records = [json.loads(line) for line in trace.read_text().splitlines()]
    return [record["tree"][0]["state"] for record in records if "tree" in record]


def changes(states: list[str]) -> list[tuple[int, str]]:
    return [(index, state) for index, state in enumerate(states) if not index or states[index - 1] != state]


@pytest.mark.parametrize("is_file", [False, True], ids=["options", "file"])
def test_inputs_drive_a_run_without_a_world(
    coffee_bot: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str], *, is_file: bool
) -> None:
    lines = ["0.5 s: order=true", "1 s: order=false", "2 s: Eyes.distance=0.4"]
    (tmp_path / "day.txt").write_text("# a day\n" + "\n".join(lines))
    given = ["--inputs", "day.txt"] if is_file else [word for line in lines for word in ("--set", line)]
    assert vicode("run", str(coffee_bot), *given, "--tick-ms", "20", "--ticks", "300", "--trace", "t.jsonl") == 0
    # Iteration 25 is at 0.5 s, 100 at 2 s; Pour lasts 2 s from there.
    assert changes(read_states(tmp_path / "t.jsonl")) == [(0, "Idle"), (25, "Drive"), (100, "Pour"), (200, "Idle")]
    assert "P209" not in capfd.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--set", "ordr=true"], "--set ordr=true: there is no input 'ordr'; there are Button.order, Eyes.distance"),
        (["--set", "order=1"], "--set order=1: '1' is no value of Button.order: it must be true or false"),
        (["--inputs", "bad.txt"], "bad.txt:2:7: 'often' is no value of Button.order: it must be true or false"),
        (["--inputs", "missing.txt"], "missing.txt: No such file or directory"),
        (["--inputs", "binary.txt"], "binary.txt is not UTF-8 text"),
        (["--set", "order=true", "--reload"], "--reload has no effect with --set or --inputs; leave it out"),
        (["--set", "order=true", "--world", "w:W"], "--world has no effect with --set or --inputs; leave it out"),
    ],
)
def test_wrong_inputs_are_refused(
    coffee_bot: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    (tmp_path / "bad.txt").write_text("order=true\norder=often\n")
    (tmp_path / "binary.txt").write_bytes(b"\xff\xfe")
    assert vicode("run", str(coffee_bot), *arguments) == 2
    assert capfd.readouterr().err == f"vicode: {message}\n"


@pytest.mark.parametrize(("seed", "steps"), [(2, 9), (4, 9), (3, 60)])
def test_the_command_repeats_a_simulation(tmp_path: Path, seed: int, steps: int) -> None:
    lamps = write_lamps(tmp_path / "lamps")
    prepared, chance = prepare_lamp(lamps), random.Random(seed)
    states: list[str] = []
    commands = []

    async def act(simulation: Simulation) -> None:
        inputs = [each for each in prepared.inputs if each.arguments is None]
        for _step in range(steps):
            each = chance.choice(inputs)
            options = {"bool": [True, False], "float": [0, 0.1, 2.5, 50], "int": [2, 9]}
            await simulation.set_input(each.key, chance.choice(options.get(each.type) or each.options))
            await simulation.step(chance.randrange(1, 4))
        states.extend(simulation.recording.states)
        commands.append(terminal_command("lamp.yaml", simulation, RunConfig()))

    simulate(prepared, lamps, act)
    (found,) = commands
    assert bool(found.inputs_file) == (steps > 12)
    if found.inputs_file:
        (lamps / found.inputs_file).write_text(found.inputs_text)
    command = [sys.executable, "-m", *shlex.split(found.command), "--trace", "trace.jsonl"]
    subprocess.run(command, cwd=lamps, check=True, stdout=subprocess.DEVNULL)
    assert len(set(states)) > 1
    assert read_states(lamps / "trace.jsonl") == states


def test_a_simulation_without_changes_is_repeated_with_one_input(tmp_path: Path) -> None:
    lamps = write_lamps(tmp_path / "lamps")

    async def act(simulation: Simulation) -> None:
        await simulation.step(3)
        assert terminal_command("lamp.yaml", simulation, RunConfig()).command == (
            "vicode run lamp.yaml --set patience=0.06 --ticks 3"
        )
        assert terminal_command("my lamp.yaml", simulation, RunConfig(stubbed=frozenset(), seed=4)).command == (
            "vicode run 'my lamp.yaml' --seed 4 --ticks 3"
        )
        with pytest.raises(NotRepeatableError, match="only some components"):
            terminal_command("lamp.yaml", simulation, RunConfig(stubbed=frozenset({"Eye"})))

    simulate(prepare_lamp(lamps), lamps, act)


def test_a_run_of_a_component_that_nothing_steps_is_replayed_and_becomes_a_test(
    coffee_bot: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    coffee_bot.write_text(COFFEE_BOT.replace("requires: [button], ", ""))
    given = ("--set", "0.1 s: Button.order=true", "--seconds", "0.3", "--values", "--trace", "t.jsonl")
    assert vicode("run", str(coffee_bot), *given) == 0
    assert read_states(Path("t.jsonl"))[-1] == "Drive"
    capsys.readouterr()
    assert vicode("replay", "t.jsonl") == 0
    assert "same states in 15 iterations" in capsys.readouterr().out
    assert vicode("test", "record", "t.jsonl") == 0
    records = [json.loads(line) for line in Path("t.jsonl").read_text().splitlines()]
    for record in records:
        record.pop("inputs", None)
    Path("t.jsonl").write_text("".join(json.dumps(record) + "\n" for record in records))
    assert vicode("replay", "t.jsonl") == 1
    assert "    button.order = not in the trace, now False" in capsys.readouterr().out
