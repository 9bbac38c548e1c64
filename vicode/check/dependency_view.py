"""The part of a project that can affect the findings of a design other than the design itself."""

from dataclasses import replace

from vicode.check.graphs import iter_steps
from vicode.model.design import Call, Code, CommonSection, Design
from vicode.model.project import Project


def make_dependency_view(project: Project) -> Project:
    """Reduce each design to what other designs depend on: names, declarations, uses and stepped components."""
    return replace(project, doc="", designs=tuple(map(_strip_internals, project.designs)))


def _strip_internals(design: Design) -> Design:
    stepped = dict.fromkeys(step.alias for step in iter_steps(design))
    calls = tuple(Call(alias=alias) for alias in sorted(stepped))
    return replace(design, doc="", states=(), common=CommonSection(actions=calls), module=Code(), members=Code())
