"""What is committed in generated/ is what designs/ gives, to the last byte."""

from pathlib import Path

import pytest

from vicode.cli import main

ROOT = Path(__file__).parents[2]


def test_generated_is_fresh(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    code = main(["gen", "--check", "designs"])
    assert (code, capsys.readouterr().out) == (0, ""), "run 'make gen' and commit what it writes"
