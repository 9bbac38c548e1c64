"""Values and times for inputs: at and around the numbers that a design compares, and unusual ones."""

import math
import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from vicode.conformance.inputs import PARAMETERS, InputKey, RunInput
from vicode.generators import collect_components
from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import Design
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Expr,
    Number,
    OutputRef,
    Variable,
    build_scope,
    parse_expression,
    walk,
)
from vicode.model.project import Project
from vicode.model.traversal import iter_expressions

MS = 1_000_000
_NUMBERS = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 300.0)
_UNUSUAL = (math.nan, math.inf, -math.inf, -0.0, 0.0, 1e308, -1e308, 5e-324, 2.0**53, -(2.0**53))
_SPECIAL = 4
"""The number of values of `_UNUSUAL` that are dealt first."""
_INTS = (-(2**53), -(2**31), 2**31, 2**53)
_USUAL_NS = (1 * MS, 10 * MS, 20 * MS, 20 * MS, 20 * MS, 50 * MS, 100 * MS, 1000 * MS)
_SHORT_NS = (0, 0, 1, 999_999, 500_000, 1_000_001, 1_500_000, 16_666_667, 33_333_333)
_BACK_NS = (-1, -1 * MS, -30 * MS, -5000 * MS)
_PAUSES_NS = (60_000 * MS, 3_600_000 * MS)


@dataclass(frozen=True, slots=True)
class ValueDrawer:
    """Draws values of inputs and times between iterations.

    Attributes:
        numbers: The numbers that the design mentions.
        whole_ms: Whether times are whole milliseconds, as XABSL has them.
    """

    rng: random.Random
    numbers: tuple[float, ...]
    whole_ms: bool = False

    def value(self, each: RunInput) -> Any:
        """Draw a value of an input."""
        rng = self.rng
        if each.elements:
            return f"{each.type}.{rng.choice(each.elements)}"
        if each.type == BOOL:
            return rng.random() < 0.5
        kind = rng.random()
        if kind < 0.03:
            return rng.choice(_INTS if each.type == INT else _UNUSUAL)
        low, high = each.range or (-1e4, 1e4)
        if kind < 0.25:
            return self._typed(each, rng.uniform(low, high))
        if kind < 0.3:
            return self._typed(each, rng.choice((low, high, low - 1, high + 1)))
        return self._typed(each, self._near(rng.choice(self.numbers)))

    def time_ns(self, boundaries: Iterable[int] = ()) -> int:
        """Draw the time until the next iteration; the clock may be set back.

        Args:
            boundaries: Times after which a timer or period ends.
        """
        rng, kind = self.rng, self.rng.random()
        ends = tuple(boundaries)
        if ends and kind < 0.35:
            unit = MS if self.whole_ms else 1
            ns = rng.choice(ends) + rng.choice((0, 0, -unit, -unit, unit))
        elif kind < 0.8:
            ns = rng.choice(_USUAL_NS)
        elif kind < 0.94:
            ns = rng.choice(_SHORT_NS)
        else:
            ns = rng.choice(_BACK_NS if kind < 0.98 else _PAUSES_NS)
        return -(-ns // MS) * MS if self.whole_ms else ns

    def _near(self, number: float) -> float:
        match self.rng.randrange(8):
            case 0:
                return math.nextafter(number, math.inf)
            case 1:
                return math.nextafter(number, -math.inf)
            case 2:
                return number + self.rng.choice((0.01, -0.01))
            case 3 | 4:
                return number + self.rng.choice((1.0, -1.0))
            case _:
                return number

    def _typed(self, each: RunInput, number: float) -> Any:
        if each.type != INT:
            return number
        return round(number) if math.isfinite(number) and abs(number) <= 2**53 else 0


def deal_unusual(rng: random.Random, inputs: Sequence[RunInput]) -> Iterator[tuple[RunInput, float]]:
    """Each input with each of its unusual values, again and again; nan, the infinities and -0.0 come first."""
    floats = [each for each in inputs if each.type == FLOAT]
    first = [(each, value) for each in floats for value in _UNUSUAL[:_SPECIAL]]
    others = [(each, value) for each in floats for value in _UNUSUAL[_SPECIAL:]]
    others += [(each, value) for each in inputs if each.type == INT for value in _INTS]
    while first or others:
        yield from rng.sample(first, len(first))
        yield from rng.sample(others, len(others))


def mentioned_inputs(project: Project, root: str) -> frozenset[InputKey]:
    """The inputs that an expression of a design mentions."""
    return frozenset(_iter_mentioned(project, root))


def _iter_mentioned(project: Project, root: str) -> Iterator[InputKey]:
    for design, tree in _iter_trees(project, root):
        components = {use.alias: use.component for use in design.uses}
        for node in walk(tree):
            match node:
                case OutputRef(alias=alias, output=output):
                    yield components[alias], output
                case Variable(name=name) if design.component == root:
                    yield PARAMETERS, name


def known_numbers(project: Project, root: str) -> tuple[float, ...]:
    """Usual numbers, those in the expressions of a design and those that it uses, and the constants."""
    return tuple(sorted({*_NUMBERS, *_mentioned_numbers(project, root)}))


def _mentioned_numbers(project: Project, root: str) -> Iterator[float]:
    yield from (float(value) for value in evaluate_constants(project).values() if _is_finite(value))
    for _design, tree in _iter_trees(project, root):
        yield from (float(node.value) for node in walk(tree) if isinstance(node, Number))


def _iter_trees(project: Project, root: str) -> Iterator[tuple[Design, Expr]]:
    """The expressions of a design and of those that it uses."""
    kept = collect_components(project, (root,))
    for design in project.designs:
        if design.component in kept:
            scope = build_scope(project, design)
            trees = (parse_expression(text.text, scope).tree for text in iter_expressions(design))
            yield from ((design, tree) for tree in trees if tree is not None)


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)
