"""What the rules see of a project when they look at one design: nothing else can change what they find in it."""

from dataclasses import replace

from vicode.check.graphs import steps_of
from vicode.model.design import Call, Code, Common, Design
from vicode.model.project import Project


def surroundings_of(project: Project) -> Project:
    """The project with of each design only what others see: names, declarations, whom it uses and whom it steps."""
    return replace(project, doc="", designs=tuple(map(_outside_of, project.designs)))


def _outside_of(design: Design) -> Design:
    stepped = dict.fromkeys(step.alias for step in steps_of(design))
    calls = tuple(Call(alias=alias) for alias in sorted(stepped))
    return replace(design, doc="", states=(), common=Common(actions=calls), module=Code(), members=Code())
