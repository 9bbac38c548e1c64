"""Chooses inputs that are in a diagram, for the present state of a robot."""

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product
from types import MappingProxyType

from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.interval_diagrams import BEFORE_NAN, Interval, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.quantities import Quantity
from vicode.model.expressions import BOOL, FLOAT, INT, OutputRef, Variable
from vicode.model.project import Project
from vicode.semantics import RobotMemory, Value

_TICK_NS = 20_000_000
_MOST_BOXES, _MOST_CHOICES = 16, 12

Inputs = Mapping[tuple[str, str], Value]
"""Values by component and name: outputs of components without a design, parameters of the root."""


class InputChooser:
    """Chooses inputs for the decisions of one component of a robot.

    Args:
        project: The project, with all designs.
        machine: The component.
        is_root: Whether it is stepped in each iteration, so that its parameters are inputs.
    """

    def __init__(self, project: Project, machine: MachineAnalysis, *, is_root: bool = True) -> None:
        self._project = project
        self._design = machine.design
        self._conditions = machine.guards.conditions
        self._is_root = is_root
        self.tick_ns = round(1e9 / self._design.frequency_hz) if self._design.frequency_hz else _TICK_NS

    def find(
        self, memory: RobotMemory, node: Node, fixed: Inputs = MappingProxyType({})
    ) -> Iterator[tuple[Inputs, int]]:
        """Yield inputs that are in a diagram together with the present values of everything else, and their time.

        Args:
            memory: The present values.
            node: The diagram.
            fixed: The values of some inputs.
        """
        try:
            boxes = list(
                islice(self._conditions.diagrams.iterate_boxes(self._restrict(memory, node, fixed)), _MOST_BOXES)
            )
        except (TooLargeError, RecursionError):
            return
        for box in boxes:
            settable = {level: key for level in box if (key := self._key(self._conditions.quantities[level]))}
            choices = [list(self._choose(self._conditions.quantities[level], box[level])) for level in settable]
            for values in _combine(choices):
                yield dict(zip(settable.values(), values, strict=True)), self._time_of(memory, box.get(STATE_TIME))

    def _restrict(self, memory: RobotMemory, node: Node, fixed: Inputs) -> Node:
        diagrams, conditions = self._conditions.diagrams, self._conditions
        restricted = diagrams.both(node, conditions.possible((node,), with_nan=False))
        for level in diagrams.find_cuts((restricted,)):
            quantity = conditions.quantities[level]
            key = self._key(quantity)
            value = self._present_value(memory, quantity) if key is None else fixed.get(key)
            if value is not None:
                restricted = diagrams.both(restricted, diagrams.test(level, (self._point(quantity, value),)))
        return restricted

    def _time_of(self, memory: RobotMemory, interval: Interval | None) -> int:
        entered = memory.components[self._design.component].entered_ns
        soonest = memory.now_ns + self.tick_ns
        return soonest if interval is None else max(soonest, entered + math.ceil(interval[0][0]))

    def _key(self, quantity: Quantity) -> tuple[str, str] | None:
        """The component and name of an input; None for what is no input."""
        match quantity.tree:
            case Variable(name=name, kind="parameter") if self._is_root:
                return (self._design.component, name)
            case OutputRef(alias=alias, output=output):
                use = self._design.use(alias)
                is_input = use is not None and self._project.design(use.component) is None
                return (use.component, output) if use is not None and is_input else None
            case _:
                return None

    def _present_value(self, memory: RobotMemory, quantity: Quantity) -> Value | None:
        match quantity.tree:
            case Variable(name=name):
                return memory.components[self._design.component].values.get(name)
            case OutputRef(alias=alias, output=output, arguments=None):
                use = self._design.use(alias)
                return memory.components[use.component].values.get(output) if use else None
            case _:
                return None

    def _point(self, quantity: Quantity, value: Value) -> Interval:
        if isinstance(value, str):
            elements = self._conditions.table.elements(quantity.type)
            value = elements.index(value.rpartition(".")[2])
        if quantity.type == FLOAT:
            return ((float(value), 0), (float(value), 1))
        return ((int(value), 0), (int(value) + 1, 0))

    def _choose(self, quantity: Quantity, interval: Interval) -> Iterator[Value]:
        """Values in an interval, plain ones first."""
        low = max(interval[0], quantity.domain[0])
        high = min(interval[1], quantity.domain[1], BEFORE_NAN)
        if quantity.type == BOOL:
            yield low[0] >= 1
        elif quantity.type == INT:
            yield from _plain_ints(int(low[0]), int(high[0]) - 1)
        elif quantity.type == FLOAT:
            yield from _plain_floats(low, high)
        else:
            yield f"{quantity.type}.{self._conditions.table.elements(quantity.type)[int(low[0])]}"


def _combine(choices: Sequence[Sequence[Value]]) -> Iterator[tuple[Value, ...]]:
    """Combinations of values; first those in the same places, which are equal for the same intervals."""
    for index in range(max(map(len, choices), default=0)):
        yield tuple(each[min(index, len(each) - 1)] for each in choices)
    yield from islice(product(*choices), _MOST_CHOICES)
    if math.prod(map(len, choices)) > _MOST_CHOICES:
        chance = random.Random(0)
        yield from (tuple(map(chance.choice, choices)) for _ in range(2 * _MOST_CHOICES))


def _plain_ints(low: int, high: int) -> Iterator[int]:
    nearest = min(max(0, low), high)
    yield from dict.fromkeys((nearest, low, high, (low + high) // 2))


def _plain_floats(low: tuple[float, int], high: tuple[float, int]) -> Iterator[float]:
    """The number with the fewest digits in the interval, then its ends and middle."""
    least = low[0] if low[1] == 0 else math.nextafter(low[0], math.inf)
    greatest = high[0] if high[1] == 1 else math.nextafter(high[0], -math.inf)
    least, greatest = max(least, -1e15), min(greatest, 1e15)
    middle = min(max(0.0, least), greatest) if math.isinf(low[0]) or math.isinf(high[0]) else (least + greatest) / 2
    plain = [0.0] if least <= 0 <= greatest else []
    for digits in range(-15, 16):
        rounded = round(middle, digits)
        if least <= rounded <= greatest:
            plain.append(rounded)
            break
    yield from dict.fromkeys(each for each in (*plain, middle, least, greatest) if least <= each <= greatest)
