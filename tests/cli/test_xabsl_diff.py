"""`vicode xabsl diff`: two versions of a behavior on the same inputs."""

from pathlib import Path

import pytest

from tests.services.imported_behavior.kickoff_behavior import TEXTS
from vicode.cli.entry_point import main

INPUTS = "time,ball.x,ball.seen,ball.side\n0,500,1,1\n20,50,1,\n40,,0,\n"


@pytest.fixture
def versions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for version in ("old", "new"):
        for name, text in TEXTS.items():
            (tmp_path / version / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / version / name).write_text(text, "utf-8")
    (tmp_path / "inputs.csv").write_text(INPUTS, "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "new/Options/SetPlays/kickoff.xabsl"


def replace_in(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert text.count(old) == 1
    file.write_text(text.replace(old, new), "utf-8")


def compare(*options: str) -> int:
    return main(["xabsl", "diff", "old/agents.xabsl", "new/agents.xabsl", *options])


def test_equal_versions_agree(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(versions, "// referee", "// whistle")
    assert compare("--inputs", "inputs.csv") == 0
    assert capsys.readouterr().out == "both versions agree in 3 cycles (inputs.csv); 2 of 3 states were active\n"
    assert compare("--cycles", "40", "--seed", "3") == 0
    assert "agree in 40 cycles (seed 3)" in capsys.readouterr().out


def test_the_first_state_that_differs_is_shown(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(versions, "ball.x<near", "ball.x<0")
    assert compare("--inputs", "inputs.csv") == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[:4] == [
        "cycle 2, 0.020 s: the state of kickoff differs",
        "  old/agents.xabsl: kick",
        "  new/agents.xabsl: wait",
        "  inputs (* set in this cycle): *ball.seen=1, ball.side=1, *ball.x=50",
    ]
    old, new = lines[5].split("≠")
    assert old.split() == ["kickoff(reach=0)", "kick", "(from", "wait),", "0.000", "s"]
    assert new.split() == ["kickoff(reach=0)", "wait,", "0.020", "s"]


def test_random_inputs_find_a_changed_guard(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(versions, "ball.x<near", "ball.x<=near")
    assert compare("--cycles", "2000") == 1
    assert "agent player, cycle " in capsys.readouterr().out


def test_outputs_and_parameters_are_compared(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(versions, "speed=10;", "speed=11;")
    assert compare("--inputs", "inputs.csv") == 1
    assert capsys.readouterr().out.startswith("cycle 1, 0.000 s: speed differs\n  old/agents.xabsl: 10\n")
    replace_in(versions, "speed=11;", "speed=10;")
    replace_in(versions, "speed=ball.x*2", "speed=ball.x*3")
    assert compare("--inputs", "inputs.csv") == 1
    assert "parameter speed of walk differs" in capsys.readouterr().out
    replace_in(versions, "walk(speed=ball.x*3,\n\t\t\t     fast=false);", "")
    assert compare("--inputs", "inputs.csv") == 1
    assert "the active options and basic behaviors differ" in capsys.readouterr().out


def test_an_input_of_one_version_is_set_only_there(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    symbols = Path("new/Symbols/ball.xabsl")
    replace_in(symbols, "\tenum side input", "\tbool input wind;\n\tenum side input")
    Path("inputs.csv").write_text("time,wind\n0,1\n", "utf-8")
    assert compare("--inputs", "inputs.csv") == 0
    Path("inputs.csv").write_text("time,rain\n0,1\n", "utf-8")
    assert compare("--inputs", "inputs.csv") == 2
    assert "inputs.csv: no input symbol rain in either version" in capsys.readouterr().err


def test_agents_of_one_version_are_named(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    agents = Path("new/agents.xabsl")
    agents.write_text(f'{agents.read_text("utf-8")}agent second("Second", kickoff);\n', "utf-8")
    assert compare("--cycles", "5") == 0
    assert "agent second is only in new/agents.xabsl\n" in capsys.readouterr().out


def test_a_version_with_errors_is_not_compared(versions: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(versions, "goto wait;", "goto nowhere;")
    assert compare() == 2
    assert "kickoff.xabsl" in capsys.readouterr().err
    assert main(["xabsl", "diff", "old/agents.xabsl", "none.xabsl"]) == 2
