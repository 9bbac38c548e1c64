"""Compares all languages that can express a design.

A language may be unable to express a design, or to run some inputs, and it may fail. These are three answers, each with
a reason, and none of them hides a difference in another language. Each trace is compared with that of the reference
interpreter, after the parts that a language cannot show were removed from both.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from vicode.check import check_project
from vicode.conformance.chosen_inputs import choose_runs
from vicode.conformance.coverage import measure_coverage
from vicode.conformance.cpp import COMPILER_MISSING, CompileError, CppTools, ProgramError, find_tools, run_cpp
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.javascript import NODE_MISSING, find_node, find_unfit_javascript, is_last_bit, run_javascript
from vicode.conformance.python import CodeRunError, run_python, run_simulator
from vicode.conformance.random_inputs import random_run
from vicode.conformance.reference import run_reference
from vicode.conformance.report import explain
from vicode.conformance.result import AbsentLanguage, LanguageComparison, LanguageDifference, find_baseline
from vicode.conformance.traces import LAST_BIT, TraceIteration, first_difference, large_ints_limit, reduce_for
from vicode.conformance.xabsl import run_xabsl
from vicode.findings import Finding, Severity
from vicode.generators import UnsoundDesignError, collect_components
from vicode.model.project import Project
from vicode.runs.setup import NotReadyError
from vicode.semantics import NotInterpretableError

GENERATED = ("python", "cpp", "xabsl", "javascript")
_MS = 1_000_000
Traces = dict[int, list[TraceIteration]]
"""The traces of a language by the number of the run."""


def find_absent_languages(run: ConformanceRun) -> dict[str, str]:
    """The languages that cannot run a design with these inputs, with the reason."""
    absent = {language: absent.reason for language, absent in _find_absent(run).items()}
    for language in (*GENERATED, "simulator"):
        reason = _find_unfit(language, run)
        if reason:
            absent.setdefault(language, reason)
    return absent


def choose_inputs(project: Project, root: str, *, iterations: int, seed: int) -> tuple[ConformanceRun, ...]:
    """Inputs that reach the parts of a design; random ones if the reference interpreter cannot run it."""
    in_xabsl = "xabsl" not in _find_absent(ConformanceRun(project=project, root=root, steps=()))
    try:
        chosen = choose_runs(project, root, iterations=iterations, seed=seed, in_xabsl=in_xabsl)
    except NotInterpretableError:
        chosen = ()
    half = iterations // 2
    return chosen or (
        random_run(project, root, iterations=iterations - half, seed=seed),
        random_run(project, root, iterations=half, seed=seed, whole_ms=False),
    )


def _find_absent(run: ConformanceRun) -> dict[str, AbsentLanguage]:
    """The languages that cannot express a design."""
    project = replace(run.project, languages=GENERATED)
    findings = check_project(project, collect_components(project, (run.root,)))
    errors = [each for each in findings if each.severity is Severity.ERROR]
    absent: dict[str, AbsentLanguage] = {}
    for language in GENERATED:
        found = [each for each in errors if each.applies_to(language)]
        absent |= {language: _absent_by(language, found[0])} if found else {}
    if "python" in absent:
        absent["simulator"] = replace(absent["python"], language="simulator")
    return absent


def _find_missing(tools: CppTools | None) -> dict[str, AbsentLanguage]:
    """The languages whose compiler or runtime is not installed."""
    missing = {"cpp": COMPILER_MISSING} if tools is None else {}
    missing |= {} if find_node() else {"javascript": NODE_MISSING}
    return {language: AbsentLanguage(language=language, reason=text) for language, text in missing.items()}


def _find_unfit(language: str, run: ConformanceRun) -> str:
    """Why a language cannot run these inputs; "" if it can."""
    if language == "simulator" and run.robots > 1:
        return "the simulator runs one robot"
    if language == "javascript":
        return find_unfit_javascript(run)
    if language == "xabsl" and any(step.time_ns % _MS for step in run.steps):
        return "times of XABSL are whole milliseconds"
    return ""


def _find_fit(language: str, runs: Sequence[ConformanceRun]) -> tuple[dict[int, ConformanceRun], str]:
    """The runs that a language can run, by number, and why it cannot run the others."""
    fit = {number: run for number, run in enumerate(runs) if not _find_unfit(language, run)}
    return fit, next(filter(None, (_find_unfit(language, run) for run in runs)), "")


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
    tools: CppTools | None = None,
) -> LanguageComparison:
    """Run a design in each language that can express it, and compare the traces with that of the reference interpreter
    (of Python, if the interpreter cannot run the design).

    Args:
        runs: Runs of one design.
        folder: An empty folder.
        modules: The folder of modules that code of the design imports.
        on_language: Is called before a language runs.
        tools: The C++ compiler; None: the one that `find_tools` finds.
    """
    tools = tools or find_tools()
    absent = _find_missing(tools) | _find_absent(runs[0])
    runners = _make_runners(folder, modules, tools)
    traces: dict[str, Traces] = {}
    failed, partial = [], []
    for language in (each for each in runners if each not in absent):
        fit, reason = _find_fit(language, runs)
        if not fit:
            absent[language] = AbsentLanguage(language=language, reason=reason)
            continue
        on_language(language)
        try:
            traces[language] = runners[language](fit)
        except (UnsoundDesignError, NotReadyError, NotInterpretableError) as error:
            absent[language] = AbsentLanguage(language=language, reason=str(error))
        except (CompileError, ProgramError, CodeRunError) as error:
            failed.append(AbsentLanguage(language=language, reason=str(error)))
        else:
            if reason:
                partial.append(AbsentLanguage(language=language, reason=f"{len(fit)} of {len(runs)} runs: {reason}"))
    found = tuple(_find_differences(runs, traces))
    return LanguageComparison(
        languages=tuple(traces),
        absent=tuple(absent.values()),
        partial=tuple(partial),
        failed=tuple(failed),
        differences=tuple(each for each in found if isinstance(each, LanguageDifference)),
        limited=tuple(each for each in found if isinstance(each, AbsentLanguage)),
        iterations=sum(len(run.steps) for run in runs),
        runs=len(runs),
        coverage=measure_coverage(runs) if "reference" in traces else None,
    )


def _make_runners(
    folder: Path, modules: Path | None, tools: CppTools | None
) -> dict[str, Callable[[Mapping[int, ConformanceRun]], Traces]]:
    """What runs each language, in the order in which they run."""
    return {
        "reference": lambda fit: {number: run_reference(run) for number, run in fit.items()},
        "python": lambda fit: _by_number(fit, run_python(_by_name(fit), folder, modules)),
        "cpp": lambda fit: run_cpp(fit, folder, tools),
        "xabsl": lambda fit: {number: run_xabsl(run) for number, run in fit.items()},
        "javascript": lambda fit: _by_number(fit, run_javascript(_by_name(fit), folder)),
        "simulator": lambda fit: _by_number(fit, run_simulator(_by_name(fit), folder, modules)),
    }


def _find_differences(
    runs: Sequence[ConformanceRun], traces: Mapping[str, Traces]
) -> Iterator[LanguageDifference | AbsentLanguage]:
    """The first difference of each language from the baseline, or from where on the language is not compared."""
    first = find_baseline(traces)
    for language in traces:
        if first and language != first:
            found = _find_difference(runs, (first, traces[first]), (language, traces[language]))
            if found is not None:
                yield found


def _by_name(runs: Mapping[int, ConformanceRun]) -> dict[str, ConformanceRun]:
    return {f"run{number}": run for number, run in runs.items()}


def _by_number(runs: Mapping[int, ConformanceRun], traces: Mapping[str, list[TraceIteration]]) -> Traces:
    return dict(zip(runs, traces.values(), strict=True))


def _find_difference(
    runs: Sequence[ConformanceRun], expected: tuple[str, Traces], got: tuple[str, Traces]
) -> LanguageDifference | AbsentLanguage | None:
    """Return the first difference; or, if the nature of the language explains it, from where on it is not compared."""
    limited: AbsentLanguage | None = None
    for number, trace in got[1].items():
        sides = {expected[0]: reduce_for(got[0], expected[1][number]), got[0]: reduce_for(got[0], trace)}
        found = first_difference(*sides.values())
        if found is None:
            continue
        limit = large_ints_limit(got[0], expected[1][number], found)
        if got[0] == "javascript" and is_last_bit(runs[number], found):
            limit = LAST_BIT
        difference = explain(found, sides, runs[number], number)
        if limit is None:
            return difference
        where = f"iteration {difference.iteration}" + (f" of run {number + 1}" if len(runs) > 1 else "")
        limited = limited or AbsentLanguage(language=got[0], reason=f"from {where} on: {limit.reason}")
    return limited
