"""Graphs of the components of a project: which component uses or steps which."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Call, Design, State
from vicode.model.project import Project

Graph = Mapping[str, tuple[str, ...]]
"""The successors of each node."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentGraphs:
    """Components as nodes; the edges of a design lead to the components it uses or steps."""

    uses: Graph
    steps: Graph

    def transitive_steps(self, component: str) -> set[str]:
        """Return all components that stepping a component may step, without the component itself."""
        return find_descendants(self.steps, component)

    def is_in_cycle(self, component: str) -> bool:
        """Whether stepping a component may step it again, which is reported as a cycle."""
        return any(find_path(self.steps, successor, component) for successor in self.steps.get(component, ()))


def find_descendants(graph: Graph, start: str) -> set[str]:
    """Return the nodes that can be reached from a node, without the node itself."""
    reached, pending = {start}, [start]
    while pending:
        for successor in graph.get(pending.pop(), ()):
            if successor not in reached:
                reached.add(successor)
                pending.append(successor)
    return reached - {start}


def find_path(graph: Graph, start: str, goal: str) -> list[str]:
    """Return the nodes of a shortest path, including both ends; empty if there is no path."""
    previous, queue = {start: start}, [start]
    for node in queue:
        for successor in graph.get(node, ()):
            if successor not in previous:
                previous[successor] = node
                queue.append(successor)
    if goal not in previous:
        return []
    path = [goal]
    while path[-1] != start:
        path.append(previous[path[-1]])
    return path[::-1]


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
        uses={name: tuple(dict.fromkeys(use.component for use in design.uses)) for name, design in designs.items()},
        steps={
            name: tuple(dict.fromkeys(step.component for step in iter_steps(design)))
            for name, design in designs.items()
        },
    )


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
