"""What the agents of a project can reach: components that are stepped in states that may be active."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

from vicode.analysis.alternation import Alternation, AlternationSearch
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.walk import Walk
from vicode.model.design import Call, Design, State
from vicode.model.project import Project
from vicode.semantics import NotInterpretableError

_ROUNDS = 6

_Place = tuple[str, str]
"""A component and one of its states."""


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
        agents = [agent.root for agent in self.project.agents]
        return self.find_active(agents) if agents else frozenset(self.machines)

    @cached_property
    def roots(self) -> tuple[str, ...]:
        """The root components of the agents; without agents, the designs that no other steps."""
        agents = tuple(agent.root for agent in self.project.agents)
        return agents or tuple(name for name in self.machines if name not in self._callers)

    def find_active(self, roots: Iterable[str]) -> frozenset[str]:
        """The designs that may be stepped where some designs are."""
        pending, active = list(roots), set[str]()
        while pending:
            name = pending.pop()
            if name not in active and name in self.machines:
                active.add(name)
                pending += self._stepped(self.machines[name])
        return frozenset(active)

    def find_alternations(self, component: str) -> Iterator[Alternation]:
        """Yield the alternations of a design; if others call it, those that last while a caller stays in its state."""
        for each in AlternationSearch(self.project, self.machines[component]).find():
            callers = self._callers.get(component, ())
            if not callers or any(self._lasts_in(caller, component, each) for caller in callers):
                yield each

    @cached_property
    def _callers(self) -> Mapping[str, tuple[_Place, ...]]:
        """The states of active designs that step a component."""
        callers: dict[str, list[_Place]] = {}
        for name in self.active:
            machine = self.machines[name]
            for state in machine.design.states:
                if state.name in machine.reachable:
                    for stepped in dict.fromkeys(list_stepped(machine.design, state)):
                        callers.setdefault(stepped, []).append((name, state.name))
        return {name: tuple(places) for name, places in callers.items()}

    def _lasts_in(self, caller: _Place, component: str, alternation: Alternation) -> bool:
        """Whether the states alternate while a caller is in a state, with inputs for which it stays there."""
        states = alternation.states
        held = {key: value for key, value in alternation.held.items() if key[0] != component}
        expected = [states[(index + 1) % len(states)] for index in range(len(states) * _ROUNDS)]
        try:
            walk = Walk(self.project, self.machines[caller[0]])
            return any(
                walk.follow(component, expected, {caller[0]: caller[1], component: states[0]}, inputs)
                for inputs in walk.find_inputs_to_stay(caller[1], held, len(expected))
            )
        except NotInterpretableError:
            # Nothing is known of the caller.
            return True

    def _stepped(self, machine: MachineAnalysis) -> Iterator[str]:
        """The components that the reachable states of a design step."""
        for state in machine.design.states:
            if state.name in machine.reachable:
                yield from list_stepped(machine.design, state)


def list_stepped(design: Design, state: State) -> Iterator[str]:
    """The components that a state requires and calls."""
    components = {use.alias: use.component for use in reversed(design.uses)}
    yield from (components[alias] for alias in state.requires if alias in components)
    yield from list_called(design, state)


def list_called(design: Design, state: State) -> Iterator[str]:
    """The components that a state calls, common actions included."""
    components = {use.alias: use.component for use in reversed(design.uses)}
    called = (action.alias for action in (*design.common.actions, *state.all_actions) if isinstance(action, Call))
    return (components[alias] for alias in called if alias in components)
