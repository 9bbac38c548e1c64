"""Runs commands in this process, on a project of two small designs."""

from pathlib import Path

import pytest

from vicode.cli import main

PROJECT = "vicode: 1\nproject: Lamps\nlanguages: [python]\nconstants: {pause: 0.1}\n"
LAMP = """\
vicode: 1
component: Lamp
uses: {bulb: Bulb}
initial: Dark
states:
  Dark:
    enter: |
      self.count = 1
    transitions: [{to: Lit, after: pause}]
  Lit: {modulates: [bulb], transitions: [{to: Dark, after: 0.2}]}
"""
BULB = "vicode: 1\ncomponent: Bulb\ninitial: On\nstates: {On: {final: true}}\n"


@pytest.fixture
def lamps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the project in `lamps/`, which is also where we are."""
    folder = tmp_path / "lamps"
    folder.mkdir()
    for name, text in (("project", PROJECT), ("lamp", LAMP), ("bulb", BULB)):
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return folder


def vicode(*arguments: str) -> int:
    """The exit code of a command."""
    try:
        return main(arguments)
    except SystemExit as exit_:
        return int(exit_.code or 0)
