"""The teams of a project: robots that run its agents, as machines without inputs.

A transition that may be taken for some inputs may be taken at any time, or not at all. What is known without inputs
limits it: `done(x)` and `action_done` follow from the states of components, and `team_size` is the number of robots.
Only components that have states which the robots coordinate are followed, and those that step them.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import combinations_with_replacement

from vicode.analysis.interval_diagrams import Node, TooLargeError
from vicode.analysis.machines import LiveTransition, MachineAnalysis
from vicode.analysis.products import Cooperation, Place, Product, RobotMachine
from vicode.analysis.projects import ProjectAnalysis, list_called, list_stepped
from vicode.analysis.team_search import TeamSearch, TooManyConfigurationsError

MOST_CONFIGURATIONS = 50_000
_MOST_LOCAL_STATES = 2_000


@dataclass(frozen=True, slots=True, kw_only=True)
class _RobotState:
    """The active components of a robot with their states, and the states in which others resume."""

    active: tuple[Place, ...]
    stopped: tuple[Place, ...]


class TeamAnalysis:
    """The teams of a project.

    Args:
        analysis: The project.
        roots: The root components of robots; None for those of the project.
    """

    def __init__(self, analysis: ProjectAnalysis, roots: Iterable[str] | None = None) -> None:
        self._analysis = analysis
        self._roots = tuple(dict.fromkeys(each for each in roots or analysis.roots if each in analysis.machines))
        self._find_machine = cache(self._build_machine)
        self._answers: dict[tuple[str, Node, tuple[tuple[int, int], ...]], bool] = {}

    @cached_property
    def places(self) -> Mapping[Place, Cooperation]:
        """The states that robots coordinate."""
        return {
            (name, state.name): Cooperation(number=number, is_barrier=state.capacity is None)
            for name in sorted(self._analysis.find_active(self._roots))
            for state in self._analysis.machines[name].design.states
            if (number := state.synchronized if state.capacity is None else state.capacity) is not None
            and state.name in self._analysis.machines[name].reachable
        }

    @cached_property
    def size(self) -> int:
        """The number of robots: the least one for which each place limits what they do."""
        return max((each.number + (not each.is_barrier) for each in self.places.values()), default=1)

    @cached_property
    def searches(self) -> tuple[TeamSearch, ...] | None:
        """What each team can do that has enough robots for each place that one of them can enter.

        None if the teams have too many configurations.
        """
        found, left = [], MOST_CONFIGURATIONS
        try:
            for roots in self._list_teams() if self.places else ():
                found.append(TeamSearch(self.make_product(roots), left))
                left -= len(found[-1].edges)
        except TooManyConfigurationsError:
            return None
        return tuple(found)

    def make_product(self, roots: Iterable[str]) -> Product:
        """The product of robots with these roots.

        Raises:
            TooManyConfigurationsError: A robot alone has too many states.
        """
        return Product([self._find_machine(root) for root in roots], self.places)

    def _list_teams(self) -> Iterator[tuple[str, ...]]:
        reached = {
            root: {place for place in self.places if place[0] in self._analysis.find_active((root,))}
            for root in self._roots
        }
        for team in combinations_with_replacement([root for root in self._roots if reached[root]], self.size):
            counts = Counter(place for root in team for place in reached[root])
            if all(count >= self.places[each].number for each, count in counts.items() if self.places[each].is_barrier):
                yield team

    def _build_machine(self, root: str) -> RobotMachine:
        states = [self._activate(root, {}, {})]
        numbers = {states[0]: 0}
        moves: dict[tuple[int, Place], int] = {}
        # States that are reached are added while the list is read.
        for source, state in enumerate(states):
            for component, target in self._list_changes(state):
                after = self._activate(root, {**dict(state.active), component: target}, dict(state.stopped))
                if after not in numbers:
                    numbers[after] = len(states)
                    states.append(after)
                moves[source, (component, target)] = numbers[after]
            if len(states) > _MOST_LOCAL_STATES:
                raise TooManyConfigurationsError
        return RobotMachine(name=root, states=tuple(dict(each.active) for each in states), moves=moves)

    def _list_changes(self, state: _RobotState) -> Iterator[Place]:
        """The components of a robot that may change, each with its next state."""
        for component, name in state.active:
            machine = self._analysis.machines[component]
            facts = self._find_facts(machine, dict(state.active))
            targets = (each.target for each in machine.live_in(name) if self._may_take(machine, each, facts))
            yield from ((component, target) for target in dict.fromkeys(targets) if target in machine.reachable)

    def _activate(self, root: str, states: Mapping[str, str], stopped: Mapping[str, str]) -> _RobotState:
        """The components that are active if these states are; those that were not active before restart or resume."""
        active: dict[str, str] = {}
        pending = [root]
        while pending:
            name = pending.pop()
            if name in self._followed and name not in active:
                design = self._analysis.machines[name].design
                active[name] = states.get(name) or stopped.get(name) or design.initial
                state = design.state(active[name])
                pending += list_stepped(design, state) if state else ()
        rest = {
            name: state
            for name, state in {**stopped, **states}.items()
            if name not in active and self._analysis.machines[name].design.resume
        }
        return _RobotState(active=tuple(sorted(active.items())), stopped=tuple(sorted(rest.items())))

    @cached_property
    def _followed(self) -> frozenset[str]:
        components = {component for component, _state in self.places}
        active = self._analysis.find_active(self._roots)
        return frozenset((*self._roots, *(each for each in active if components & self._analysis.find_active((each,)))))

    def _find_facts(self, machine: MachineAnalysis, active: Mapping[str, str]) -> Mapping[str, int]:
        """The values that guards read and that do not depend on inputs, by their text."""
        states = {name: self._analysis.machines[name].design.state(state) for name, state in active.items()}
        done = {name: int(state is not None and state.final) for name, state in states.items()}
        facts = {f"done({use.alias})": done[use.component] for use in machine.design.uses if use.component in done}
        state = states[machine.design.component]
        called = tuple(list_called(machine.design, state)) if state else ()
        if all(each in done for each in called if each in self._analysis.machines):
            facts["action_done"] = max((done[each] for each in called if each in done), default=0)
        return facts | {"team_size": self.size}

    def _may_take(self, machine: MachineAnalysis, edge: LiveTransition, facts: Mapping[str, int]) -> bool:
        conditions = machine.guards.conditions
        diagrams = conditions.diagrams
        names = {level: conditions.quantities[level].name for level in diagrams.find_cuts((edge.taken,))}
        known = tuple((level, facts[name]) for level, name in names.items() if name in facts)
        key = (machine.design.component, edge.taken, known)
        if key not in self._answers:
            diagrams.begin_question()
            try:
                node = edge.taken
                for level, value in known:
                    node = diagrams.both(node, diagrams.test(level, (((value, 0), (value + 1, 0)),)))
                self._answers[key] = machine.guards.is_possible(node)
            except (TooLargeError, RecursionError):
                self._answers[key] = True
        return self._answers[key]
