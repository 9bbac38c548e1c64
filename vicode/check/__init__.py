"""Rules about designs and projects, one function a rule, one plain tuple of rules a file.

Nothing here raises, and no code of a project is run or imported.
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
    """What is wrong with a project file and with its designs, or those of `components` only."""
    findings = [finding for rule in PROJECT_RULES for finding in rule(project)]
    check = _cached_checker(make_dependency_view(project))
    for design in project.designs:
        if components is None or design.component in components:
            findings += check(design)
    return tuple(dict.fromkeys(findings))


def check_design(project: Project, design: Design) -> tuple[Finding, ...]:
    """What is wrong with one design, which counts in place of the one of its name in the project."""
    return tuple(dict.fromkeys(_run_rules(build_context(project, design))))


# Who builds a site or generates again after an edit asks for all designs, and hardly ever did what they see of each
# other change: only what was edited is checked.
@lru_cache(maxsize=4)
def _cached_checker(surroundings: Project) -> Callable[[Design], tuple[Finding, ...]]:
    """Checks designs within a project as they see it, and remembers what it found."""
    graphs = build_graphs(surroundings)

    def check(design: Design) -> tuple[Finding, ...]:
        return _run_rules(build_context_with_graphs(surroundings, design, graphs))

    return lru_cache(maxsize=1000)(check)


def _run_rules(context: RuleContext) -> tuple[Finding, ...]:
    return tuple(finding for rule in DESIGN_RULES for finding in rule(context))
