"""Write regression tests of a design, from its guards or from a recorded run, and measure which faults they notice."""

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.cli.coverage_report import report_coverage, report_mutants
from vicode.cli.root_selection import select_root

if TYPE_CHECKING:
    from vicode.conformance.inputs import ConformanceRun
    from vicode.conformance.suite import Suite, SuiteCase
    from vicode.store import OpenProject

_FOLDER = "tests"
_MARK = '"""Runs the suites of this folder. `vicode test` writes this file'
_TITLE = f'{_MARK} and keeps changes of it."""'
_MODULE = f"""{_TITLE}

import pytest

from vicode.conformance.suite_runner import CaseRun, list_cases


@pytest.mark.parametrize("case", list_cases(__file__), ids=str)
def test_case(case: CaseRun) -> None:
    case.check()
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the commands of `vicode test`."""
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, add, act in (("gen", _add_gen, _gen), ("record", _add_record, _record), ("mutate", _add_mutate, _mutate)):
        summary = (act.__doc__ or "").split("\n")[0]
        command = commands.add_parser(name, help=summary, description=summary)
        add(command)
        command.set_defaults(act=act)


def run(args: argparse.Namespace) -> int:
    act: Callable[[argparse.Namespace], int] = args.act
    return act(args)


def _add_gen(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("design", metavar="DESIGN", help="a design, or the folder of a project with one agent")
    _add_out(parser)


def _add_record(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("trace", metavar="TRACE", help="a trace recorded with --values, or a robot's record")
    parser.add_argument("--design", metavar="PATH", default=".", help="design or project folder (default: .)")
    _add_out(parser)


def _add_out(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", metavar="FOLDER", help=f"the folder of the tests (default: {_FOLDER} in the project)")


def _add_mutate(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("design", metavar="DESIGN", help="a design, or the folder of a project with one agent")
    parser.add_argument("folder", metavar="FOLDER", nargs="?", help=f"suites (default: {_FOLDER} in the project)")
    parser.add_argument("--traces", metavar="FOLDER", help="use the inputs of the traces (*.jsonl) of a folder instead")


def _gen(args: argparse.Namespace) -> int:
    """Write a test suite of a design: transitions, conditions, limits and the order of guards."""
    from vicode.conformance.suite import GENERATED
    from vicode.conformance.suite_cases import find_cases
    from vicode.semantics import NotInterpretableError

    selected = select_root(args.design, "", "test", are_inputs_given=True)
    if isinstance(selected, int):
        return selected
    opened, component = selected
    try:
        found = find_cases(opened.open_project.project, component)
    except NotInterpretableError as error:
        return _refuse(component, error)
    folder = Path(args.out or opened.open_project.folder / _FOLDER)
    file_stem = opened.open_project.files[component].stem
    suite = _make_suite(opened.open_project, component, folder, source=GENERATED, cases=found.cases)
    _write(opened.open_project, folder, file_stem, suite)
    report_coverage(found.coverage, opened.open_project)
    for reason in found.left_out:
        print(f"left out: steps with code that is not portable ({reason})")
    return 0


def _record(args: argparse.Namespace) -> int:
    """Write a test of a recorded run: its inputs, and the states, outputs and parameters that it had."""
    from vicode.conformance.python import CodeRunError
    from vicode.conformance.suite import SuiteError
    from vicode.conformance.suite_runner import replay_as_case
    from vicode.generators import UnsoundDesignError
    from vicode.services.trace_replay import find_design
    from vicode.traces.reader import TraceError, open_trace

    path = Path(args.trace)
    try:
        iterations = list(open_trace(path).iterations())
    except TraceError as error:
        raise OSError(f"{path}: {error}") from error
    opened, design = find_design(args.design, str(iterations[0].tree[0]["component"]))
    if opened.errors_for("python"):
        print_findings(opened.errors_for("python"), to_stderr=True)
        return 2
    if "values" not in iterations[0].tree[0]:
        raise OSError(f"{path} has no values; record the run with --values")
    project = opened.open_project.project
    try:
        case = replay_as_case(path.stem, project, design.component, iterations, opened.open_project.folder.resolve())
    except (CodeRunError, UnsoundDesignError) as error:
        raise OSError(f"cannot run {path}: {error}") from error
    except SuiteError as error:
        print(f"vicode: {path}: {error}; 'vicode replay' shows the first difference", file=sys.stderr)
        return 1
    folder = Path(args.out or opened.open_project.folder / _FOLDER)
    # Traces of several folders may have the same name.
    source = Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()
    suite = _make_suite(opened.open_project, design.component, folder, source=source, cases=(case,))
    _write(opened.open_project, folder, path.stem, suite)
    return 0


def _mutate(args: argparse.Namespace) -> int:
    """List small faults of a design that its tests would not notice."""
    from vicode.conformance.design_mutants import try_mutants
    from vicode.conformance.suite import observe_records
    from vicode.semantics import NotInterpretableError

    selected = select_root(args.design, "", "test", are_inputs_given=True)
    if isinstance(selected, int):
        return selected
    opened, component = selected
    project = opened.open_project
    try:
        runs = _read_traces(args.traces, project, component) if args.traces else _read_suites(args, project, component)
        report = try_mutants(runs, observe=observe_records(project.project), is_root_only=True)
    except NotInterpretableError as error:
        return _refuse(component, error)
    report_mutants(report, component, project)
    return 0


def _refuse(component: str, error: Exception) -> int:
    print(f"vicode: {component} cannot be tested: the reference interpreter cannot run it: {error}", file=sys.stderr)
    return 2


def _make_suite(
    opened: "OpenProject", component: str, folder: Path, *, source: str, cases: "tuple[SuiteCase, ...]"
) -> "Suite":
    """The suite of a design in the languages of its project that can express it."""
    from vicode.conformance.comparison import find_absent_languages
    from vicode.conformance.inputs import ConformanceRun
    from vicode.conformance.suite import GENERATED, Suite

    empty = ConformanceRun(project=opened.project, root=component, steps=())
    absent = find_absent_languages(empty)
    # The driver of C++ computes outputs with arguments, and has one value of the others for each iteration.
    is_fit = source == GENERATED and all(each.arguments is None for each in empty.inputs)
    wanted = ["python", *(["cpp"] if "cpp" in opened.project.languages and is_fit else [])]
    languages = tuple(each for each in wanted if each not in absent)
    if not languages:
        raise OSError(f"{component} has no code that can be tested: {absent['python']}")
    path = os.path.relpath(opened.files[component].resolve(), folder.resolve())
    return Suite(component=component, design=Path(path).as_posix(), source=source, languages=languages, cases=cases)


def _write(opened: "OpenProject", folder: Path, stem: str, suite: "Suite") -> None:
    """Write a suite and the module that runs it, or neither; a module that was edited stays."""
    from vicode.conformance.suite import SUFFIX, SuiteError, format_suite, read_suite
    from vicode.model.names import package_name
    from vicode.output import write_atomically

    file, module = folder / f"{stem}{SUFFIX}", folder / f"test_{package_name(opened.project.name)}_designs.py"
    if file.exists():
        try:
            old = read_suite(file)
        except SuiteError as error:
            raise OSError(f"{file} is not replaced, as it is no suite; move it, or choose another --out") from error
        if (old.component, old.source) != (suite.component, suite.source):
            made = f"it has tests of {old.component} from {old.source}"
            raise OSError(f"{file} is not replaced: {made}; move it, or choose another --out")
    present = module.read_text(encoding="utf-8", errors="replace") if module.exists() else ""
    if module.exists() and not present.startswith(_MARK):
        raise OSError(f"{module} is not replaced, as 'vicode test' did not write it; move it, or choose another --out")
    folder.mkdir(parents=True, exist_ok=True)
    write_atomically(file, format_suite(suite))
    if not present:
        write_atomically(module, _MODULE)
    elif present != _MODULE:
        print(f"kept {module}, which differs from what 'vicode test' writes; remove it to have it written again")
    cases = f"{len(suite.cases)} case{'s' * (len(suite.cases) != 1)}"
    print(f"wrote {file}: {cases}, {suite.steps} steps; run them with 'pytest {folder}'")


def _read_suites(args: argparse.Namespace, opened: "OpenProject", component: str) -> "list[ConformanceRun]":
    """The runs of all suites of a design, which must hold."""
    from vicode.conformance.suite import SuiteError, list_files, make_run, read_suite
    from vicode.conformance.suite_runner import check_suite

    folder = Path(args.folder or opened.folder / _FOLDER)
    runs: list[ConformanceRun] = []
    for file in list_files(folder):
        try:
            suite = read_suite(file)
        except SuiteError as error:
            raise OSError(str(error)) from error
        if suite.component != component:
            continue
        try:
            problems = check_suite(suite, opened.project, opened.folder, "reference")
            runs += (make_run(suite, case, opened.project) for case in suite.cases)
        except SuiteError as error:
            raise OSError(f"{file}: {error}") from error
        problem = next(filter(None, problems), "")
        if problem:
            raise OSError(f"{file} does not hold for the design as it is: {problem}")
    if not runs:
        raise OSError(f"no suite of {component} in {folder}; write one with 'vicode test gen {args.design}'")
    return runs


def _read_traces(folder: str, opened: "OpenProject", component: str) -> "list[ConformanceRun]":
    """The inputs of the traces of a component in a folder."""
    from vicode.conformance.recorded_inputs import recorded_run
    from vicode.traces.reader import TraceError, open_trace

    runs = []
    for file in sorted(Path(folder).glob("*.jsonl")):
        try:
            iterations = list(open_trace(file).iterations())
        except TraceError as error:
            raise OSError(f"{file}: {error}") from error
        if iterations[0].tree[0]["component"] == component:
            runs.append(recorded_run(opened.project, component, iterations, is_exact=True))
    if not runs:
        raise OSError(f"no trace of {component} in {folder}; record one with 'vicode run … --trace FILE --values'")
    return runs
