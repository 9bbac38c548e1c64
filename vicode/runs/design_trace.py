"""Reads a recorded trace (JSON lines of `vicode run --trace`) to view it or to use its values as inputs."""

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Design
from vicode.model.traversal import iter_transitions
from vicode.runs.inputs import SimulationInput
from vicode.runs.recording import MAX_ITERATIONS
from vicode.simulation import Inputs, IterationResult
from vicode.traces.reader import TraceError, read_trace

MAX_BYTES = 50_000_000


def read_iterations(text: str, design: Design) -> tuple[IterationResult, ...]:
    """The iterations of a trace, with the keys of transitions in the design.

    Raises:
        TraceError: The text is not a trace, or it is a trace of another component.
    """
    if len(text) > MAX_BYTES:
        raise TraceError(f"the trace is longer than {MAX_BYTES // 1_000_000} MB")
    iterations = read_trace(text, MAX_ITERATIONS)
    require_root(iterations, design)
    return tuple(map(TransitionKeys(design).complete, iterations))


def require_root(iterations: Iterable[IterationResult], design: Design) -> None:
    """Check that a trace is one of a design.

    Raises:
        TraceError: It is a trace of another component.
    """
    names = (str(iteration.tree[0]["component"]) for iteration in iterations)
    other = next((name for name in names if name != design.component), None)
    if other is not None:
        raise TraceError(f"this is a trace of {other[:60]}, not of {design.component}")


def input_script(iterations: Iterable[IterationResult], inputs: Iterable[SimulationInput]) -> tuple[Inputs, ...]:
    """The inputs to set before each iteration, so that stubs return the values recorded in a trace.

    Only changes are listed. A trace contains values if it was recorded with `--values`.
    """
    names = defaultdict(dict)  # type: defaultdict[str, dict[str, SimulationInput]]
    for each in inputs:
        if each.arguments is None:
            names[each.component][each.name] = each
    known: dict[tuple[str, str], Any] = {}
    script: list[Inputs] = []
    for iteration in iterations:
        changes: dict[str, dict[str, Any]] = {}
        for component, values in iteration.values().items():
            for name, each in names.get(component, {}).items():
                value = each.accept((values or {}).get(name))
                if value is not None and known.get(each.key) != value:
                    known[each.key] = value
                    changes.setdefault(component, {})[name] = value
        script.append(changes)
    return tuple(script)


def focus_iteration(iteration: IterationResult, design: Design) -> IterationResult:
    """The iteration with the step of a design as its own, and with the key of the transition in the design.

    If the latest change was in an iteration that is missing, the step gets it.
    """
    focused = replace(iteration, component=design.component)
    changes = [each for each in iteration.changes if each.get("component") == design.component]
    if changes and focused.changed_from is None and changes[-1].get("target") == focused.state:
        took = {"changed_from": changes[-1].get("source"), "transition": changes[-1].get("transition")}
        focused = replace(focused, tree=[{**step, **took} if step is focused.step else step for step in focused.tree])
    if focused.changed_from is None:
        return focused
    return TransitionKeys(design).complete(focused)


class TransitionKeys:
    """Finds the keys of recorded transitions in a design."""

    def __init__(self, design: Design) -> None:
        self._by_id: dict[str, str] = {}
        self._by_ends: dict[tuple[str, str], list[str]] = defaultdict(list)
        for located in iter_transitions(design):
            key, given = transition_key(located.path), located.decision.id
            if given:
                self._by_id.setdefault(given, key)
            self._by_ends[located.source, getattr(located.decision, "to", "")].append(key)

    def find(self, left: str | None, state: str, given: str | None) -> str | None:
        """The key of the transition taken: by its id, else by its source and target if only one matches."""
        if left is None:
            return None
        if given in self._by_id:
            return self._by_id[given]
        keys = [*self._by_ends.get((left, state), ()), *self._by_ends.get((COMMON, state), ())]
        return keys[0] if len(keys) == 1 else None

    def between(self, left: str, state: str) -> list[str]:
        """The keys of all transitions that may have been taken."""
        return self._by_ends.get((left, state)) or self._by_ends.get((COMMON, state), [])

    def complete(self, iteration: IterationResult) -> IterationResult:
        """The iteration with the key of its transition."""
        own = iteration.step
        key = self.find(iteration.changed_from, iteration.state, iteration.transition)
        return replace(
            iteration, tree=[{**step, "transition": key} if step is own else step for step in iteration.tree]
        )
