"""vicode check and the other small commands."""

import json
import os
import signal
from pathlib import Path

import pytest

from tests.cli.command_runner import BULB, LAMP, lamps, vicode
from vicode import __version__
from vicode.cli.console import _MAX_BYTES, _read_lines

__all__ = ["lamps"]


def test_sound_designs_are_called_so(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("check", "lamps") == 0
    assert capsys.readouterr().out == "no findings in 2 designs\n"


def test_findings_come_with_their_lines(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("to: Lit", "to: Lot"), encoding="utf-8")
    assert vicode("check", "lamps/lamp.yaml") == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("lamps/lamp.yaml:9:")
    assert "error D402 unknown-state" in lines[0]
    assert lines[1].strip() == "transitions: [{to: Lot, after: pause}]"
    assert lines[2].strip() == "^^^"


def test_only_what_was_asked_for_is_judged(lamps: Path) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("to: Lit", "to: Lot"), encoding="utf-8")
    assert vicode("check", "lamps/bulb.yaml") == 0
    (lamps / "bulb.yaml").write_text(BULB.replace("initial: On", "initial: Off"), encoding="utf-8")
    (lamps / "lamp.yaml").write_text(LAMP, encoding="utf-8")
    assert vicode("check", "lamps/lamp.yaml") == 1


def test_findings_can_be_had_as_json(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("to: Lit", "to: Lot"), encoding="utf-8")
    assert vicode("check", "--json", "lamps") == 1
    first = json.loads(capsys.readouterr().out)[0]
    assert (first["code"], first["line"], first["component"]) == ("D402", 9, "Lamp")


def test_strict_counts_warnings(lamps: Path) -> None:
    (lamps / "lamp.yaml").write_text(LAMP.replace("initial:", "variables: {unused: 0}\ninitial:"), encoding="utf-8")
    assert vicode("check", "lamps") == 0
    assert vicode("check", "lamps", "--strict") == 1


@pytest.mark.parametrize("arguments", [["schema"], ["schema", "--project"]])
def test_the_schema_is_json(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode(*arguments) == 0
    assert "$schema" in json.loads(capsys.readouterr().out)


def test_the_version_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("--version") == 0
    assert capsys.readouterr().out == f"vicode {__version__}\n"


def test_what_is_no_file_is_not_read(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(lamps / "pipe.yaml")
    signal.alarm(10)
    try:
        assert vicode("check", "lamps/pipe.yaml") == 1
        assert "pipe.yaml:1:1: error Y110" in (out := capsys.readouterr().out)
        assert "not a regular file" in out
        assert vicode("check", "/dev/zero") in (1, 2)
        (lamps / "pipe.yaml").unlink()
        os.mkfifo(lamps / "sub.yaml")
        assert vicode("check", "lamps") == 0
    finally:
        signal.alarm(0)


def test_of_a_long_file_no_more_is_read_than_one_would_read(tmp_path: Path) -> None:
    long = tmp_path / "long.yaml"
    long.write_text("a\n" * (_MAX_BYTES // 2) + "never shown\n")
    lines = _read_lines(str(long), encoding="")
    assert lines[0] == "a"
    assert "never shown" not in lines
    os.mkfifo(tmp_path / "pipe")
    assert _read_lines(str(tmp_path / "pipe"), encoding="") == ()


@pytest.mark.parametrize("command", ["check", "gen", "edit"])
@pytest.mark.parametrize(
    ("name", "told"), [("notes.md", "folder with designs\n"), ("agents.xabsl", "'vicode import' converts")]
)
def test_what_is_no_design_is_told(
    command: str, name: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / name).write_text("# Notes\n")
    assert vicode(command, str(tmp_path / name)) == 2
    assert f"{name} is not a design; specify a design (.yaml) or a folder with designs" in (
        said := capsys.readouterr().err
    )
    assert told in said


def test_an_unreadable_design_is_no_unknown_component(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project = lamps / "project.yaml"
    project.write_text(project.read_text(encoding="utf-8") + "agents: {lamp: {root: Lamp}}\n", encoding="utf-8")
    (lamps / "lamp.yaml").write_text(LAMP + "<<<<<<< ours\n", encoding="utf-8")
    assert vicode("check", "lamps") == 1
    out = capsys.readouterr().out
    assert "lamps/lamp.yaml" in out
    assert "P202" not in out
