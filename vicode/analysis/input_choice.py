"""Chooses inputs that are in a diagram, for the present state of a robot."""

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product, zip_longest
from types import MappingProxyType

from vicode.analysis.conditions import STATE_TIME
from vicode.analysis.examples import choose_values
from vicode.analysis.interval_diagrams import Interval, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.quantities import Quantity
from vicode.model.expressions import FLOAT, Done, ElapsedTime, Expr, OutputRef, Variable, walk
from vicode.model.project import Project
from vicode.semantics import RobotMemory, Value

DEFAULT_TICK_NS = 20_000_000
_MOST_TIME = 1e6
_EQUAL: Interval = ((0, 0), (0, 1))
_MOST_BOXES, _MOST_CHOICES, _MOST_VALUES, _MOST_TRIES = 16, 12, 4, 120

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
        self.tick_ns = round(1e9 / self._design.frequency_hz) if self._design.frequency_hz else DEFAULT_TICK_NS

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
        # One of each box after another: the values of some boxes may be impossible together.
        found = [self._choose_in(memory, box) for box in boxes]
        tries = (each for row in zip_longest(*found) for each in row if each is not None)
        yield from islice(tries, _MOST_TRIES)

    def _choose_in(self, memory: RobotMemory, box: Mapping[int, Interval]) -> Iterator[tuple[Inputs, int]]:
        settable = {level: key for level in box if (key := self._key(self._conditions.quantities[level]))}
        groups = self._group_equal(box, settable)
        choices = [list(self._choose_common(group, box)) for group in groups]
        for time_ns in self._list_times(memory, box) if all(choices) else ():
            for values in _combine(choices):
                chosen = zip(groups, values, strict=True)
                yield {settable[level]: value for group, value in chosen for level in group}, time_ns

    def _choose_common(self, group: Sequence[int], box: Mapping[int, Interval]) -> Iterator[Value]:
        """Values that are in the intervals of all levels of a group."""
        low, high = max(box[level][0] for level in group), min(box[level][1] for level in group)
        interval = (low, high) if low < high else box[group[0]]
        return self._choose(self._conditions.quantities[group[0]], interval)

    def _group_equal(self, box: Mapping[int, Interval], settable: Mapping[int, object]) -> list[list[int]]:
        """The levels of inputs; those that must be equal are in one group."""
        group_of = {level: [level] for level in settable}
        for level, interval in box.items():
            reads = self._conditions.computed.reads_of(level)
            if interval == _EQUAL and len(reads) == 2 and all(each in group_of for each in reads):
                one, other = (group_of[each] for each in reads)
                if one is not other:
                    one += other
                    group_of |= dict.fromkeys(other, one)
        return list({id(group): group for group in group_of.values()}.values())

    @property
    def reads_fixed(self) -> bool:
        """Whether a guard reads what no input sets, apart from times."""
        quantities = self._conditions.quantities.values()
        return any(
            isinstance(each.tree, Variable | OutputRef | Done) and self._key(each) is None for each in quantities
        )

    def read_fixed(self, memory: RobotMemory) -> Iterator[Value | None]:
        """The present values of what the guards read and no input sets."""
        quantities = self._conditions.quantities.values()
        return (self._present_value(memory, each) for each in quantities if self._key(each) is None)

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

    def _list_times(self, memory: RobotMemory, box: Mapping[int, Interval]) -> Iterator[int]:
        """The soonest time, and those at which the time in the state reaches what it is compared with."""
        entered = memory.components[self._design.component].entered_ns
        soonest = memory.now_ns + self.tick_ns
        yield soonest if STATE_TIME not in box else max(soonest, entered + math.ceil(box[STATE_TIME][0][0]))
        for level in box:
            nodes = [node for tree in self._conditions.computed.trees_of(level) for node in walk(tree)]
            if any(isinstance(node, ElapsedTime) for node in nodes):
                values = (memory.components[self._design.component].values.get(name) for name in _names(nodes))
                limits = (each for each in values if isinstance(each, float) and 0 < each < _MOST_TIME)
                later = (entered + math.ceil(each * self._conditions.table.ns_per_unit) for each in limits)
                yield from (each for each in later if each > soonest)

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
        for value in islice(choose_values(quantity, interval, self._conditions.table), _MOST_VALUES):
            yield f"{quantity.type}.{value}" if isinstance(value, str) else value


def _names(nodes: Sequence[Expr]) -> Iterator[str]:
    return (node.name for node in nodes if isinstance(node, Variable))


def _combine(choices: Sequence[Sequence[Value]]) -> Iterator[tuple[Value, ...]]:
    """Combinations of values: first those at the same places of all lists, then at different ones, then any."""
    for index in range(max(map(len, choices), default=1)):
        yield tuple(each[min(index, len(each) - 1)] for each in choices)
        yield tuple(each[(index + at) % len(each)] for at, each in enumerate(choices))
    yield from islice(product(*choices), _MOST_CHOICES)
    if math.prod(map(len, choices)) > _MOST_CHOICES:
        chance = random.Random(0)
        yield from (tuple(map(chance.choice, choices)) for _ in range(2 * _MOST_CHOICES))
