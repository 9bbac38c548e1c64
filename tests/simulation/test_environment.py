"""The environment of processes that run user code."""

import os
from pathlib import Path

import pytest

import vicode
from vicode.simulation.environment import fresh_environment


def test_the_path_of_the_user_precedes_vicode(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(["robot", "", "tools"]))
    environment = fresh_environment(ROBOT="1")
    assert environment["PYTHONPATH"].split(os.pathsep) == ["robot", "tools", str(Path(vicode.__file__).parents[1])]
    assert environment["ROBOT"] == "1"
