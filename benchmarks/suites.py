"""The faults that written test suites notice, and those that random inputs notice.

`python -m benchmarks.suites [STATES …]`: machines with 4 transitions per state, whose guards compare 8 inputs, as those
of `benchmarks.analysis`. The random inputs are as many iterations as the suite has steps, in runs of the same lengths.
Times are processor times.
"""

import argparse
import time
from collections.abc import Callable, Sequence
from typing import TypeVar

from benchmarks.analysis import make_design, make_machine
from vicode.conformance.design_mutants import MutantReport, try_mutants
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.random_inputs import random_run
from vicode.conformance.suite import GENERATED, Suite, make_run, observe_records
from vicode.conformance.suite_cases import find_cases
from vicode.model.project import Project


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("states", nargs="*", type=int, default=(10, 30))
    print("| states | cases | steps | gen | mutants | proved equivalent | mutate | noticed | by random inputs |")
    print("|---|---|---|---|---|---|---|---|---|")
    for states in parser.parse_args().states:
        measure(states)


def measure(states: int) -> None:
    design = make_design(make_machine(states), has_ranges=True)
    project = Project(name="drawn", components=(), designs=(design,))
    found, gen_s = timed(lambda: find_cases(project, design.component))
    suite = Suite(component=design.component, design="", source=GENERATED, languages=(), cases=found.cases)
    runs = [make_run(suite, case, project) for case in suite.cases]
    report, mutate_s = timed(lambda: try_runs(project, runs))
    random_report = try_runs(project, draw_runs(project, runs))
    print(
        f"| {states} | {len(suite.cases)} | {suite.steps} | {gen_s:.1f} s | {report.count} | {report.equivalent} "
        f"| {mutate_s:.0f} s | {share(report)} | {share(random_report)} |"
    )


def draw_runs(project: Project, runs: Sequence[ConformanceRun]) -> list[ConformanceRun]:
    return [
        random_run(project, run.root, iterations=len(run.steps), seed=number, whole_ms=False)
        for number, run in enumerate(runs)
    ]


def try_runs(project: Project, runs: Sequence[ConformanceRun]) -> MutantReport:
    return try_mutants(runs, observe=observe_records(project), is_root_only=True)


_T = TypeVar("_T")


def timed(function: Callable[[], _T]) -> tuple[_T, float]:
    start = time.process_time()
    result = function()
    return result, time.process_time() - start


def share(report: MutantReport) -> str:
    return f"{1 - len(report.survivors) / report.count:.1%}"


if __name__ == "__main__":
    main()
