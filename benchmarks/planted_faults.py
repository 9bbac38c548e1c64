"""Which faults planted in generators, runtimes and the simulator `vicode conform` and the tests notice.

`python -m benchmarks.planted_faults [--only WORD] [--designs WORD] [--tests] [--results FILE]`

Each fault replaces a short text in a copy of the checkout. The reference interpreter is not changed; its traces are
computed once. A fault is noticed by

- samples: the inputs that `conform` chooses for the designs of `designs/`,
- designs: inputs chosen for the designs of tests/conformance/cases, which use every construct of the language,
- cases: the inputs written in these cases, and random designs, as tests/conformance compares them,
- tests (with --tests): the unit tests of `TESTS`, which must pass without faults. One that fails counts; a process
  that ends in another way, or takes too long, does not.

A fault of a generator that leaves the code of a design as it is cannot be noticed there, and is not run. If that is so
for all samples, they do not contain what the fault concerns.
"""

import argparse
import hashlib
import json
import os
import pickle
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from benchmarks.fault_table import RUNTIME_FAULTS, Fault
from benchmarks.fault_tests import FaultTests
from benchmarks.generator_faults import GENERATOR_FAULTS
from benchmarks.mutants import ROOT, copy_checkout
from tests.conformance.compared_runs import add_chosen, run_cpp
from tests.conformance.conformance_cases import CASES, Case
from tests.conformance.random_designs import draw_projects
from vicode.conformance.comparison import choose_inputs, find_absent_languages
from vicode.conformance.cpp import CompileError, ProgramError, find_compiler
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.python import CodeRunError, run_python, run_simulator
from vicode.conformance.reference import run_reference
from vicode.conformance.traces import TraceIteration, first_difference, reduce_for
from vicode.conformance.xabsl import run_xabsl
from vicode.generators import GENERATORS, generate
from vicode.store import open_project

FAULTS = (*RUNTIME_FAULTS, *GENERATOR_FAULTS)
SAMPLES = (
    ("designs/blink", "Blink"),
    ("designs/rescue", "walk_corridor"),
    ("designs/rescue", "drive_circle"),
    ("designs/meeting", "meet"),
    ("designs/soccer2d", "Goalkeeper"),
    ("designs/soccer2d", "FieldPlayer"),
    ("designs/forward", "Player"),
)
GROUPS = ("samples", "designs", "cases")
RANDOM_DESIGNS = 6
ITERATIONS = 80
DESIGNS_AT_ONCE = 14
LONGEST_S = 3600


@dataclass(frozen=True, slots=True)
class Comparison:
    """A run with the trace of the reference interpreter (that of Python, if it cannot run the design).

    Attributes:
        code: Hashes of the generated code by language.
    """

    run: ConformanceRun
    expected: list[TraceIteration]
    absent: frozenset[str]
    code: Mapping[str, str]


def prepare(folder: Path, word: str) -> dict[str, Comparison]:
    """The comparisons of designs whose name contains a word, by name: the design, the group and the number."""
    runs: dict[str, ConformanceRun] = {}
    for place, root in SAMPLES:
        if word in root.lower():
            chosen = choose_inputs(open_project(ROOT / place).project, root, iterations=500, seed=0)
            runs |= {f"{root.lower()}__samples{number}": run for number, run in enumerate(chosen)}
    absent: dict[str, Mapping[str, str]] = {}
    for file in sorted(CASES.glob("*.yaml")):
        case = Case(file, folder / file.stem)
        if word in case.name:
            case.folder.mkdir()
            runs[f"{case.name}__cases"] = case.run
            name = f"{case.name}__designs"
            add_chosen(runs, absent, name, case.project, root=case.root, iterations=ITERATIONS, seed=0)
    for number, project in enumerate([] if word else draw_projects(RANDOM_DESIGNS)):
        add_chosen(runs, absent, f"random{number}__cases", project, iterations=40, seed=number)
    return {name: _with_expected(run, folder) for name, run in runs.items()}


def _with_expected(run: ConformanceRun, folder: Path) -> Comparison:
    absent = frozenset(find_absent_languages(run))
    try:
        expected = run_reference(run)
    except ValueError:
        expected = run_python({"sample": run}, folder)["sample"]
    return Comparison(run, expected, absent, {each: _hash_code(run, each) for each in GENERATORS if each not in absent})


def _hash_code(run: ConformanceRun, language: str) -> str:
    files = generate(run.project, languages=(language,), components=(run.root,))
    return hashlib.sha256("".join(f"{file.path}\n{file.text}\n" for file in files).encode()).hexdigest()


def find_noticed(
    comparisons: Mapping[str, Comparison], languages: tuple[str, ...], folder: Path, *, is_generated: bool
) -> dict[str, str]:
    """The first difference of each group, by the languages that a fault concerns.

    "same code" names the groups in which no generated code changes.

    Args:
        comparisons: The comparisons by name.
        languages: The languages.
        folder: An empty folder.
        is_generated: Whether the fault only concerns generated code.
    """
    noticed: dict[str, str] = {}
    same = {group_of(name) for name in comparisons} if is_generated else set()
    for language in languages:
        able = {name: each for name, each in comparisons.items() if language not in each.absent}
        if is_generated:
            source = "python" if language == "simulator" else language
            changed = {name: each.code[source] != _hash_code(each.run, source) for name, each in able.items()}
            able = {name: each for name, each in able.items() if changed[name]}
            same -= {group_of(name) for name in able}
        designs = list(dict.fromkeys(map(design_of, able)))
        for start in range(0, len(designs), DESIGNS_AT_ONCE):
            names = designs[start : start + DESIGNS_AT_ONCE]
            rest = {
                name: each for name, each in able.items() if design_of(name) in names and group_of(name) not in noticed
            }
            if rest:
                noticed = {**_differences(rest, language, folder / f"{language}{start}"), **noticed}
    return {**noticed, **({"same code": " ".join(sorted(same))} if same else {})}


