"""Runs many designs in all languages at once."""

from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from tests.cpp_tools import unoptimized
from vicode.conformance.chosen_inputs import choose_runs
from vicode.conformance.comparison import find_absent_languages
from vicode.conformance.cpp import CppProgram
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.javascript import find_node, run_javascript
from vicode.conformance.python import run_python, run_simulator
from vicode.conformance.reference import run_reference
from vicode.conformance.traces import TraceIteration
from vicode.conformance.xabsl import run_xabsl
from vicode.generators.cpp.compiler import find_compiler
from vicode.model.project import Project

Runs = Mapping[str, ConformanceRun]
"""Runs by name; those of one design have names such as `timers__2`."""
Traces = Mapping[str, Mapping[str, list[TraceIteration]]]
"""Traces by language and name of the run."""


def add_chosen(
    runs: dict[str, ConformanceRun],
    absent: dict[str, Mapping[str, str]],
    name: str,
    project: Project,
    *,
    root: str = "Player",
    iterations: int,
    seed: int,
) -> None:
    """Add runs of a design whose inputs are chosen, and the languages that cannot run each."""
    in_xabsl = "xabsl" not in find_absent_languages(ConformanceRun(project=project, root=root, steps=()))
    for number, run in enumerate(choose_runs(project, root, iterations=iterations, seed=seed, in_xabsl=in_xabsl)):
        runs[f"{name}__{number}"] = run
        absent[f"{name}__{number}"] = find_absent_languages(run)


def compare_all(runs: Runs, absent: Mapping[str, Mapping[str, str]], folder: Path) -> Traces:
    """Run everything in each language that can."""

    def able(language: str) -> dict[str, ConformanceRun]:
        return {name: run for name, run in runs.items() if language not in absent[name]}

    return {
        "reference": {name: run_reference(run) for name, run in runs.items()},
        "python": run_python(able("python"), folder),
        # Without a compiler, one test fails, and the other languages are compared.
        "cpp": run_cpp(able("cpp"), folder, compiler) if (compiler := find_compiler()) else {},
        "xabsl": {name: run_xabsl(run) for name, run in able("xabsl").items()},
        # Without Node.js, one test is skipped, and the other languages are compared.
        "javascript": run_javascript(able("javascript"), folder) if find_node() else {},
        "simulator": run_simulator(able("simulator"), folder),
    }


def run_cpp(runs: Runs, folder: Path, compiler: str) -> dict[str, list[TraceIteration]]:
    """Compile each design once, and run all its inputs."""
    names = defaultdict[str, list[str]](list)
    for name in runs:
        names[name.partition("__")[0]].append(name)
    first = {design: runs[each[0]] for design, each in names.items()}
    program = CppProgram(first, folder, unoptimized(compiler), programs=2)
    traces: dict[str, list[TraceIteration]] = {}
    for number in range(max(map(len, names.values()))):
        # The program runs all designs; those with fewer runs repeat the last one.
        chosen = {design: each[min(number, len(each) - 1)] for design, each in names.items()}
        found = program.run({design: runs[name] for design, name in chosen.items()})
        traces |= {chosen[design]: trace for design, trace in found.items()}
    return traces
