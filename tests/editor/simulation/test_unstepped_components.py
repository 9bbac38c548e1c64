"""A simulation reads the outputs of a component that is not stepped as a run does: they keep their last values."""

import sys
from pathlib import Path

import pytest

from tests.editor.simulation.lamp_project import recorded_iterations, simulate
from vicode.bica import Root, SimulatedClock
from vicode.bica.loader import load_component
from vicode.generators import generate, python_class_path
from vicode.output import apply_diffs, compare_files
from vicode.runs import RunConfig, Simulation, prepare_run
from vicode.store import open_project

PROJECT = """vicode: 1
project: Unstepped
components:
  S: {%s outputs: {level: int}}
"""
DESIGN = """vicode: 1
component: Machine
uses: {s: S}
initial: A
states:
  A: {requires: [s], transitions: [{to: B, when: s.level > 3}]}
  B: {transitions: [{to: C, when: s.level > 50}, {to: D, when: s.level < 4}, {to: D, when: "s.level == 5"}]}
  C: {requires: [s], transitions: [{to: A, when: s.level > 70}]}
  D: {final: true}
"""
CLASS = """from vicode.bica import Component


class S(Component):
    level = 0

    def work(self):
        self.level = self.root.iteration
"""
ITERATIONS = 80


def run_states(folder: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The states of a run in which the component counts the iterations."""
    project = open_project(folder).project
    apply_diffs(compare_files(generate(project), folder / "out"), folder / "out")
    monkeypatch.setattr(sys, "path", [str(folder), str(folder / "out" / "python"), *sys.path])
    clock = SimulatedClock()
    root = Root(load_component(python_class_path(project, "Machine")), clock=clock)
    states = []
    for _ in range(ITERATIONS):
        root.step()
        states.append(root.main.state)
        clock.advance(20_000_000)
    return states


def simulated_states(folder: Path) -> list[str]:
    """The states of a simulation in which a person counts the iterations."""
    project = open_project(folder).project
    design = project.design("Machine")
    assert design is not None
    prepared = prepare_run(project, design, RunConfig(), {}, folder)
    states: list[str] = []

    async def act(simulation: Simulation) -> None:
        for number in range(1, ITERATIONS + 1):
            await simulation.set_input(("S", "level"), number)
            await simulation.step()
        states.extend(iteration.state for iteration in recorded_iterations(simulation))

    simulate(prepared, folder, act)
    return states


def write(folder: Path, implementation: str) -> Path:
    (folder / "project.yaml").write_text(PROJECT % implementation)
    (folder / "machine.yaml").write_text(DESIGN)
    (folder / "counting.py").write_text(CLASS)
    return folder


def test_a_simulation_and_a_run_have_the_same_states(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write(tmp_path, "implementation: 'counting:S',")
    states = run_states(folder, monkeypatch)
    assert set(states) == {"A", "B"}
    assert simulated_states(folder) == states


def test_outputs_without_an_implementation_change_at_once(tmp_path: Path) -> None:
    assert simulated_states(write(tmp_path, ""))[3:5] == ["B", "D"]
