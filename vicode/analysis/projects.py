"""What the agents of a project can reach: components that are stepped in states that may be active."""

from collections.abc import Iterator, Mapping
from functools import cached_property

from vicode.analysis.alternation import Alternation, AlternationSearch
from vicode.analysis.machines import MachineAnalysis
from vicode.model.design import Call, Design
from vicode.model.project import Project


class ProjectAnalysis:
    """The designs of a project together.

    Args:
        project: The project, with all designs.
    """

    def __init__(self, project: Project) -> None:
        self.project = project
        self.machines: Mapping[str, MachineAnalysis] = {
            design.component: MachineAnalysis(project, design) for design in project.designs
        }

    @cached_property
    def active(self) -> frozenset[str]:
        """The designs that some agent may step; all of them if the project declares no agent."""
        roots = [agent.root for agent in self.project.agents]
        if not roots:
            return frozenset(self.machines)
        pending, active = roots, set[str]()
        while pending:
            name = pending.pop()
            if name not in active and name in self.machines:
                active.add(name)
                pending += self._stepped(self.machines[name])
        return frozenset(active)

    def find_alternations(self, component: str) -> Iterator[Alternation]:
        """Yield the alternations of a design."""
        return AlternationSearch(self.project, self.machines[component]).find()

    def _stepped(self, machine: MachineAnalysis) -> Iterator[str]:
        """The components that the reachable states of a design step."""
        components = {use.alias: use.component for use in reversed(machine.design.uses)}
        return (
            components[alias] for alias in _stepped_aliases(machine.design, machine.reachable) if alias in components
        )


def _stepped_aliases(design: Design, states: frozenset[str]) -> Iterator[str]:
    yield from (action.alias for action in design.common.actions if isinstance(action, Call))
    for state in design.states:
        if state.name in states:
            yield from state.requires
            yield from (action.alias for action in state.all_actions if isinstance(action, Call))
