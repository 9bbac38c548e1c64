"""Generates designs from YAML and steps them with a simulated clock."""

import importlib
import itertools
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.generators.code_tools import write_files
from vicode.bica import ErrorRecord, Root, SimulatedClock
from vicode.check import check_project
from vicode.findings import Severity, render_text
from vicode.generators import generate, python_class_path
from vicode.store import open_project

_NUMBERS = itertools.count()

PARTS = """
from vicode.bica import Component


class Eyes(Component):
    seen = False
    distance = 0.0

    def work(self):
        self.world.log.append("eyes")
        self.seen = self.world.seen
        self.distance = self.world.distance

    def twice(self, x, plus=0.0):
        return 2 * x + plus


class Legs(Component):
    def restart(self):
        self.world.log.append("legs restart")

    def modulate(self, *, speed=7.0, turn=8.0):
        self.speed, self.turn = speed, turn

    def work(self):
        self.world.log.append(f"legs {self.speed:g} {self.turn:g}")


class Arm(Component):
    def modulate(self, *, reach, fast, side=None, lift=99):
        self.world.log.append(f"arm {reach} {fast} {side.name} {lift}")
"""

PROJECT = """
vicode: 1
project: {name}
enumerations: {{Side: [left, right]}}
constants: {{patience: 0.5, zero: 0.0}}
components:
  Eyes:
    implementation: parts_{name}:Eyes
    outputs:
      seen: {{type: bool}}
      distance: {{type: float}}
      twice: {{type: float, arguments: {{x: {{type: float}}, plus: {{type: float, default: 0}}}}}}
  Legs:
    implementation: parts_{name}:Legs
    parameters: {{speed: {{type: float, default: 7}}, turn: {{type: float, default: 8}}}}
  Gauge:
    implementation: world
    outputs: {{ready: {{type: bool}}, level: {{type: float}}, where: {{type: Side}}}}
  Sensors:
    parameters: {{power: 3}}
    outputs: {{order_given: bool, near: {{type: bool, arguments: {{limit: {{type: float}}}}}}}}
    variables: {{side: Side}}
  Arm:
    implementation: parts_{name}:Arm
    parameters: {{reach: {{type: float, default: patience * 4}}, fast: {{type: bool}}, side: {{type: Side}}, lift: 7}}
"""


class RunHarness:
    """A running component; `tick` advances the clock and steps it, `log` holds the entries since the last tick."""

    def __init__(self, root_class: type[Any]) -> None:
        self.world = SimpleNamespace(log=[], seen=False, distance=0.0)
        self.errors: list[ErrorRecord] = []
        self.clock = SimulatedClock()
        self.root = Root(root_class, clock=self.clock, world=self.world, on_error=self.errors.append)
        self.main: Any = self.root.main

    def tick(self, ms: int = 100, **world: object) -> list[str]:
        """Run one iteration and return its log entries. The first one is at time 0."""
        if self.root.iteration:
            self.clock.advance(ms * 1_000_000)
        vars(self.world).update(world)
        self.world.log.clear()
        self.root.step()
        return list(self.world.log)


StartHarness = Callable[..., RunHarness]


@pytest.fixture
def play(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> StartHarness:
    """Generate designs and create the first one as root."""

    def start(*designs: str) -> RunHarness:
        name = f"play{next(_NUMBERS)}"
        (tmp_path / "project.yaml").write_text(PROJECT.format(name=name), encoding="utf-8")
        (tmp_path / f"parts_{name}.py").write_text(PARTS, encoding="utf-8")
        for number, text in enumerate(designs):
            (tmp_path / f"design{number}.yaml").write_text(f"vicode: 1\n{text}", encoding="utf-8")
        opened = open_project(tmp_path)
        findings = [*opened.findings, *check_project(opened.project)]
        errors = [finding for finding in findings if finding.severity is Severity.ERROR]
        assert not errors, render_text(errors)
        sources = {component: path.name for component, path in opened.files.items() if component}
        write_files(generate(opened.project, sources=sources), tmp_path / "out")
        monkeypatch.syspath_prepend(tmp_path / "out" / "python")
        monkeypatch.syspath_prepend(tmp_path)
        root = opened.find_component(tmp_path / "design0.yaml")
        assert root is not None
        module, _colon, class_name = python_class_path(opened.project, root).partition(":")
        return RunHarness(getattr(importlib.import_module(module), class_name))

    return start
