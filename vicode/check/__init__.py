"""Rules for designs and projects. Each module lists its rule functions in RULES.

Rules never raise, and never run or import code of a project.
"""

from collections.abc import Callable, Collection
from functools import lru_cache

from vicode.check import (
    code,
    decisions,
    declarations,
    expressions,
    names,
    project,
    states,
    steps,
    uses,
    xabsl,
    xabsl_project,
)
from vicode.check.context import RuleContext, build_context, build_context_with_graphs
from vicode.check.dependency_view import make_dependency_view
from vicode.check.graphs import build_graphs
from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.project import Project

__all__ = ["DESIGN_RULES", "PROJECT_RULES", "RuleContext", "check_design", "check_project"]

PROJECT_RULES = (*project.RULES, *xabsl_project.RULES)
DESIGN_RULES = (
    *names.RULES,
    *declarations.RULES,
    *uses.RULES,
    *states.RULES,
    *decisions.RULES,
    *expressions.RULES,
    *steps.RULES,
    *code.RULES,
    *xabsl.RULES,
)


def check_project(project: Project, components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """Check a project file and its designs, or only the designs of `components`."""
    findings = [finding for rule in PROJECT_RULES for finding in rule(project)]
    check = _cached_checker(make_dependency_view(project))
    for design in project.designs:
        if components is None or design.component in components:
            findings += check(design)
    return tuple(dict.fromkeys(findings))


def check_design(project: Project, design: Design) -> tuple[Finding, ...]:
    """Check one design. It replaces the design with the same name in the project."""
    return tuple(dict.fromkeys(_run_rules(build_context(project, design))))


# After an edit, the site builder and the generators check all designs again. The dependency view rarely changes, so
# only the edited design is checked.
@lru_cache(maxsize=4)
def _cached_checker(dependency_view: Project) -> Callable[[Design], tuple[Finding, ...]]:
    """Return a function that checks designs against a dependency view and caches the findings."""
    graphs = build_graphs(dependency_view)

    def check(design: Design) -> tuple[Finding, ...]:
        return _run_rules(build_context_with_graphs(dependency_view, design, graphs))

    return lru_cache(maxsize=1000)(check)


def _run_rules(context: RuleContext) -> tuple[Finding, ...]:
    return tuple(finding for rule in DESIGN_RULES for finding in rule(context))
