"""What the rules see of a project when they look at one design: nothing else can change what they find in it."""

from dataclasses import replace

from vicode.check.graphs import iter_steps
from vicode.model.design import Call, Code, CommonSection, Design
from vicode.model.project import Project


def make_dependency_view(project: Project) -> Project:
    """The project with of each design only what others see: names, declarations, whom it uses and whom it steps."""
    return replace(project, doc="", designs=tuple(map(_strip_internals, project.designs)))


def _strip_internals(design: Design) -> Design:
    stepped = dict.fromkeys(step.alias for step in iter_steps(design))
    calls = tuple(Call(alias=alias) for alias in sorted(stepped))
    return replace(design, doc="", states=(), common=CommonSection(actions=calls), module=Code(), members=Code())
