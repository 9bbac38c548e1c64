"""Random inputs: values at and around the numbers that a design compares, and uneven times."""

import math
import random
from collections.abc import Iterator
from typing import Any

from vicode.conformance.inputs import ConformanceRun, RunInput, RunStep, list_inputs
from vicode.generators import collect_components
from vicode.model.constant_folding import evaluate_constants
from vicode.model.expressions import BOOL, INT, Number, build_scope, parse_expression, walk
from vicode.model.project import Project
from vicode.model.traversal import iter_expressions

_NUMBERS = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 300.0)
_TIMES_MS = (1, 10, 20, 20, 20, 50, 100, 1000)


def random_run(project: Project, root: str, *, iterations: int, seed: int) -> ConformanceRun:
    """A run with random inputs; the same seed gives the same run."""
    rng, time_ms = random.Random(seed), 0
    inputs, numbers = tuple(list_inputs(project, root)), sorted({*_NUMBERS, *_known_numbers(project, root)})
    steps = []
    for index in range(iterations):
        changed = inputs if index == 0 else [each for each in inputs if rng.random() < 0.4]
        values = {each.key: _draw(rng, each, numbers) for each in changed}
        steps.append(RunStep(time_ns=time_ms * 1_000_000, inputs=(values,)))
        time_ms += rng.choice(_TIMES_MS)
    return ConformanceRun(project=project, root=root, steps=tuple(steps))


def _draw(rng: random.Random, each: RunInput, numbers: list[float]) -> Any:
    if each.elements:
        return f"{each.type}.{rng.choice(each.elements)}"
    if each.type == BOOL:
        return rng.random() < 0.5
    low, high = each.range or (-1e4, 1e4)
    number = rng.choice(numbers) + rng.choice((0.0, 0.0, 0.01, -0.01, 1.0, -1.0))
    if rng.random() < 0.3 or not low <= number <= high:
        number = rng.uniform(low, high)
    return round(number) if each.type == INT else number


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)


def _known_numbers(project: Project, root: str) -> Iterator[float]:
    """The numbers in the expressions of a design and those that it uses, and the constants."""
    kept = collect_components(project, (root,))
    yield from (float(value) for value in evaluate_constants(project).values() if _is_finite(value))
    for design in project.designs:
        if design.component not in kept:
            continue
        scope = build_scope(project, design)
        for text in iter_expressions(design):
            tree = parse_expression(text.text, scope).tree
            yield from (float(node.value) for node in walk(tree) if isinstance(node, Number)) if tree else ()
