"""Reports what inputs reach of a design, and which of its faults they would not notice."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.conformance.design_mutants import MutantReport
    from vicode.conformance.result import InputCoverage
    from vicode.findings import DesignPath
    from vicode.store import OpenProject

_MAX_NEVER = 20


def report_coverage(coverage: "InputCoverage", project: "OpenProject") -> None:
    from vicode.conformance.result import as_design_path

    print(f"coverage: {coverage.summary}")
    for each in coverage.never[:_MAX_NEVER]:
        print(f"never: {each.text}{_place(project, each.component, as_design_path(each.path))} {each.outcome}")
    if len(coverage.never) > _MAX_NEVER:
        print(f"never: {len(coverage.never) - _MAX_NEVER} more")


def report_mutants(report: "MutantReport", component: str, project: "OpenProject") -> None:
    count = report.count
    same = f"; {report.equivalent} more are proved to behave like it" if report.equivalent else ""
    print(f"{component}: {count - len(report.survivors)} of {count} mutants of the design are noticed{same}")
    for mutant in report.survivors:
        print(f"not noticed: {mutant.text}{_place(project, mutant.design.component, mutant.path)}")


def _place(project: "OpenProject", component: str, path: "DesignPath") -> str:
    """The file and line of a part of a design, in parentheses; "" if it has none."""
    from vicode.findings import FindingSubject
    from vicode.store import find_location

    location = find_location(FindingSubject(component=component, path=path), project.sources)
    return f" ({location.file}:{location.line})" if location else ""
