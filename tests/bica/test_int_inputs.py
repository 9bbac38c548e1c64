"""Ints that the world, hand-written components and robot programs provide are limited in generated Python."""

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conformance.int_designs import MOST, int_project
from vicode.bica import Component, Root, SimulatedClock
from vicode.generators import generate
from vicode.output import apply_diffs, compare_files

PROJECT = int_project(
    "inputs",
    [
        ("own", "int", "sensor.a"),
        ("next", "int", "sensor.a - 1"),
        ("asked", "int", "sensor.far(k=sensor.a)"),
        ("seen", "int", "eyes.count"),
        ("near", "int", "eyes.near(k=2)"),
        ("is_same", "bool", "sensor.a == sensor.b"),
        ("is_seen", "bool", "eyes.count > 9007199254740991"),
        ("ratio", "float", "eyes.count / sensor.a"),
    ],
)


class Sensor(Component):
    a = 10**30
    b = 10**20

    def far(self, *, k: int) -> int:
        return k * 10


class Arm(Component):
    def modulate(self, *, turns: int = 0) -> None:
        self.turns = turns


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    apply_diffs(compare_files(generate(PROJECT, languages=("python",)), tmp_path), tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path / "python"))
    monkeypatch.setitem(sys.modules, "parts", SimpleNamespace(Sensor=Sensor, Arm=Arm))
    known = set(sys.modules)
    world = SimpleNamespace(count=-(10**30), y=0.0, near=lambda *, k: k * 10**40)
    root = Root(importlib.import_module("inputs.player").Player, clock=SimulatedClock(), world=world, on_error="stop")
    yield root.main
    for name in set(sys.modules) - known:
        del sys.modules[name]


def test_ints_are_limited_where_they_are_read(player: Any) -> None:
    player.root.step()
    assert (player.own, player.next, player.asked) == (MOST, MOST - 1, MOST)
    assert (player.seen, player.near) == (-MOST, MOST)
    assert (player.is_same, player.is_seen, player.ratio) == (True, False, -1.0)


def test_parameters_are_limited_where_they_are_set(player: Any) -> None:
    player.modulate(p=10**30)
    assert player.p == MOST
    player.modulate(p=-(10**30))
    assert player.p == -MOST
    player.modulate(p=7)
    assert player.p == 7
