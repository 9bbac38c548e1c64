"""Compares all languages that can express a design."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from vicode.check import check_project
from vicode.conformance.cpp import COMPILER_MISSING, CppProgram, find_compiler
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.python import run_python, run_simulator
from vicode.conformance.report import TITLES, describe
from vicode.conformance.traces import TraceIteration, first_difference, reduce_for
from vicode.conformance.xabsl import run_xabsl
from vicode.editor.session.simulation.setup import NotReadyError
from vicode.findings import Severity
from vicode.generators import UnsoundDesignError, collect_components

GENERATED = ("python", "cpp", "xabsl")
_MS = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageComparison:
    """The result: the languages that were compared, and the descriptions of differences from Python.

    Attributes:
        absent: The languages that were not compared, with the reason.
    """

    languages: tuple[str, ...]
    absent: Mapping[str, str]
    differences: tuple[str, ...]
    iterations: int


def find_absent_languages(run: ConformanceRun) -> dict[str, str]:
    """The languages that cannot run a design, with the reason."""
    project = replace(run.project, languages=GENERATED)
    findings = check_project(project, collect_components(project, (run.root,)))
    errors = [each for each in findings if each.severity is Severity.ERROR]
    absent: dict[str, str] = {}
    for language in GENERATED:
        found = [each for each in errors if each.applies_to(language)]
        absent |= {language: found[0].message} if found else {}
    if "python" in absent:
        absent["simulator"] = absent["python"]
    if run.robots > 1:
        absent["simulator"] = "the simulator runs one robot"
    if "xabsl" not in absent and any(step.time_ns % _MS for step in run.steps):
        absent["xabsl"] = "times of XABSL are whole milliseconds"
    return absent


def compare_languages(run: ConformanceRun, folder: Path, modules: Path | None = None) -> LanguageComparison:
    """Run a design in each language that can express it, and compare the traces with that of Python.

    Args:
        run: The design and its inputs.
        folder: An empty folder.
        modules: The folder of modules that code of the design imports.

    Raises:
        CompileError: The generated C++ does not compile.
        CodeRunError: The code of the design cannot be run.
    """
    absent = find_absent_languages(run)
    compiler = find_compiler()
    if compiler is None:
        absent.setdefault("cpp", COMPILER_MISSING)
    runs = {"compared": run}
    runners: dict[str, Callable[[], dict[str, list[TraceIteration]]]] = {
        "python": lambda: run_python(runs, folder, modules),
        "cpp": lambda: CppProgram(runs, folder, compiler or "").run(),
        "xabsl": lambda: {"compared": run_xabsl(run)},
        "simulator": lambda: run_simulator(runs, folder, modules),
    }
    traces: dict[str, list[TraceIteration]] = {}
    for language in (each for each in runners if each not in absent):
        try:
            traces[language] = runners[language]()["compared"]
        except (UnsoundDesignError, NotReadyError) as error:
            absent[language] = str(error)
    differences = [
        _difference(traces["python"], language, trace)
        for language, trace in traces.items()
        if language != "python" and "python" in traces
    ]
    return LanguageComparison(
        languages=tuple(traces),
        absent=absent,
        differences=tuple(filter(None, differences)),
        iterations=len(run.steps),
    )


def _difference(expected: list[TraceIteration], language: str, got: list[TraceIteration]) -> str:
    sides = {"python": reduce_for(language, expected), language: reduce_for(language, got)}
    found = first_difference(*sides.values())
    return "" if found is None else describe(found, sides)


def verdict(comparison: LanguageComparison) -> str:
    """One sentence: which languages agree."""
    titles = [TITLES[language] for language in comparison.languages]
    names = f"{', '.join(titles[:-1])} and {titles[-1]}" if len(titles) > 1 else titles[0] if titles else "No language"
    if comparison.differences:
        return f"{names}: the traces differ"
    return f"{names} agree in {comparison.iterations} iterations"
