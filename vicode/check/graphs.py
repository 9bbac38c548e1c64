"""Graphs of the components of a project: which component uses or steps which."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Call, Design, State
from vicode.model.project import Project

if TYPE_CHECKING:
    import networkx as nx


class ComponentGraph:
    """A directed graph of components, given by the successors of each node.

    networkx is imported by the first query of a node with successors: most designs have none, and the import takes
    a tenth of a second.
    """

    def __init__(self, successors: Mapping[str, tuple[str, ...]]) -> None:
        self.successors = successors
        self._trees: dict[str, dict[str, str]] = {}

    @cached_property
    def _digraph(self) -> "nx.DiGraph[str]":
        import networkx as nx  # noqa: PLC0415 - see the class

        edges: dict[str, Iterable[str]] = {**self.successors}
        return nx.DiGraph(edges)

    def _search(self, start: str) -> Mapping[str, str]:
        """Each node that can be reached, with the node before it on a shortest path; kept, as each is asked often."""
        if start not in self._trees:
            self._trees[start] = {}
            if self.successors.get(start):
                import networkx as nx  # noqa: PLC0415 - see the class

                self._trees[start] = dict(nx.bfs_predecessors(self._digraph, start))
        return self._trees[start]

    def descendants(self, start: str) -> set[str]:
        """Return the nodes that can be reached from a node, without the node itself."""
        return set(self._search(start))

    def path(self, start: str, goal: str) -> list[str]:
        """Return the nodes of a shortest path, including both ends; empty if there is no path."""
        tree = self._search(start)
        if goal not in tree and goal != start:
            return []
        nodes = [goal]
        while nodes[-1] != start:
            nodes.append(tree[nodes[-1]])
        return nodes[::-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentGraphs:
    """Components as nodes; the edges of a design lead to the components it uses or steps.

    `together` are the components that each state of a design steps, with the design; "" for the roots of agents.
    """

    uses: ComponentGraph
    steps: ComponentGraph
    together: tuple[tuple[str, frozenset[str]], ...]
    _stepped_with: dict[str, frozenset[str]] = field(default_factory=dict)
    _callers: dict[str, list[tuple[str, frozenset[str]]]] = field(default_factory=dict)

    def transitive_steps(self, component: str) -> set[str]:
        """Return all components that stepping a component may step, without the component itself."""
        return self.steps.descendants(component)

    def stepped_with(self, component: str) -> frozenset[str]:
        """Return the components that are stepped whenever a design steps a component, in whichever state."""
        if self.is_in_cycle(component):
            return frozenset()
        if component not in self._stepped_with:
            # Names may be empty, as that of the caller of agents.
            self._stepped_with[component] = frozenset()
            found = []
            for caller, stepped in self._find_callers().get(component, ()):
                others = stepped - {component}
                found.append(others.union(self.stepped_with(caller), *map(self.transitive_steps, others)))
            self._stepped_with[component] = frozenset.intersection(*found) if found else frozenset()
        return self._stepped_with[component]

    def _find_callers(self) -> dict[str, list[tuple[str, frozenset[str]]]]:
        """The entries of `together` by what they step."""
        if not self._callers:
            for caller, stepped in self.together:
                for component in stepped:
                    self._callers.setdefault(component, []).append((caller, stepped))
        return self._callers

    def is_in_cycle(self, component: str) -> bool:
        """Whether stepping a component may step it again, which is reported as a cycle."""
        return any(self.steps.path(successor, component) for successor in self.steps.successors.get(component, ()))


@dataclass(frozen=True, slots=True, kw_only=True)
class StepSite:
    """A place in a design that steps a component. `state` is a name or COMMON."""

    state: str
    alias: str
    component: str
    path: DesignPath
    is_call: bool


def build_graphs(project: Project) -> ComponentGraphs:
    """Build both graphs; of two designs with the same name the first one counts."""
    designs = {design.component: design for design in reversed(project.designs)}
    return ComponentGraphs(
        uses=ComponentGraph(
            {name: tuple(dict.fromkeys(use.component for use in design.uses)) for name, design in designs.items()}
        ),
        steps=ComponentGraph(
            {
                name: tuple(dict.fromkeys(step.component for step in iter_steps(design)))
                for name, design in designs.items()
            }
        ),
        together=(
            *(("", frozenset({agent.root})) for agent in project.agents),
            *((name, stepped) for name, design in designs.items() for stepped in _steps_by_state(design)),
        ),
    )


def _steps_by_state(design: Design) -> Iterator[frozenset[str]]:
    steps = tuple(iter_steps(design))
    for state in (state for state in design.states if not state.disabled):
        yield frozenset(step.component for step in steps if step.state in (state.name, COMMON))


def iter_steps(design: Design) -> Iterator[StepSite]:
    """Yield the places that step a used component: common actions, then each state that is not disabled."""
    components = {use.alias: use.component for use in reversed(design.uses)}
    for index, action in enumerate(design.common.actions):
        if isinstance(action, Call) and action.alias in components:
            path: DesignPath = ("common", "actions", index, "call")
            yield StepSite(
                state=COMMON, alias=action.alias, component=components[action.alias], path=path, is_call=True
            )
    for state in (state for state in design.states if not state.disabled):
        for alias, path, is_call in _iter_stepped_aliases(state):
            if alias in components:
                yield StepSite(state=state.name, alias=alias, component=components[alias], path=path, is_call=is_call)


def _iter_stepped_aliases(state: State) -> Iterator[tuple[str, DesignPath, bool]]:
    """Yield alias, path and whether it is a call, in the order of stepping."""
    for index, alias in enumerate(state.requires):
        yield alias, ("states", state.name, "requires", index), False
    for index, action in enumerate(state.actions):
        if isinstance(action, Call):
            yield action.alias, ("states", state.name, "actions", index, "call"), True
    for call in state.modulates:
        yield call.alias, ("states", state.name, "modulates", call.alias), True
