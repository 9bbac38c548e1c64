"""Runs designs in Python: the generated code on `vicode.bica`, and the simulator of the editor, in another process."""

import json
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

from vicode.conformance.inputs import ConformanceRun, InputKind, iteration_times, used_interfaces
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.generators import generate, python_class_path
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import WORLD, Project
from vicode.output import apply_diffs, compare_files
from vicode.runs.setup import RunConfig, prepare_run
from vicode.simulation import Stub, StubOutput
from vicode.simulation.environment import fresh_environment
from vicode.simulation.messages import encode_setup
from vicode.simulation.stubs import STUB_MODULE


class CodeRunError(Exception):
    """The code of a design cannot be run; the message says why."""


def run_python(
    runs: Mapping[str, ConformanceRun], folder: Path, modules: Path | None = None
) -> dict[str, list[TraceIteration]]:
    """Run generated Python.

    Args:
        runs: Runs by name; the names are valid names of packages.
        folder: An empty folder for code.
        modules: The folder of modules that code of the designs imports.

    Raises:
        UnsoundDesignError: A design cannot be generated.
        CodeRunError: The code cannot be loaded.
    """
    return _run(partial(_python_job, folder=folder, modules=modules), runs, folder)


def run_simulator(
    runs: Mapping[str, ConformanceRun], folder: Path, modules: Path | None = None
) -> dict[str, list[TraceIteration]]:
    """Run designs as the editor simulates them; arguments as for `run_python`.

    Raises:
        NotReadyError: A design has errors.
        CodeRunError: The code cannot be loaded.
    """
    return _run(partial(_simulator_job, folder=folder, modules=modules), runs, folder)


def _run(
    make_job: Callable[[str, ConformanceRun], dict[str, Any]], runs: Mapping[str, ConformanceRun], folder: Path
) -> dict[str, list[TraceIteration]]:
    """Run everything in one process; code is generated once for the runs of one design."""
    names = defaultdict[tuple[int, str], list[str]](list)
    for name, run in runs.items():
        names[id(run.project), run.root].append(name)
    jobs = [
        {**make_job(group[0], runs[group[0]]), "runs": [_inputs_of(runs[name]) for name in group]}
        for group in names.values()
    ]
    traces = {}
    for group, answer in zip(names.values(), _answer(jobs, folder), strict=True):
        if "error" in answer:
            raise CodeRunError(f"{runs[group[0]].root}: {answer['error']}")
        normalizer = TraceNormalizer(runs[group[0]].project)
        for name, records in zip(group, answer["iterations"], strict=True):
            traces[name] = [normalizer.iteration(record, robot) for robot, record in records]
    return {name: traces[name] for name in runs}


def _answer(jobs: Sequence[Mapping[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """Run jobs in another process. -P: modules in the current folder must not shadow others."""
    done = subprocess.run(
        [sys.executable, "-P", "-m", "vicode.conformance.worker"],
        input="".join(f"{json.dumps(job)}\n" for job in jobs),
        capture_output=True,
        text=True,
        encoding="utf-8",
        cwd=folder,
        env=fresh_environment(PYTHONDONTWRITEBYTECODE="1", PYTHONHASHSEED="0"),
        check=False,
    )
    lines = done.stdout.splitlines()
    if done.returncode or len(lines) != len(jobs):
        raise CodeRunError(f"the process failed: {done.stderr.strip()[-2000:]}")
    return [json.loads(line) for line in lines]


def _python_job(name: str, run: ConformanceRun, folder: Path, modules: Path | None) -> dict[str, Any]:
    project = _with_stubs(replace(run.project, name=name), run)
    files = generate(project, languages=("python",), components=(run.root,))
    place = folder / f"python_{name}"
    apply_diffs(compare_files(files, place), place)
    stubs = {each.component for each in run.inputs if each.kind is InputKind.STUB}
    stubs |= {item.component for item in used_interfaces(run.project, run.root) if not item.is_generated}
    return {
        "kind": "python",
        "component": python_class_path(project, run.root),
        "path": _path(place, modules),
        "stubs": [asdict(_stub(run, component)) for component in sorted(stubs)],
        **_common(run),
    }


def _simulator_job(name: str, run: ConformanceRun, folder: Path, modules: Path | None) -> dict[str, Any]:
    project = replace(run.project, name=name, designs=tuple(run.project.designs))
    design = project.design(run.root)
    assert design is not None
    prepared = prepare_run(project, design, RunConfig(), {}, folder)
    place = folder / f"simulator_{name}"
    apply_diffs(compare_files(prepared.files, place), place)
    stubs = tuple(_stub(run, each.component) for each in prepared.setup.stubs)
    setup = replace(prepared.setup, stubs=stubs, path=tuple(_path(place, modules)))
    return {"kind": "simulator", "setup": encode_setup(setup).decode(), "path": list(setup.path), **_common(run)}


def _path(place: Path, modules: Path | None) -> list[str]:
    return [str(place / "python"), *([str(modules)] if modules else [])]


def _common(run: ConformanceRun) -> dict[str, Any]:
    return {
        "inputs": [asdict(each) for each in run.inputs],
        "frequencies": {item.component: item.frequency_hz for item in used_interfaces(run.project, run.root)},
        "behaviors": [
            python_attribute_name(item.xabsl_name or snake_case(item.component))
            for item in used_interfaces(run.project, run.root)
            if item.implementation == WORLD
        ],
    }


def _inputs_of(run: ConformanceRun) -> dict[str, Any]:
    """The clock and the time of each iteration, and its inputs."""
    return {
        "steps": [
            [step.time_ns, time_ns, [[[*key, value] for key, value in each.items()] for each in step.inputs]]
            for time_ns, step in zip(iteration_times(run), run.steps, strict=True)
        ],
        "robots": run.robots,
        "team_ticks": run.team_ticks,
    }


def _stub(run: ConformanceRun, component: str) -> Stub:
    outputs = tuple(
        StubOutput(name=each.name, type=each.type, value=each.initial, is_function=each.arguments is not None)
        for each in run.inputs
        if each.component == component
    )
    return Stub(component=component, outputs=outputs, is_live=not run.holds_outputs)


def _with_stubs(project: Project, run: ConformanceRun) -> Project:
    """The project with stubs in place of components that are written by hand."""
    used = {item.component for item in used_interfaces(run.project, run.root) if not item.is_generated}
    components = (
        replace(item, implementation=f"{STUB_MODULE}:{item.component}") if item.component in used else item
        for item in project.components
    )
    return replace(project, components=tuple(components))
