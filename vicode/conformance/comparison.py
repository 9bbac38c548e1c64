"""Compares all languages that can express a design."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from vicode.check import check_project
from vicode.conformance.cpp import COMPILER_MISSING, CompileError, CppProgram, ProgramError, find_compiler
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.python import CodeRunError, run_python, run_simulator
from vicode.conformance.report import explain
from vicode.conformance.traces import TraceIteration, first_difference, reduce_for
from vicode.conformance.xabsl import run_xabsl
from vicode.editor.session.simulation.setup import NotReadyError
from vicode.findings import Finding, Severity
from vicode.generators import UnsoundDesignError, collect_components
from vicode.simulation.language_comparison import AbsentLanguage, LanguageComparison, LanguageDifference

GENERATED = ("python", "cpp", "xabsl")
_MS = 1_000_000
Traces = list[list[TraceIteration]]
"""The traces of a language, one per run."""


def find_absent_languages(run: ConformanceRun) -> dict[str, str]:
    """The languages that cannot run a design, with the reason."""
    return {language: absent.reason for language, absent in _find_absent(run).items()}


def _find_absent(run: ConformanceRun) -> dict[str, AbsentLanguage]:
    project = replace(run.project, languages=GENERATED)
    findings = check_project(project, collect_components(project, (run.root,)))
    errors = [each for each in findings if each.severity is Severity.ERROR]
    absent: dict[str, AbsentLanguage] = {}
    for language in GENERATED:
        found = [each for each in errors if each.applies_to(language)]
        absent |= {language: _absent_by(language, found[0])} if found else {}
    if "python" in absent:
        absent["simulator"] = replace(absent["python"], language="simulator")
    if run.robots > 1:
        absent["simulator"] = AbsentLanguage(language="simulator", reason="the simulator runs one robot")
    if "xabsl" not in absent and any(step.time_ns % _MS for step in run.steps):
        absent["xabsl"] = AbsentLanguage(language="xabsl", reason="times of XABSL are whole milliseconds")
    return absent


def _absent_by(language: str, finding: Finding) -> AbsentLanguage:
    subject = finding.subject
    return AbsentLanguage(
        language=language,
        reason=finding.message,
        component=subject.component if subject else "",
        path=tuple(map(str, subject.path)) if subject else (),
    )


def compare_languages(
    runs: Sequence[ConformanceRun],
    folder: Path,
    modules: Path | None = None,
    on_language: Callable[[str], None] = lambda _language: None,
) -> LanguageComparison:
    """Run a design in each language that can express it, and compare the traces with that of Python.

    Args:
        runs: Runs of one design.
        folder: An empty folder.
        modules: The folder of modules that code of the design imports.
        on_language: Is called before a language runs.
    """
    absent = _find_absent(runs[0])
    compiler = find_compiler()
    if compiler is None:
        absent.setdefault("cpp", AbsentLanguage(language="cpp", reason=COMPILER_MISSING))
    named = {f"run{number}": run for number, run in enumerate(runs)}
    runners: dict[str, Callable[[], Traces]] = {
        "python": lambda: list(run_python(named, folder, modules).values()),
        "cpp": lambda: _run_cpp(runs, folder, compiler or ""),
        "xabsl": lambda: [run_xabsl(run) for run in runs],
        "simulator": lambda: list(run_simulator(named, folder, modules).values()),
    }
    traces: dict[str, Traces] = {}
    failed = []
    for language in (each for each in runners if each not in absent):
        on_language(language)
        try:
            traces[language] = runners[language]()
        except (UnsoundDesignError, NotReadyError) as error:
            absent[language] = AbsentLanguage(language=language, reason=str(error))
        except (CompileError, ProgramError, CodeRunError) as error:
            failed.append(AbsentLanguage(language=language, reason=str(error)))
    others = (language for language in traces if language != "python" and "python" in traces)
    differences = (_find_difference(runs, traces["python"], language, traces[language]) for language in others)
    return LanguageComparison(
        languages=tuple(traces),
        absent=tuple(absent.values()),
        failed=tuple(failed),
        differences=tuple(each for each in differences if each is not None),
        iterations=sum(len(run.steps) for run in runs),
        runs=len(runs),
    )


def _run_cpp(runs: Sequence[ConformanceRun], folder: Path, compiler: str) -> Traces:
    """Compile once and run all; the runs differ in their inputs."""
    program = CppProgram({"compared": runs[0]}, folder, compiler)
    return [program.run({"compared": run})["compared"] for run in runs]


def _find_difference(
    runs: Sequence[ConformanceRun], expected: Traces, language: str, got: Traces
) -> LanguageDifference | None:
    for number, run in enumerate(runs):
        sides = {"python": reduce_for(language, expected[number]), language: reduce_for(language, got[number])}
        found = first_difference(*sides.values())
        if found is not None:
            return explain(found, sides, run, number)
    return None
