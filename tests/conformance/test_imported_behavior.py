"""Behaviors imported from XABSL and compiled as C++ give the traces of the engine that runs their sources."""

import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.cpp_tools import find_gpp, unoptimized
from tests.xabsl.xabsl_cases import CASES
from vicode.conformance.cpp import CppProgram
from vicode.conformance.inputs import ConformanceRun, iteration_times
from vicode.conformance.random_inputs import random_run
from vicode.conformance.traces import TraceDifference, TraceIteration, TraceNormalizer, first_difference, reduce_for
from vicode.conformance.xabsl import XabslRobot
from vicode.importers import import_behavior
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.source_loader import load_source

WRITTEN = [Path(path) for path in os.environ.get("VICODE_XABSL_BEHAVIORS", "").split(":") if path]


def run_engine(run: ConformanceRun, compiled: CompileResult, agent: str) -> list[TraceIteration]:
    """Run the sources of a behavior, not the XABSL that is generated from the imported designs."""
    robot, normalizer = XabslRobot(run, compiled, 0), TraceNormalizer(run.project)
    assert robot.engine.select(agent)
    iterations = []
    for count, (time_ns, step) in enumerate(zip(iteration_times(run), run.steps, strict=True), start=1):
        shared = robot.shared()
        robot.step(time_ns, step.inputs[0])
        record = {"iteration": count, "time_ns": time_ns, "tree": robot.tree(), "inputs": shared}
        iterations.append(normalizer.iteration(record))
    return iterations


def compare_agents(files: Mapping[str, Path], folder: Path, iterations: int) -> dict[str, TraceDifference | None]:
    """The first difference of each agent of some behaviors, by their names."""
    runs: dict[str, ConformanceRun] = {}
    expected: dict[str, list[TraceIteration]] = {}
    for name, path in files.items():
        source = load_source(path)
        compiled = compile_source(source)
        project = import_behavior(source, compiled, name).project
        for agent in project.agents:
            run = random_run(project, agent.root, iterations=iterations, seed=1)
            key = f"{name}_{agent.name}".lower()  # a C++ namespace
            runs[key], expected[key] = run, run_engine(run, compiled, agent.name)
    got = CppProgram(runs, folder, unoptimized(find_gpp()), programs=2).run()
    return {
        name: first_difference(reduce_for("xabsl", expected[name]), reduce_for("xabsl", got[name])) for name in runs
    }


def test_cpp_gives_the_trace_of_the_engine(tmp_path: Path) -> None:
    # p4 has the most options, p11 guards that read outputs, p7 an agent without shared variables.
    files = {name: CASES / "programs" / name / "agents.xabsl" for name in ("p4", "p7", "p11")}
    differences = compare_agents(files, tmp_path, 300)
    assert len(differences) == 9
    assert set(differences.values()) == {None}


@pytest.mark.nightly
@pytest.mark.parametrize("path", WRITTEN, ids=str)
def test_cpp_gives_the_trace_of_the_engine_for_behaviors_elsewhere(path: Path, tmp_path: Path) -> None:
    differences = compare_agents({"other": path}, tmp_path, 3000)
    assert set(differences.values()) == {None}
