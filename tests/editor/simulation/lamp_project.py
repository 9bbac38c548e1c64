"""A small project with everything a simulation handles: every type of input, a function, code, a used design."""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path

from vicode.runs import PreparedRun, RunConfig, Simulation, prepare_run
from vicode.simulation import IterationResult
from vicode.store import open_project

PROJECT = """
vicode: 1
project: Lamps
enumerations: {Mood: [calm, angry]}
constants: {bright: 10}
components:
  Eye:
    implementation: hands:Eye
    outputs:
      seen: {type: bool, doc: Somebody is there.}
      light: {type: float, unit: lx, range: [0, 100]}
      count: {type: int, range: [2, 9]}
      mood: {type: Mood}
      level: {type: float}
      toward: {type: float, arguments: {x: {type: float}}}
  Bulb:
    implementation: hands:Bulb
    parameters: {power: {type: float, default: 1}}
"""
HANDS = """
from vicode.bica import Component


class Eye(Component):
    seen, mood = False, None

    def work(self):
        self.seen = self.root.now_ns > 60_000_000
        self.light = float(self.root.iteration)
        self.count, self.level = 3, 0.0

    def toward(self, x):
        print("asked")
        return 2 * x


class Bulb(Component):
    def modulate(self, *, power):
        self.power = power
"""
LAMP = """
vicode: 1
component: Lamp
uses: {eye: Eye, bulb: Bulb, timer: Timer}
parameters: {patience: {type: float, default: 0.06, range: [0, 2], unit: s}}
outputs: {turns: {type: int, initial: 0}}
initial: Dark
common:
  transitions:
    - {to: Broken, when: eye.mood == Mood.angry}
states:
  Dark:
    requires: [eye]
    transitions:
      - {to: Lit, when: eye.seen and eye.light < bright}
      - {to: Lit, when: eye.seen, after: 0.1}
  Lit:
    requires: [eye]
    modulates: {bulb: {power: 3}, timer: {}}
    enter:
      - set: {turns: turns + 1}
      - code: print("lit", self.turns)
    transitions:
      - to: Dark
        when: not eye.seen
        code: |
          self.asked = getattr(self, "asked", 0) + 1
          return self.state_time >= self.patience
      - {to: Dark, when: done(timer)}
      - {to: Broken, when: eye.toward(x=2) > 50}
  Broken: {final: true}
"""
TIMER = """
vicode: 1
component: Timer
initial: Counting
states:
  Counting: {transitions: [{to: Over, after: 5}]}
  Over: {final: true}
"""


def write_lamps(folder: Path, lamp: str = LAMP) -> Path:
    """Write the project; returns its folder."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {"project.yaml": PROJECT, "lamp.yaml": lamp, "timer.yaml": TIMER, "hands.py": HANDS}
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def prepare_lamp(folder: Path, *, stubbed: frozenset[str] | None = None, **wish: object) -> PreparedRun:
    """The prepared run of the lamp; hand-written components are stubs by default."""
    opened = open_project(folder)
    design = opened.project.design("Lamp")
    assert design is not None
    wished = replace(RunConfig(stubbed=stubbed), **wish)
    return prepare_run(opened.project, design, wished, {"Lamp": "lamp.yaml"}, folder)


def simulate(stage: PreparedRun, folder: Path, act: Callable[[Simulation], Awaitable[None]]) -> None:
    """Run a test on a simulation and end it in any case."""

    async def run() -> None:
        simulation = Simulation(prepared=stage, cwd=folder)
        try:
            await act(simulation)
        finally:
            simulation.end()
            await simulation.wait_closed()

    asyncio.run(run())


def recorded_iterations(simulation: Simulation) -> list[IterationResult]:
    moments = (simulation.recording.iteration(number) for number in range(1, len(simulation.recording) + 1))
    return [moment for moment in moments if moment is not None]
