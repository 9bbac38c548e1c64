"""Rules for designs and projects.

Each module lists its rule functions in RULES, and those that find no errors in WARNINGS.

Rules never raise, and never run or import code of a project.
"""

from collections.abc import Callable, Collection, Iterator
from functools import lru_cache

from vicode.check import (
    code,
    constructs,
    declarations,
    expressions,
    javascript,
    names,
    states,
    steps,
    uses,
)
from vicode.check import project as project_rules
from vicode.check.context import RuleContext, build_context, build_context_with_graphs
from vicode.check.dependency_view import make_dependency_view
from vicode.check.graphs import build_graphs
from vicode.findings import Finding, Severity
from vicode.model.design import Design
from vicode.model.lowering import is_lowered
from vicode.model.project import Project

__all__ = [
    "RuleContext",
    "build_context",
    "check_design",
    "check_file",
    "check_project",
    "find_design_errors",
    "find_errors",
]

DesignRule = Callable[[RuleContext], Iterator[Finding]]
DESIGN_RULES: tuple[DesignRule, ...] = (
    *names.RULES,
    *declarations.RULES,
    *uses.RULES,
    *states.RULES,
    *expressions.RULES,
    *code.RULES,
    *constructs.RULES,
)
DESIGN_WARNINGS: tuple[DesignRule, ...] = (
    *declarations.WARNINGS,
    *uses.WARNINGS,
    *states.WARNINGS,
    *steps.WARNINGS,
    *code.WARNINGS,
)


def check_project(project: Project, components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """Check a project file and its designs, or only the designs of `components`."""
    return _check_project(project, components, _all_warnings())


def find_errors(project: Project, components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """The errors of a project file and its designs; rules that find only warnings and notes are not run."""
    found = _check_project(project, components, ())
    return tuple(each for each in found if each.severity is Severity.ERROR)


def check_file(project: Project) -> Iterator[Finding]:
    """Check a project file."""
    rules = (*project_rules.RULES, *(_xabsl_rules()[0] if "xabsl" in project.languages else ()))
    return (finding for rule in rules for finding in rule(project))


def check_design(project: Project, design: Design) -> tuple[Finding, ...]:
    """Check one design. It replaces the design with the same name in the project."""
    return tuple(dict.fromkeys(_run_rules(build_context(project, design), _all_warnings())))


def find_design_errors(project: Project, design: Design) -> tuple[Finding, ...]:
    """The errors of one design; see `find_errors`."""
    found = dict.fromkeys(_run_rules(build_context(project, design), ()))
    return tuple(each for each in found if each.severity is Severity.ERROR)


def _check_project(
    project: Project, components: Collection[str] | None, warnings: tuple[DesignRule, ...]
) -> tuple[Finding, ...]:
    findings = list(check_file(project))
    check = _cached_checker(make_dependency_view(project), warnings)
    for design in project.designs:
        if components is None or design.component in components:
            findings += check(design)
    return tuple(dict.fromkeys(findings))


# After an edit, the site builder and the generators check all designs again. The dependency view rarely changes, so
# only the edited design is checked.
@lru_cache(maxsize=4)
def _cached_checker(
    dependency_view: Project, warnings: tuple[DesignRule, ...]
) -> Callable[[Design], tuple[Finding, ...]]:
    """Return a function that checks designs against a dependency view and caches the findings."""
    graphs = build_graphs(dependency_view)

    def check(design: Design) -> tuple[Finding, ...]:
        return _run_rules(build_context_with_graphs(dependency_view, design, graphs), warnings)

    return lru_cache(maxsize=1000)(check)


def _run_rules(context: RuleContext, warnings: tuple[DesignRule, ...]) -> tuple[Finding, ...]:
    languages = context.project.languages
    in_xabsl = _xabsl_rules()[1] if "xabsl" in languages else ()
    in_javascript = javascript.RULES if "javascript" in languages else ()
    rules = (*DESIGN_RULES, *warnings, *in_xabsl, *in_javascript)
    found = (finding for rule in rules for finding in rule(context))
    return constructs.merge_derived(context.design, found) if is_lowered(context.design) else tuple(found)


def _all_warnings() -> tuple[DesignRule, ...]:
    # Those about decisions and values need the analysis, which generating and running do not import.
    from vicode.check import decisions, values  # noqa: PLC0415

    return (*DESIGN_WARNINGS, *decisions.WARNINGS, *values.WARNINGS)


def _xabsl_rules() -> tuple[tuple[Callable[[Project], Iterator[Finding]], ...], tuple[DesignRule, ...]]:
    # Most projects have no XABSL code.
    from vicode.check import xabsl, xabsl_project  # noqa: PLC0415

    return xabsl_project.RULES, xabsl.RULES