def design_of(name: str) -> str:
    return name.partition("__")[0]


def group_of(name: str) -> str:
    return name.partition("__")[2].rstrip("_0123456789")


def _differences(comparisons: Mapping[str, Comparison], language: str, folder: Path) -> dict[str, str]:
    """The first difference of each group; an error that `conform` reports is one, any other is raised."""
    folder.mkdir()
    runs = {name: each.run for name, each in comparisons.items()}
    try:
        traces = _run(language, runs, folder)
    except (CompileError, ProgramError, CodeRunError) as error:
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


def try_fault(fault: Fault, copy: Path, state: Path, tests: FaultTests | None) -> dict[str, str]:
    """Plant a fault in a copy of the checkout, compare there, and remove it.

    Returns:
        Who noticed it, and "failed" if something could not be tried.

    Raises:
        ValueError: Its text does not occur exactly once.
    """
    target = copy / fault.file
    source = target.read_text(encoding="utf-8")
    target.write_text(fault.plant(source), encoding="utf-8")
    try:
        found = _compare(fault, copy, state)
        return {**found, **(tests.run(fault) if tests is not None else {})}
    finally:
        target.write_text(source, encoding="utf-8")


def _compare(fault: Fault, copy: Path, state: Path) -> dict[str, str]:
    environment = {**os.environ, "PYTHONPATH": str(copy)}
    command = [sys.executable, "-m", "benchmarks.planted_faults", "--child", str(state), fault.file, *fault.languages]
    try:
        done = subprocess.run(
            command, cwd=copy, env=environment, capture_output=True, text=True, check=False, timeout=LONGEST_S
        )
    except subprocess.TimeoutExpired:
        return {"failed": "comparing takes too long"}
    if done.returncode:
        return {"failed": f"comparing ends with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}"}
    return dict(json.loads(done.stdout.splitlines()[-1]))


def report(results: Iterable[tuple[Fault, Mapping[str, str]]], columns: tuple[str, ...]) -> Iterator[str]:
    """The table in Markdown, and the counts."""
    found = list(results)
    yield f"| file | fault | {' | '.join(columns)} |"
    yield "|---|---|" + "---|" * len(columns)
    for fault, noticed in found:
        marks = " | ".join("yes" if group in noticed else "–" for group in columns)
        reason = f" (same traces: {fault.equivalent})" if fault.equivalent else ""
        yield f"| {fault.file.removeprefix('vicode/')} | {fault.doc}{reason} | {marks} |"
    for group in columns:
        tried = [pair for pair in found if "failed" not in pair[1]]
        missed = [(fault, noticed) for fault, noticed in tried if group not in noticed]
        equivalent = sum(bool(fault.equivalent) for fault, _noticed in missed)
        same = sum(group in noticed.get("same code", "") for _fault, noticed in missed)
        yield (
            f"{group}: {len(tried) - len(missed)} of {len(tried)} faults noticed; of the others, {equivalent} change "
            f"no trace, and {same} no code there"
        )
    for fault, noticed in found:
        if "failed" in noticed:
            yield f"not counted: {fault.file}: {fault.doc}: {noticed['failed']}"


def _read_results(file: Path | None) -> dict[tuple[str, str], dict[str, str]]:
    """What earlier runs found, by file and words of the fault."""
    found: dict[tuple[str, str], dict[str, str]] = defaultdict(dict)
    if file is not None and file.exists():
        for line in file.read_text(encoding="utf-8").splitlines():
            name, doc, noticed = json.loads(line)
            found[name, doc] = noticed
    return found


def _run_child(state: str, file: str, *languages: str) -> None:
    comparisons: dict[str, Comparison] = pickle.loads(Path(state).read_bytes())
    is_generated = file.startswith("vicode/generators/")
    with tempfile.TemporaryDirectory() as folder:
        print(json.dumps(find_noticed(comparisons, languages, Path(folder), is_generated=is_generated)))


def main() -> None:
    """Try the faults, and print how each was noticed and the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="try faults whose file or words contain this")
    parser.add_argument("--designs", default="", help="compare only designs whose names contain this, and nothing else")
    parser.add_argument("--tests", action="store_true", help="also run tests with each fault")
    parser.add_argument("--results", type=Path, help="a file that keeps results; faults in it are not tried again")
    parser.add_argument("--child", nargs="+", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        _run_child(*options.child)
        return
    chosen = [each for each in FAULTS if options.only in f"{each.file}: {each.doc}"]
    known = _read_results(options.results)
    with tempfile.TemporaryDirectory() as folder:
        copy, cases, state = (Path(folder) / name for name in ("copy", "cases", "state"))
        copy.mkdir()
        cases.mkdir()
        copy_checkout(copy)
        state.write_bytes(pickle.dumps(prepare(cases, options.designs)))
        tests = FaultTests(copy, chosen) if options.tests else None
        for fault in (each for each in chosen if each.key not in known):
            known[fault.key] = noticed = try_fault(fault, copy, state, tests)
            print(f"{fault.file}: {fault.doc}\n  {noticed}", flush=True)
            if options.results:
                with options.results.open("a", encoding="utf-8") as file:
                    file.write(f"{json.dumps([*fault.key, noticed])}\n")
    columns = (*GROUPS, *(["tests"] if options.tests else []))
    print("\n".join(report(((each, known[each.key]) for each in chosen), columns)))


if __name__ == "__main__":
    main()
