"""The command line without a command."""

import pytest

from tests.cli.command_runner import vicode
from vicode.cli.entry_point import COMMANDS


def test_without_a_command_all_commands_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode() == 2
    shown = capsys.readouterr().err
    assert "error" not in shown
    assert [name for name in COMMANDS if f"\n    {name} " not in shown and f"\n    {name}\n" not in shown] == []
