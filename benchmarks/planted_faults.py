"""Which faults planted in generators, runtimes and the simulator `vicode conform` and its tests notice.

`python -m benchmarks.planted_faults [--only WORD] [--tests]`

Each fault replaces a short text in a copy of the checkout. The reference interpreter is not changed; its traces are
computed once. A fault is noticed by

- samples: the inputs that `conform` chooses for the designs of `designs/`,
- designs: inputs chosen for the designs of tests/conformance/cases, which use every construct of the language,
- cases: the inputs written in these cases, and random designs, as tests/conformance compares them,
- tests (with --tests): tests/bica, tests/generators or tests/cpp, if none of the above notices it.
"""

import argparse
import json
import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.fault_table import RUNTIME_FAULTS, Fault
from benchmarks.generator_faults import GENERATOR_FAULTS
from benchmarks.mutants import ROOT, copy_checkout
from tests.conformance.compared_runs import add_chosen, run_cpp
from tests.conformance.conformance_cases import CASES, Case
from tests.conformance.random_designs import draw_projects
from vicode.conformance.comparison import choose_inputs, find_absent_languages
from vicode.conformance.cpp import find_compiler
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.python import run_python, run_simulator
from vicode.conformance.reference import run_reference
from vicode.conformance.traces import TraceIteration, first_difference, reduce_for
from vicode.conformance.xabsl import run_xabsl
from vicode.store import open_project

SAMPLES = (
    ("designs/blink", "Blink"),
    ("designs/rescue", "walk_corridor"),
    ("designs/meeting", "meet"),
    ("designs/soccer2d", "Goalkeeper"),
    ("designs/forward", "Player"),
)
GROUPS = ("samples", "designs", "cases")
RANDOM_DESIGNS = 6
ITERATIONS = 80
TESTS = {"cpp": ("tests/cpp",), "python": ("tests/bica", "tests/generators"), "xabsl": ("tests/generators",)}


@dataclass(frozen=True, slots=True)
class Comparison:
    """A run with the trace of the reference interpreter (that of Python, if it cannot run the design)."""

    run: ConformanceRun
    expected: list[TraceIteration]
    absent: frozenset[str]


def prepare(folder: Path) -> dict[str, Comparison]:
    """The comparisons by name: the design, the group and the number of the run."""
    runs: dict[str, ConformanceRun] = {}
    absent: dict[str, Mapping[str, str]] = {}
    for place, root in SAMPLES:
        chosen = choose_inputs(open_project(ROOT / place).project, root, iterations=500, seed=0)
        runs |= {f"{root.lower()}__samples{number}": run for number, run in enumerate(chosen)}
    for file in sorted(CASES.glob("*.yaml")):
        case = Case(file, folder / file.stem)
        case.folder.mkdir()
        runs[f"{case.name}__cases"] = case.run
        name = f"{case.name}__designs"
        add_chosen(runs, absent, name, case.project, root=case.root, iterations=ITERATIONS, seed=0)
    for number, project in enumerate(draw_projects(RANDOM_DESIGNS)):
        add_chosen(runs, absent, f"random{number}__cases", project, iterations=40, seed=number)
    found = {}
    for name, run in runs.items():
        reason = find_absent_languages(run)
        try:
            expected = run_reference(run)
        except ValueError:
            expected = run_python({"sample": run}, folder)["sample"]
        found[name] = Comparison(run, expected, frozenset(reason))
    return found


def find_noticed(comparisons: Mapping[str, Comparison], languages: tuple[str, ...], folder: Path) -> dict[str, str]:
    """The first difference of each group, by the languages that a fault concerns."""
    noticed: dict[str, str] = {}
    for language in languages:
        missing = [group for group in GROUPS if group not in noticed]
        fit = {
            name: each
            for name, each in comparisons.items()
            if group_of(name) in missing and language not in each.absent
        }
        if not fit:
            break
        noticed = {**_differences(fit, language, folder / language), **noticed}
    return noticed


def group_of(name: str) -> str:
    return name.partition("__")[2].rstrip("_0123456789")


