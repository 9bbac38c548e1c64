"""Rules for the behavior of a project as a whole; they take longer than the others: states that alternate, components
that no agent activates.
"""

from collections.abc import Collection, Iterator

from vicode.analysis.alternation import Alternation
from vicode.analysis.projects import ProjectAnalysis
from vicode.findings import Finding, FindingSubject, Note, get_rule
from vicode.model.project import Project

_MOST_INPUTS = 6


def find_behavior(project: Project, components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """D435 and P214 for all designs, or those of `components`."""
    analysis = ProjectAnalysis(project)
    designs = (each for each in project.designs if components is None or each.component in components)
    found: list[Finding] = []
    for design in designs:
        if design.component not in analysis.active:
            found.append(_report_inactive(design.component))
        found += (_report_alternation(design.component, each) for each in analysis.find_alternations(design.component))
    return tuple(found)


def _report_inactive(component: str) -> Finding:
    return Finding(
        rule=get_rule("P214"),
        message=f"no agent activates {component}: no state that an agent can reach requires or calls it",
        fix="call it, add an agent with it as root, or delete it",
        subject=FindingSubject(component=component, path=("component",)),
    )


def _report_alternation(component: str, alternation: Alternation) -> Finding:
    names = [f"'{state}'" for state in alternation.states]
    held = list(_describe_inputs(alternation))
    more = f" and {len(held) - _MOST_INPUTS} more" if len(held) > _MOST_INPUTS else ""
    inputs = f" with {', '.join(held[:_MOST_INPUTS])}{more}" if held else ""
    states = f"{', '.join(names[:-1])} and {names[-1]}"
    return Finding(
        rule=get_rule("D435"),
        message=f"{states} alternate in each iteration while the inputs hold still{inputs}",
        fix="let the guards exclude each other, with a distance between their limits, or add a minimum time",
        subject=FindingSubject(component=component, path=alternation.paths[0]),
        notes=tuple(
            Note(message="and this transition leads on", subject=FindingSubject(component=component, path=path))
            for path in alternation.paths[1:]
        ),
    )


def _describe_inputs(alternation: Alternation) -> Iterator[str]:
    """The inputs that were set last, when the states began to alternate."""
    held = next((step.inputs for step in reversed(alternation.steps) if step.inputs), {})
    for (component, name), value in held.items():
        yield f"{component}.{name} = {value:g}" if isinstance(value, float) else f"{component}.{name} = {value}"
