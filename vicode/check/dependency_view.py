"""The part of a project that can affect the findings of a design other than the design itself."""

from dataclasses import replace

from vicode.check.graphs import iter_steps
from vicode.model.design import COMMON, Call, Code, CommonSection, Design, State
from vicode.model.project import Project


def make_dependency_view(project: Project) -> Project:
    """Reduce each design to what other designs depend on: names, declarations, uses, and what each state steps."""
    return replace(project, doc="", designs=tuple(map(_strip_internals, project.designs)))


def _strip_internals(design: Design) -> Design:
    stepped: dict[str, set[str]] = {
        COMMON: set(),
        **{state.name: set() for state in design.states if not state.disabled},
    }
    for step in iter_steps(design):
        stepped[step.state].add(step.alias)
    common = CommonSection(actions=tuple(Call(alias=alias) for alias in sorted(stepped.pop(COMMON))))
    together = sorted({tuple(sorted(aliases)) for aliases in stepped.values()})
    states = tuple(State(name=str(index), requires=aliases) for index, aliases in enumerate(together))
    return replace(design, doc="", states=states, common=common, module=Code(), members=Code())
