"""Reads a recorded trace (JSON lines of `vicode run --trace`) to view it or to use its values as inputs."""

import json
from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

from vicode.editor.session.simulation.inputs import SimulationInput
from vicode.editor.session.simulation.recording import MAX_ITERATIONS
from vicode.editor.view import transition_key
from vicode.model.design import COMMON, Design
from vicode.model.traversal import iter_transitions
from vicode.simulation import Inputs, IterationResult

MAX_BYTES = 50_000_000


class TraceError(ValueError):
    """The text is not a trace of this design; the message says why."""


def read_trace(text: str, design: Design) -> tuple[IterationResult, ...]:
    """The iterations of a trace.

    Raises:
        TraceError: It is not a trace, or one of another component.
    """
    if len(text) > MAX_BYTES:
        raise TraceError(f"the trace is longer than {MAX_BYTES // 1_000_000} MB")
    found = _transitions_by_ends(design)
    iterations: list[IterationResult] = []
    for number, line in enumerate(text.splitlines(), start=1):
        record = _parse(line, number)
        if record is None or "tree" not in record:
            continue
        iterations.append(_parse_iteration(record, number, design, found))
        if len(iterations) >= MAX_ITERATIONS:
            break
    if not iterations:
        raise TraceError("the trace has no iterations: record one with vicode run --trace FILE")
    return tuple(iterations)


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
        for step in iteration.tree:
            component = str(step.get("component"))
            values = step.get("values") or {}
            for name, each in names.get(component, {}).items():
                value = each.accept(values.get(name))
                if value is not None and known.get(each.key) != value:
                    known[each.key] = value
                    changes.setdefault(component, {})[name] = value
        script.append(changes)
    return tuple(script)


def _parse(line: str, number: int) -> dict[str, Any] | None:
    if not line.strip():
        return None
    try:
        record = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise TraceError(f"line {number} is not JSON") from error
    if not isinstance(record, dict):
        raise TraceError(f"line {number} is not an iteration record")
    return record


def _parse_iteration(
    record: Mapping[str, Any], number: int, design: Design, found: Mapping[tuple[str, str], list[str]]
) -> IterationResult:
    tree = record["tree"]
    is_tree = isinstance(tree, list) and tree and all(isinstance(step, dict) for step in tree)
    root = tree[0] if is_tree else {}
    numbers = (record.get("iteration"), record.get("time_ns"))
    state, came_from = root.get("state"), root.get("changed_from")
    is_sound = all(isinstance(each, int) for each in numbers) and isinstance(state, str)
    if not is_sound or not isinstance(came_from, str | None):
        raise TraceError(f"line {number} is not an iteration record")
    if root.get("component") != design.component:
        raise TraceError(f"this is a trace of {str(root.get('component'))[:60]}, not of {design.component}")
    return IterationResult(
        iteration=numbers[0] or 0,
        time_ns=numbers[1] or 0,
        state=str(state),
        changed_from=came_from,
        transition=_transition(root, design, found),
        worked=root.get("worked") is True,
        done=root.get("done") is True,
        tree=tree,
        world=record.get("world"),
    )


def _transition(root: Mapping[str, Any], design: Design, found: Mapping[tuple[str, str], list[str]]) -> str | None:
    """The key of the transition taken: by its id, else by its source and target if only one matches."""
    given, came_from, state = root.get("transition"), root.get("changed_from"), root.get("state")
    if came_from is None:
        return None
    if given:
        for located in iter_transitions(design):
            if located.decision.id == given:
                return transition_key(located.path)
    keys = [*found.get((str(came_from), str(state)), ()), *found.get((COMMON, str(state)), ())]
    return keys[0] if len(keys) == 1 else None


def _transitions_by_ends(design: Design) -> dict[tuple[str, str], list[str]]:
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for located in iter_transitions(design):
        found[(located.source, getattr(located.decision, "to", ""))].append(transition_key(located.path))
    return found
