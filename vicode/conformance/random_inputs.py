"""Random inputs, for designs that the reference interpreter cannot run."""

import random

from vicode.conformance.input_values import ValueDrawer, known_numbers
from vicode.conformance.inputs import ConformanceRun, RunStep, list_inputs
from vicode.model.project import Project


def random_run(project: Project, root: str, *, iterations: int, seed: int, whole_ms: bool = True) -> ConformanceRun:
    """A run with random inputs; the same seed gives the same run.

    Args:
        project: The project.
        root: The root component.
        iterations: The number of iterations.
        seed: The seed.
        whole_ms: Whether times are whole milliseconds, which XABSL needs.
    """
    draw = ValueDrawer(random.Random(seed), known_numbers(project, root), whole_ms)
    inputs, time_ns = tuple(list_inputs(project, root)), 0
    steps = []
    for index in range(iterations):
        changed = inputs if index == 0 else [each for each in inputs if draw.rng.random() < 0.4]
        values = {each.key: draw.value(each) for each in changed}
        steps.append(RunStep(time_ns=time_ns, inputs=(values,)))
        time_ns = max(0, time_ns + draw.time_ns())
    return ConformanceRun(project=project, root=root, steps=tuple(steps))
