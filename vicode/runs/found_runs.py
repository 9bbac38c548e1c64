"""Runs that the analysis found, as traces: the reference interpreter repeats them."""

import json

from vicode.bica.observer import TRACE_HEADER
from vicode.findings import FoundRun
from vicode.model.project import Project
from vicode.semantics import InputFunction, Interpreter, Value


def write_found_run(project: Project, found: FoundRun) -> str:
    """The trace of a run, with values.

    Raises:
        NotInterpretableError: The designs have changed so that they cannot be interpreted.
    """
    robot = Interpreter(project, found.component)
    for name, machine in robot.machines.items():
        for function, value in machine.functions.items():
            robot.set_input(name, function, _always(value))
    records: list[object] = [TRACE_HEADER]
    for time_ns, inputs in found.steps:
        for component, name, given in inputs:
            is_function = name in robot.machines[component].functions
            robot.set_input(component, name, _always(given) if is_function else given)
        records.append(robot.step(time_ns))
    return "".join(f"{json.dumps(record, default=dict)}\n" for record in records)


def _always(value: Value) -> InputFunction:
    return lambda _arguments: value
