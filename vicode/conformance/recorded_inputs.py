"""The inputs of a trace that was recorded with values."""

from collections.abc import Iterable
from typing import Any

from vicode.conformance.inputs import PARAMETERS, ConformanceRun, InputKey, RunStep, list_inputs
from vicode.model.project import Project
from vicode.simulation import IterationResult


def recorded_run(
    project: Project, root: str, iterations: Iterable[IterationResult], *, is_exact: bool = False
) -> ConformanceRun:
    """A run with the times and inputs of a trace.

    An output with arguments has the first value of each iteration. If it `is_exact`, it has those of all calls, and
    outputs change when their component is stepped; C++ and XABSL cannot run that.
    """
    inputs, known, steps = tuple(list_inputs(project, root)), dict[InputKey, Any](), []
    for iteration in iterations:
        values: dict[str, dict[str, Any]] = {name: each for name, each in iteration.values().items() if each}
        values[PARAMETERS] = iteration.tree[0].get("values") or {}
        for call in reversed(iteration.calls):
            known_values = values.get(call["component"], {})
            value: Any = call["value"]
            if is_exact:
                later = known_values.get(call["output"])
                value = [[call["arguments"], value], *(later if isinstance(later, list) else ())]
            values[call["component"]] = {**known_values, call["output"]: value}
        changed: dict[InputKey, Any] = {}
        for each in inputs:
            value = values.get(each.component, {}).get(each.name)
            if value is not None and known.get(each.key) != value:
                known[each.key] = changed[each.key] = _number(value) if not each.elements else value
        steps.append(RunStep(time_ns=iteration.time_ns, inputs=(changed,)))
    return ConformanceRun(project=project, root=root, steps=tuple(steps), holds_outputs=is_exact)


def _number(value: Any) -> Any:
    if isinstance(value, list):
        return [[arguments, _number(each)] for arguments, each in value]
    return float(value) if isinstance(value, str) else value
