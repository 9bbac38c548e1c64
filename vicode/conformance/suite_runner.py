"""Runs the suites of a folder in pytest: each case in each language of its design.

The module that `vicode test` writes beside the suites calls `list_cases`. The code of a design is generated from its
file as it is now, once for all cases of a suite, and runs in another process.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from unittest import SkipTest

from vicode.conformance.cpp import COMPILER_MISSING, CompileError, ProgramError, find_tools, run_cpp
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.python import CodeRunError, run_python
from vicode.conformance.recorded_inputs import recorded_run
from vicode.conformance.reference import run_reference
from vicode.conformance.result import LANGUAGE_TITLES
from vicode.conformance.suite import (
    Suite,
    SuiteCase,
    SuiteError,
    find_mismatch,
    iterate_expected,
    list_files,
    make_case,
    make_run,
    observe,
    read_suite,
)
from vicode.conformance.traces import TraceIteration, TraceNormalizer
from vicode.generators import UnsoundDesignError
from vicode.model.project import Project
from vicode.output import temporary_folder
from vicode.simulation import IterationResult
from vicode.store import open_project


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseRun:
    """A case in a language; its text is the name of the test."""

    file: Path
    language: str
    index: int
    name: str

    def __str__(self) -> str:
        return f"{self.file.name.partition('.')[0]}-{self.language}-{self.name}"

    def check(self) -> None:
        """Run the case.

        Raises:
            AssertionError: A step has another result than expected, or the case cannot run.
            SkipTest: There is no compiler; pytest reports the test as skipped.
        """
        __tracebackhide__ = True
        problem = _find_problems(self.file, self.language)[self.index]
        if problem:
            raise AssertionError(problem)


def list_cases(module: str) -> list[CaseRun]:
    """The cases of all suites in the folder of a module, in their languages.

    Raises:
        SuiteError: A file is no suite.
    """
    return [
        CaseRun(file=file, language=language, index=index, name=case.name)
        for file in list_files(Path(module).resolve().parent)
        for suite in (read_suite(file),)
        for language in suite.languages
        for index, case in enumerate(suite.cases)
    ]


@cache
def _find_problems(file: Path, language: str) -> Sequence[str]:
    """What is wrong with each case of a suite; "" for nothing."""
    suite = read_suite(file)
    try:
        opened = open_project(file.parent / suite.design)
        return check_suite(suite, opened.project, opened.folder.resolve(), language)
    except (CodeRunError, CompileError, OSError, ProgramError, SuiteError, UnsoundDesignError) as error:
        problem = f"{file}: {error}\nAfter a change of the design on purpose, write the suite again with 'vicode test'."
        return [problem] * len(suite.cases)


def check_suite(suite: Suite, project: Project, folder: Path, language: str) -> Sequence[str]:
    """What is wrong with each case of a suite; "" for nothing.

    Args:
        suite: The suite.
        project: The project of its design.
        folder: Its folder, with the modules that the code of the design imports.
        language: "python", "cpp", or "reference" for the reference interpreter.

    Raises:
        SuiteError: The suite does not fit the design.
        UnsoundDesignError, CodeRunError, CompileError, ProgramError: The code cannot be generated or run.
        SkipTest: There is no compiler.
    """
    runs = {index: make_run(suite, case, project) for index, case in enumerate(suite.cases)}
    traces = _run(runs, folder, language)
    title = LANGUAGE_TITLES[language]
    return [_compare(case, title, project, traces[index]) for index, case in enumerate(suite.cases)]


def replay_as_case(
    name: str, project: Project, root: str, iterations: Sequence[IterationResult], folder: Path
) -> SuiteCase:
    """The case of a recorded run: its inputs, and what the generated Python makes of them now.

    Raises:
        SuiteError: The states differ from those of the record.
        UnsoundDesignError, CodeRunError: The code cannot be generated or run.
    """
    run = recorded_run(project, root, iterations, is_exact=True)
    seen = list(observe(project, _run({0: run}, folder, "python")[0]))
    normalizer = TraceNormalizer(project)
    records = ({"iteration": each.iteration, "time_ns": each.time_ns, "tree": each.tree} for each in iterations)
    for step, record in zip(seen, map(normalizer.iteration, records), strict=True):
        (recorded,) = observe(project, [record])
        for component in (each.component for each in project.designs):
            if step.get(component) != recorded.get(component):
                states = f"{component} is {step.get(component)}, recorded {recorded.get(component)}"
                raise SuiteError(f"the design does not behave as recorded: {record.time_ns / 1e9:g} s, {states}")
    return make_case(name, run, seen, {})


def _run(runs: Mapping[int, ConformanceRun], folder: Path, language: str) -> Mapping[int, list[TraceIteration]]:
    if language == "reference":
        return {index: run_reference(run) for index, run in runs.items()}
    with temporary_folder("test") as temporary:
        if language == "python":
            traces = run_python({f"case{index}": run for index, run in runs.items()}, temporary, folder)
            return dict(zip(runs, traces.values(), strict=True))
        if (tools := find_tools()) is None:
            raise SkipTest(COMPILER_MISSING)
        return run_cpp(runs, temporary, tools)


def _compare(case: SuiteCase, title: str, project: Project, trace: Sequence[TraceIteration]) -> str:
    for index, (expected, seen) in enumerate(zip(iterate_expected(case), observe(project, trace), strict=True)):
        found = find_mismatch(expected, seen)
        if found is not None:
            return _describe(case, index, title, found)
    return ""


def _describe(case: SuiteCase, index: int, title: str, found: tuple[str, Any, Any]) -> str:
    name, expected, got = (each if each is not None else "nothing" for each in found)
    step = case.steps[index]
    place = f"step {index + 1} of {len(case.steps)}, {step.time_ns / 1e9:g} s"
    lines = [f"{case.name}, {place}, {title}: {name} is {got}, expected {expected}"]
    given = dict[str, Any]()
    for each in case.steps[: index + 1]:
        given |= each.set
    lines += [f"the step shows: {step.shows}"] if step.shows else []
    return "\n".join([*lines, *(f"  {key} = {value}" for key, value in given.items())])
