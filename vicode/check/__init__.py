"""Rules about designs and projects, one function a rule, one plain tuple of rules a file.

Nothing here raises, and no code of a project is run or imported.
"""

from collections.abc import Collection

from vicode.check import (
    code,
    decisions,
    declarations,
    expressions,
    names,
    project,
    states,
    stepping,
    uses,
    xabsl,
    xabsl_project,
)
from vicode.check.context import Context, context_of
from vicode.check.graphs import Graphs, graphs_of
from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.project import Project

__all__ = ["DESIGN_RULES", "PROJECT_RULES", "Context", "check_design", "check_project"]

PROJECT_RULES = (*project.RULES, *xabsl_project.RULES)
DESIGN_RULES = (
    *names.RULES,
    *declarations.RULES,
    *uses.RULES,
    *states.RULES,
    *decisions.RULES,
    *expressions.RULES,
    *stepping.RULES,
    *code.RULES,
    *xabsl.RULES,
)


def check_project(project: Project, components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """What is wrong with a project file and with its designs, or those of `components` only."""
    findings = [finding for rule in PROJECT_RULES for finding in rule(project)]
    graphs = graphs_of(project)
    for design in project.designs:
        if components is None or design.component in components:
            findings += _check(project, design, graphs)
    return tuple(dict.fromkeys(findings))


def check_design(project: Project, design: Design) -> tuple[Finding, ...]:
    """What is wrong with one design, which counts in place of the one of its name in the project."""
    return tuple(dict.fromkeys(_check(project, design, None)))


def _check(project: Project, design: Design, graphs: Graphs | None) -> list[Finding]:
    context = context_of(project, design, graphs)
    return [finding for rule in DESIGN_RULES for finding in rule(context)]
