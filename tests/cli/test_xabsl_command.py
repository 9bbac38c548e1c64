"""The commands of `vicode xabsl`."""

import json
import os
import shutil
from pathlib import Path

import pytest

from tests.xabsl.xabsl_cases import CASES, parse_words, read_case
from vicode.cli.entry_point import main

CIRCLE = CASES / "programs" / "drive_circle"


def test_a_behavior_is_compiled_and_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, symbols, trace = (tmp_path / name for name in ("circle.dat", "circle.sym", "circle.jsonl"))
    assert main(["xabsl", "compile", str(CIRCLE / "agents.xabsl"), "-o", str(code), "--symbols", str(symbols)]) == 0
    assert parse_words(code.read_text()) == parse_words(read_case("drive_circle", "intermediate.dat"))
    inputs = ["--symbols", str(symbols), "--inputs", str(CIRCLE / "inputs.csv")]
    assert main(["xabsl", "run", str(code), *inputs, "--trace", str(trace)]) == 0
    expected = [json.loads(line) for line in read_case("drive_circle", "trace.jsonl").splitlines()]
    header, *records = [json.loads(line) for line in trace.read_text().splitlines()]
    assert header == {"vicode-trace": 1, "runtime": "xabsl"}
    assert [(record["iteration"] - 1, record["time_ns"] // 10**6) for record in records] == [
        (line["c"], line["t"]) for line in expected
    ]
    assert [record["tree"][0]["state"] for record in records] == [line["tree"][0][2] for line in expected]
    turn = {"component": "turn", "by": "drive_circle", "link": "modulates", "parameters": {"speed": 45}}
    assert turn.items() <= records[1]["tree"][1].items()
    assert [record["tree"][0]["changed_from"] for record in records[2:5]] == [None, "turning", None]
    assert main(["xabsl", "run", str(code), *inputs, "--bench", "3"]) == 0
    assert "cycles per second" in capsys.readouterr().out


def test_a_file_without_agents_is_rejected_with_a_suggestion(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(CIRCLE, tmp_path / "circle")
    monkeypatch.chdir(tmp_path)
    option = "circle/Options/drive_circle.xabsl"
    for command in (["xabsl", "compile", option], ["import", option, "--out", "made"], ["docs", option]):
        assert main(command) == 2
        assert (
            f"{option} has no agents; specify the file with the agents: circle/agents.xabsl" in capsys.readouterr().err
        )
    assert main(["check", "circle"]) == 2
    assert "'vicode import circle/agents.xabsl' converts an XABSL behavior" in capsys.readouterr().err
    assert main(["docs", "circle", "--out", "site"]) == 0
    assert (tmp_path / "site" / "component-drive_circle.html").is_file()
    shutil.copytree(CIRCLE, tmp_path / "other")
    assert main(["docs", ".", "--out", "site"]) == 2
    assert (
        "contains several behaviors; specify one of circle/agents.xabsl, other/agents.xabsl" in capsys.readouterr().err
    )


def test_without_output_the_code_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["xabsl", "compile", str(CIRCLE / "agents.xabsl")]) == 0
    assert parse_words(capsys.readouterr().out) == parse_words(read_case("drive_circle", "intermediate.dat"))


def test_errors_prevent_the_output(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(CIRCLE, tmp_path / "circle")
    file = tmp_path / "circle" / "Options" / "drive_circle.xabsl"
    file.write_text(file.read_text().replace("goto stop", "goto stopp"))
    agents, code = str(tmp_path / "circle" / "agents.xabsl"), tmp_path / "circle.dat"
    assert main(["xabsl", "compile", agents, "-o", str(code)]) == 1
    errors = capsys.readouterr().err
    assert "did you mean 'stop'?" in errors
    assert "^^^^^" in errors
    assert not code.exists()
    assert main(["xabsl", "check", agents, "--json"]) == 1
    (finding,) = [entry for entry in json.loads(capsys.readouterr().out) if entry["severity"] == "error"]
    assert (finding["code"], finding["file"]) == ("X621", str(file))


def test_strict_rejects_what_the_original_cannot_read(tmp_path: Path) -> None:
    shutil.copytree(CIRCLE, tmp_path / "circle")
    agents = tmp_path / "circle" / "agents.xabsl"
    assert main(["xabsl", "check", str(agents), "--strict"]) == 0
    agents.write_text(agents.read_text() + "// no line break")
    assert main(["xabsl", "check", str(agents)]) == 0
    assert main(["xabsl", "check", str(agents), "--strict"]) == 1


def test_files_are_formatted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(CIRCLE, tmp_path / "circle")
    (tmp_path / "circle" / "broken.xabsl").write_text("option {")
    option = tmp_path / "circle" / "Options" / "drive_circle.xabsl"
    before = option.read_text()
    option.write_text(before.replace("  ", " "))
    assert main(["xabsl", "format", "--check", str(tmp_path)]) == 1
    assert f"{option}: would change" in capsys.readouterr().out
    assert main(["xabsl", "format", str(tmp_path)]) == 1
    assert "broken.xabsl: not formatted" in capsys.readouterr().err
    (tmp_path / "circle" / "broken.xabsl").unlink()
    assert main(["xabsl", "format", "--check", str(tmp_path)]) == 0
    assert main(["xabsl", "compile", str(tmp_path / "circle" / "agents.xabsl")]) == 0


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("code", "0 0 1", "unexpected end of the code"),
        ("symbols", "din", "line 1: missing words"),
        ("inputs", "time,nothing\n0,3\n", "no input symbol nothing"),
        ("inputs", "time,amount_turned\n0,many\n", "many is not a number"),
        ("inputs", "time,amount_turned\n0,3,4\n", "line 2: more cells than columns"),
        ("symbols", "bb turn 1 d turn.speed\n", "decimal input symbol amount_turned is not registered"),
    ],
)
def test_files_that_do_not_match_are_reported(
    name: str, text: str, expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {"code": CIRCLE / "intermediate.dat", "symbols": CIRCLE / "symbols.txt", "inputs": CIRCLE / "inputs.csv"}
    files[name] = tmp_path / name
    files[name].write_text(text)
    options = ["--symbols", str(files["symbols"]), "--inputs", str(files["inputs"])]
    assert main(["xabsl", "run", str(files["code"]), *options]) == 1
    assert expected in capsys.readouterr().err


def test_missing_files_are_reported(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["xabsl", "compile", "nowhere.xabsl"]) == 1
    assert "nowhere.xabsl cannot be read" in capsys.readouterr().err
    assert main(["xabsl", "run", "nowhere.dat", "--symbols", "x", "--inputs", "y"]) == 2


# Optional behaviors of teams: paths of files with agents, separated by colons.
BEHAVIORS = [path for path in os.environ.get("VICODE_XABSL_BEHAVIORS", "").split(":") if path]


@pytest.mark.parametrize("agents", BEHAVIORS or [str(CIRCLE / "agents.xabsl")])
def test_behaviors_of_teams_compile_without_errors(agents: str, tmp_path: Path) -> None:
    """An optional `intermediate.dat` in the same folder is the output of the original compiler."""
    code = tmp_path / "code.dat"
    assert main(["xabsl", "compile", agents, "-o", str(code)]) == 0
    original = Path(agents).with_name("intermediate.dat")
    if original.exists():
        assert parse_words(code.read_text()) == parse_words(original.read_text())
