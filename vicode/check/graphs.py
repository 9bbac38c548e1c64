"""Who uses whom, and who steps whom, among the components of a project."""

from collections.abc import Iterator
from dataclasses import dataclass

import networkx as nx

from vicode.findings import DesignPath
from vicode.model.design import COMMON, Call, Design, State
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentGraphs:
    """Components as nodes; `uses` and `steps` lead from a design's component to those it names."""

    uses: "nx.DiGraph[str]"
    steps: "nx.DiGraph[str]"

    def transitive_steps(self, component: str) -> set[str]:
        """All components that may work when this one is stepped, itself left out."""
        return set(nx.descendants(self.steps, component)) if component in self.steps else set()

    def is_in_cycle(self, component: str) -> bool:
        """Whether stepping a component comes back to it, which is a mistake of its own."""
        return component in self.steps and any(
            nx.has_path(self.steps, following, component) for following in self.steps.successors(component)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class StepSite:
    """A place where a design steps a component; `state` is a name or COMMON."""

    state: str
    alias: str
    component: str
    path: DesignPath
    is_call: bool


def build_graphs(project: Project) -> ComponentGraphs:
    """Both graphs; of two designs with one name the first counts."""
    uses: nx.DiGraph[str] = nx.DiGraph()
    steps: nx.DiGraph[str] = nx.DiGraph()
    for design in reversed(project.designs):
        for graph in (uses, steps):
            if design.component in graph:
                graph.remove_edges_from(list(graph.out_edges(design.component)))
            graph.add_node(design.component)
        uses.add_edges_from((design.component, use.component) for use in design.uses)
        steps.add_edges_from({(design.component, step.component) for step in iter_steps(design)})
    return ComponentGraphs(uses=uses, steps=steps)


def iter_steps(design: Design) -> Iterator[StepSite]:
    """Every place where a used component is stepped: the common ones, then by every state that is not disabled."""
    components = {use.alias: use.component for use in reversed(design.uses)}
    for index, action in enumerate(design.common.actions):
        if isinstance(action, Call) and action.alias in components:
            path: DesignPath = ("common", "actions", index, "call")
            yield StepSite(
                state=COMMON, alias=action.alias, component=components[action.alias], path=path, is_call=True
            )
    for state in (state for state in design.states if not state.disabled):
        for alias, place, is_call in _iter_stepped_aliases(state):
            if alias in components:
                yield StepSite(state=state.name, alias=alias, component=components[alias], path=place, is_call=is_call)


def _iter_stepped_aliases(state: State) -> Iterator[tuple[str, DesignPath, bool]]:
    """Aliases in the order they are stepped."""
    for index, alias in enumerate(state.requires):
        yield alias, ("states", state.name, "requires", index), False
    for index, action in enumerate(state.actions):
        if isinstance(action, Call):
            yield action.alias, ("states", state.name, "actions", index, "call"), True
    for call in state.modulates:
        yield call.alias, ("states", state.name, "modulates", call.alias), True
