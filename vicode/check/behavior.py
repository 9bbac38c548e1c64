"""Rules for the behavior of a project as a whole; they take longer than the others: states that alternate, components
that no agent activates, robots that wait forever for their team (`vicode.check.teams`).
"""

from collections.abc import Collection, Iterator
from dataclasses import replace

from vicode.analysis.alternation import Alternation
from vicode.analysis.examples import describe_value
from vicode.analysis.projects import ProjectAnalysis
from vicode.check import check_project, find_errors
from vicode.check.properties import describe_steps, find_broken_properties
from vicode.check.teams import ShownNames, find_in_teams
from vicode.findings import Finding, FindingSubject, Note, Severity, get_rule
from vicode.model.design import Design
from vicode.model.project import Project

_MOST_INPUTS = 6
_INACTIVE = ("P214", "D421")


def check_behavior(
    project: Project, components: Collection[str] | None = None, *, are_names_xabsl: bool = False
) -> tuple[Finding, ...]:
    """The findings of all rules; those about designs and states that are never active say so.

    With `are_names_xabsl`, messages contain the names that an imported behavior has in XABSL.
    """
    analysis = ProjectAnalysis(project)
    found = check_project(project, components)
    # A design that steps itself has no meaning.
    if not any(each.rule.code == "D408" for each in found):
        found += find_behavior(project, components, are_names_xabsl=are_names_xabsl, analysis=analysis)
    return tuple(_mark_inactive(analysis, each) for each in found)


def find_deep(project: Project, component: str) -> tuple[Finding, ...]:
    """The findings of the rules in this module for one design; none while a design steps itself."""
    has_cycle = any(each.rule.code == "D408" for each in find_errors(project, [component]))
    return () if has_cycle else find_behavior(project, [component])


def _mark_inactive(analysis: ProjectAnalysis, finding: Finding) -> Finding:
    component, path = (finding.subject.component, finding.subject.path) if finding.subject else ("", ())
    # An error prevents code generation, and two rules say so themselves.
    if component not in analysis.machines or finding.severity is Severity.ERROR or finding.rule.code in _INACTIVE:
        return finding
    is_reachable = path[0:1] != ("states",) or path[1] in analysis.machines[component].reachable
    is_active = component in analysis.active and is_reachable
    return finding if is_active else replace(finding, message=f"{finding.message} (never active)")


def find_behavior(
    project: Project,
    components: Collection[str] | None = None,
    *,
    are_names_xabsl: bool = False,
    analysis: ProjectAnalysis | None = None,
) -> tuple[Finding, ...]:
    """D435 to D437, D441, D442, P214 and P215 for all designs, or those of `components`.

    With `are_names_xabsl`, messages contain the names that an imported behavior has in XABSL.
    """
    analysis = analysis or ProjectAnalysis(project)
    names = ShownNames(project, are_xabsl=are_names_xabsl)
    designs = (each for each in project.designs if components is None or each.component in components)
    found: list[Finding] = []
    for design in designs:
        found += find_broken_properties(project, design)
        if design.component not in analysis.active:
            found.append(_report_inactive(design, names))
            continue
        found += (_report_alternation(design, each, names) for each in analysis.find_alternations(design.component))
    in_teams = find_in_teams(analysis, names)
    found += (
        each for each in in_teams if components is None or (each.subject and each.subject.component in components)
    )
    return tuple(found)


def _report_inactive(design: Design, names: ShownNames) -> Finding:
    name = names.component(design)
    return Finding(
        rule=get_rule("P214"),
        message=f"no agent activates {name}: no state that an agent can reach requires or calls it",
        fix="call it, add an agent with it as root, or delete it",
        subject=FindingSubject(component=design.component, path=("component",)),
    )


def _report_alternation(design: Design, alternation: Alternation, names: ShownNames) -> Finding:
    states = [f"'{names.state(design, state)}'" for state in alternation.states]
    held = list(_describe_inputs(alternation, names))
    more = f" and {len(held) - _MOST_INPUTS} more" if len(held) > _MOST_INPUTS else ""
    inputs = f" with {', '.join(held[:_MOST_INPUTS])}{more}" if held else ""
    cycle = f"{', '.join(states[:-1])} and {states[-1]}"
    return Finding(
        rule=get_rule("D435"),
        message=f"{cycle} alternate in each iteration while the inputs hold still{inputs}",
        fix="let the guards exclude each other, with a distance between their limits, or add a minimum time",
        subject=FindingSubject(component=design.component, path=alternation.paths[0]),
        run=describe_steps(design.component, alternation.steps),
        notes=tuple(
            Note(message="and this transition leads on", subject=FindingSubject(component=design.component, path=path))
            for path in alternation.paths[1:]
        ),
    )


def _describe_inputs(alternation: Alternation, names: ShownNames) -> Iterator[str]:
    """The inputs that were set last, when the states began to alternate."""
    set_last = next((step.inputs for step in reversed(alternation.steps) if step.inputs), {})
    for (component, name), value in set_last.items():
        shown = value.rpartition(".")[2] if isinstance(value, str) else value
        yield f"{names.input(component, name)} = {describe_value(shown)}"
