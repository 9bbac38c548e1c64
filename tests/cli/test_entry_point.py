"""The command line without a command."""

from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from vicode.cli.entry_point import COMMANDS


def test_without_a_command_all_commands_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode() == 2
    shown = capsys.readouterr().err
    assert "error" not in shown
    assert [name for name in COMMANDS if f"\n    {name} " not in shown and f"\n    {name}\n" not in shown] == []


def test_an_unknown_command_suggests_another(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("chek", "designs") == 2
    assert capsys.readouterr().err == "vicode: there is no command 'chek'; did you mean 'check'?\n"
    assert vicode("frobnicate") == 2
    assert "'vicode --help' lists all commands" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["check", "gen", "sync"])
def test_without_a_path_the_current_folder_is_meant(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "lamp.yaml").write_text("vicode: 1\ncomponent: Lamp\ninitial: On\nstates: {On: {final: true}}\n")
    monkeypatch.chdir(tmp_path)
    assert vicode(command) == 0
    assert (tmp_path / "generated").exists() == (command != "check")