def _differences(comparisons: Mapping[str, Comparison], language: str, folder: Path) -> dict[str, str]:
    folder.mkdir()
    runs = {name: each.run for name, each in comparisons.items()}
    try:
        traces = _run(language, runs, folder)
    except Exception as error:
        groups = sorted({group_of(name) for name in runs})
        if len(groups) == 1:
            return {groups[0]: f"{language}: {type(error).__name__}: {str(error)[-160:]}"}
        found: dict[str, str] = {}
        for group in groups:
            part = {name: each for name, each in comparisons.items() if group_of(name) == group}
            found |= _differences(part, language, folder / group)
        return found
    noticed: dict[str, str] = {}
    for name, each in comparisons.items():
        difference = first_difference(reduce_for(language, each.expected), reduce_for(language, traces[name]))
        if difference is not None:
            words = f"{language}: {name}: {difference.component} {difference.field} {difference.values}"
            noticed.setdefault(group_of(name), words)
    return noticed


def _run(language: str, runs: dict[str, ConformanceRun], folder: Path) -> dict[str, list[TraceIteration]]:
    match language:
        case "python":
            return run_python(runs, folder)
        case "simulator":
            return run_simulator(runs, folder)
        case "xabsl":
            return {name: run_xabsl(run) for name, run in runs.items()}
        case _:
            return run_cpp(runs, folder, find_compiler() or "")


def try_fault(fault: Fault, copy: Path, state: Path, *, with_tests: bool) -> dict[str, str]:
    """Plant a fault in a copy of the checkout, compare there, and remove it.

    Raises:
        ValueError: Its text does not occur exactly once.
    """
    target = copy / fault.file
    source = target.read_text(encoding="utf-8")
    if source.count(fault.old) != 1:
        raise ValueError(f"{fault.file}: '{fault.doc}' replaces a text that occurs {source.count(fault.old)} times")
    target.write_text(source.replace(fault.old, fault.new), encoding="utf-8")
    try:
        environment = {**os.environ, "PYTHONPATH": str(copy)}
        command = [sys.executable, "-m", "benchmarks.planted_faults", "--child", str(state), *fault.languages]
        done = subprocess.run(command, cwd=copy, env=environment, capture_output=True, text=True, check=False)
        if done.returncode:
            return dict.fromkeys(GROUPS, f"it ends with {done.stderr.strip().splitlines()[-1:]}")
        noticed = dict(json.loads(done.stdout.splitlines()[-1]))
        if with_tests and not noticed:
            noticed |= _run_tests(fault, copy, environment)
        return noticed
    finally:
        target.write_text(source, encoding="utf-8")


def _run_tests(fault: Fault, copy: Path, environment: Mapping[str, str]) -> dict[str, str]:
    for language in fault.languages:
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-m", "not browser and not nightly"]
        done = subprocess.run(
            [*command, *TESTS.get(language, ("tests/simulation",))],
            cwd=copy,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
        if failed:
            return {"tests": failed[0]}
    return {}


def report(results: list[tuple[Fault, dict[str, Any]]]) -> Iterator[str]:
    """The table in Markdown, and the counts."""
    yield "| file | fault | samples | designs | cases |"
    yield "|---|---|---|---|---|"
    for fault, noticed in results:
        marks = " | ".join("yes" if group in noticed else "–" for group in GROUPS)
        yield f"| {fault.file.removeprefix('vicode/')} | {fault.doc} | {marks} |"
    for group in GROUPS:
        count = sum(group in noticed for _fault, noticed in results)
        yield f"{group}: {count} of {len(results)} faults noticed"


def main() -> None:
    """Try the faults, and print how each was noticed and the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="try faults whose file or words contain this")
    parser.add_argument(
        "--tests", action="store_true", help="run the tests of the package if nothing else notices a fault"
    )
    parser.add_argument("--child", nargs="+", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        state, *languages = options.child
        comparisons = pickle.loads(Path(state).read_bytes())
        with tempfile.TemporaryDirectory() as folder:
            print(json.dumps(find_noticed(comparisons, tuple(languages), Path(folder))))
        return
    chosen = [each for each in (*RUNTIME_FAULTS, *GENERATOR_FAULTS) if options.only in f"{each.file} {each.doc}"]
    results = []
    with tempfile.TemporaryDirectory() as folder:
        copy, cases, state = (Path(folder) / name for name in ("copy", "cases", "state"))
        copy.mkdir()
        cases.mkdir()
        copy_checkout(copy)
        state.write_bytes(pickle.dumps(prepare(cases)))
        for fault in chosen:
            noticed = try_fault(fault, copy, state, with_tests=options.tests)
            results.append((fault, noticed))
            print(f"{fault.file}: {fault.doc}\n  {noticed or 'NOT NOTICED'}", flush=True)
    print("\n".join(report(results)))


if __name__ == "__main__":
    main()
