"""Runs of the reference interpreter that follow the transitions of a design: witnesses of what is possible.

A diagram yields the inputs and the time for which a transition is taken; the interpreter decides whether it is. So a
mistake of the analysis cannot become a witness.
"""

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product
from types import MappingProxyType

from vicode.analysis.conditions import STATE_TIME, Conditions
from vicode.analysis.interval_diagrams import BEFORE_NAN, Interval, Node, TooLargeError
from vicode.analysis.machines import LiveTransition, MachineAnalysis
from vicode.analysis.quantities import Quantity
from vicode.model.design import Decision
from vicode.model.expressions import BOOL, FLOAT, INT, OutputRef, Variable
from vicode.model.project import Project
from vicode.semantics import ComponentStep, InputFunction, Interpreter, Outcome, RobotMemory, Value

DEFAULT_TICK_NS = 20_000_000
_MOST_BOXES, _MOST_CHOICES = 16, 12

OnDecision = Callable[[ComponentStep, Decision, Outcome], None]
Inputs = Mapping[tuple[str, str], Value]
"""Values by component and name: outputs of components without a design, parameters of the root."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WalkStep:
    """One iteration: its time, the inputs that were set before it, and the state after it."""

    time_ns: int
    inputs: Inputs
    state: str


class Walk:
    """A run of one component that continues transition by transition.

    Args:
        project: The project, with all designs.
        machine: The design that is the root.
        on_decision: Is called with each decision of a step and what became of it.

    Raises:
        NotInterpretableError: A design has errors, or code that is not portable.
    """

    def __init__(self, project: Project, machine: MachineAnalysis, on_decision: OnDecision = lambda *_: None) -> None:
        self._project = project
        self._machine = machine
        self._design = machine.design
        self._conditions: Conditions = machine.guards.conditions
        self._robot = Interpreter(project, self._design.component, on_decision=on_decision)
        for name, each in self._robot.machines.items():
            for function, value in each.functions.items():
                self._robot.set_input(name, function, _always(value))
        self.tick_ns = round(1e9 / self._design.frequency_hz) if self._design.frequency_hz else DEFAULT_TICK_NS
        self.steps: list[WalkStep] = []

    @property
    def state(self) -> str:
        return self._memory.components[self._design.component].state

    @property
    def _memory(self) -> RobotMemory:
        return self._robot.memory

    def go_to(self, state: str) -> bool:
        """Follow a shortest way of live transitions to a state; False if a transition on it could not be taken."""
        if self.steps:
            return self._follow_way(state)
        start = self.save()
        for inputs in self._find_first_inputs(state):
            self.step(inputs, 0)
            if self._follow_way(state):
                return True
            self.restore(start)
        return False

    def _find_first_inputs(self, goal: str) -> Iterator[Inputs]:
        """Inputs of the first iteration, in which the initial state can already be left."""
        at_start = self._conditions.diagrams.test(STATE_TIME, (((0, 0), (1, 0)),))
        ways = self._shortest_way(goal)[:1]
        for node in (self._machine.staying(self.state), *(edge.taken for edge in ways)):
            found = self._find_inputs(self._conditions.diagrams.both(node, at_start))
            yield from (inputs for inputs, _time_ns in islice(found, 1))
        yield {}

    def _follow_way(self, state: str) -> bool:
        while self.state != state:
            edge = next(iter(self._shortest_way(state)), None)
            if edge is None or len(self.steps) > len(self._design.states) or not self.take(edge):
                return False
        return True

    def take(self, edge: LiveTransition) -> bool:
        """Take a transition in the next iteration; without effect if no inputs are found."""
        return self.meet(edge.taken, lambda: self.state == edge.target)

    def meet(self, node: Node, is_met: Callable[[], bool]) -> bool:
        """Run an iteration with values of a diagram after which a condition holds; without effect if none is found."""
        for inputs, time_ns in self._find_inputs(node):
            before = self.save()
            self.step(inputs, time_ns)
            if is_met():
                return True
            self.restore(before)
        return False

    def hold(self, node: Node, states: Sequence[str]) -> bool:
        """Set inputs that are in a diagram once; whether the next iterations are in these states, one after another."""
        for inputs, _time_ns in self._find_inputs(node):
            before = self.save()
            for index, state in enumerate(states):
                self.step(inputs if index == 0 else {}, self._memory.now_ns + self.tick_ns)
                if self.state != state:
                    break
            else:
                return True
            self.restore(before)
        return False

    def find_inputs_to_stay(self, state: str, fixed: Inputs, iterations: int) -> Iterator[Inputs]:
        """Yield inputs, the fixed ones among them, for which the root stays in a state for some iterations."""
        early = self._conditions.diagrams.test(STATE_TIME, (((0, 0), (self.tick_ns * (iterations + 1), 0)),))
        node = self._conditions.diagrams.both(self._machine.staying(state), early)
        for inputs, _time_ns in self._find_inputs(node, fixed):
            yield {**inputs, **fixed}

    def follow(self, component: str, expected: Sequence[str], states: Mapping[str, str], inputs: Inputs) -> bool:
        """Put components into states that they have just entered; whether the next states of one are the expected ones.

        The inputs hold still. Without effect if they are not.
        """
        before = self.save()
        self.step(inputs, self._memory.now_ns + self.tick_ns)
        memories = self._memory.components
        for name, state in states.items():
            # A component that was not active before would restart.
            memories[name].state, memories[name].stepped_in = state, self._memory.iteration
            memories[name].entered_ns = self._memory.now_ns
        for state in expected:
            self.step({}, self._memory.now_ns + self.tick_ns)
            memory = self._memory.components[component]
            if memory.state != state or memory.stepped_in != self._memory.iteration:
                self.restore(before)
                return False
        return True

    def step(self, inputs: Inputs, time_ns: int) -> None:
        """Run an iteration."""
        for (component, name), value in inputs.items():
            machine = self._robot.machines[component]
            self._robot.set_input(component, name, _always(value) if name in machine.functions else value)
        self._robot.step(time_ns)
        self.steps.append(WalkStep(time_ns=time_ns, inputs=inputs, state=self.state))

    def save(self) -> tuple[RobotMemory, tuple[WalkStep, ...]]:
        return self._memory.copy(), tuple(self.steps)

    def restore(self, saved: tuple[RobotMemory, tuple[WalkStep, ...]]) -> None:
        """Continue where the walk was saved."""
        self._robot.memory = saved[0].copy()
        self.steps[:] = saved[1]

    def _shortest_way(self, goal: str) -> list[LiveTransition]:
        ways: dict[str, list[LiveTransition]] = {self.state: []}
        pending = [self.state]
        while pending and goal not in ways:
            following: list[str] = []
            for name in pending:
                for edge in self._machine.live.get(name, ()):
                    if edge.target not in ways:
                        ways[edge.target] = [*ways[name], edge]
                        following.append(edge.target)
            pending = following
        return ways.get(goal, [])

    # Inputs

    def _find_inputs(self, node: Node, fixed: Inputs = MappingProxyType({})) -> Iterator[tuple[Inputs, int]]:
        """Inputs that are in a diagram together with the present values of everything else, and the time for them."""
        try:
            boxes = list(islice(self._conditions.diagrams.iterate_boxes(self._restrict(node, fixed)), _MOST_BOXES))
        except (TooLargeError, RecursionError):
            return
        for box in boxes:
            settable = {level: key for level in box if (key := self._key(self._conditions.quantities[level]))}
            choices = [list(self._choose(self._conditions.quantities[level], box[level])) for level in settable]
            for values in _combine(choices):
                yield dict(zip(settable.values(), values, strict=True)), self._time_of(box.get(STATE_TIME))

    def _restrict(self, node: Node, fixed: Inputs) -> Node:
        diagrams, conditions = self._conditions.diagrams, self._conditions
        restricted = diagrams.both(node, conditions.possible((node,), with_nan=False))
        for level in diagrams.find_cuts((restricted,)):
            quantity = conditions.quantities[level]
            key = self._key(quantity)
            value = self._present_value(quantity) if key is None else fixed.get(key)
            if value is not None:
                restricted = diagrams.both(restricted, diagrams.test(level, (self._point(quantity, value),)))
        return restricted

    def _time_of(self, interval: Interval | None) -> int:
        entered = self._memory.components[self._design.component].entered_ns
        soonest = self._memory.now_ns + self.tick_ns
        return soonest if interval is None else max(soonest, entered + math.ceil(interval[0][0]))

    def _key(self, quantity: Quantity) -> tuple[str, str] | None:
        """The component and name of an input; None for what is no input."""
        match quantity.tree:
            case Variable(name=name, kind="parameter"):
                return (self._design.component, name)
            case OutputRef(alias=alias, output=output):
                use = self._design.use(alias)
                is_input = use is not None and self._project.design(use.component) is None
                return (use.component, output) if use is not None and is_input else None
            case _:
                return None

    def _present_value(self, quantity: Quantity) -> Value | None:
        match quantity.tree:
            case Variable(name=name):
                return self._memory.components[self._design.component].values.get(name)
            case OutputRef(alias=alias, output=output, arguments=None):
                use = self._design.use(alias)
                return self._memory.components[use.component].values.get(output) if use else None
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


def _always(value: Value) -> InputFunction:
    return lambda _arguments: value


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
