"""Divisions by zero and guards that hold together, replayed in the reference interpreter with the values found."""

import os
import random
from collections.abc import Mapping
from dataclasses import replace
from itertools import product

import pytest

from vicode.analysis.divisions import DivisionSearch
from vicode.analysis.examples import Example
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.overlaps import find_overlaps
from vicode.check import build_context
from vicode.findings import DesignPath
from vicode.model.design import Assign, Declaration, Design, Guard, State, Transition
from vicode.model.project import Project
from vicode.semantics import Interpreter, Value
from vicode.semantics.values import OPERATORS

SEEDS = range(int(os.environ.get("VICODE_EXPLORED", "20")))
TICK_NS = 20_000_000
NAMES = ("A", "B", "C")
PARAMETERS = (
    Declaration(name="b", type="bool"),
    Declaration(name="n", type="int", range=(0, 3)),
    Declaration(name="m", type="int", range=(1, 2)),
    Declaration(name="x", type="float", range=(0, 2)),
    Declaration(name="y", type="float"),
)
INPUTS: tuple[Mapping[str, Value], ...] = tuple(
    dict(zip(("b", "n", "m", "x", "y"), values, strict=True))
    for values in product((False, True), (0, 1, 2, 3), (1, 2), (0.0, 0.5, 1.0, 2.0), (0.0, 1.0))
)
WITH_RANGE = ("n", "x", "n - 2", "m", "abs(x)", "min(x, 1)", "-n", "n * m", "max(n, 1)", "(x if b else m)")
DIVISORS = (*WITH_RANGE, "y", "x - n")
TESTS = ("b", "not b", "n > 0", "n == 2", "x != 0", "x < 1", "y == 0", "m > 1", "state_time > 0.03")


class Robot:
    """Steps one design from any state, with any time in it, and records the divisions by zero by their dividend."""

    def __init__(self, design: Design, monkeypatch: pytest.MonkeyPatch) -> None:
        self.divided: set[float] = set()
        divide = OPERATORS["/"]

        def record(a: float, b: float) -> float:
            self.divided |= {a} if b == 0 else set()
            return divide(a, b)

        monkeypatch.setitem(OPERATORS, "/", record)
        self.robot = Interpreter(Project(name="p", designs=(design,)), "Drawn")
        self.robot.step(0)
        self.ticks = 0

    def step(self, state: str, elapsed_ns: int, inputs: Mapping[str, Value]) -> str:
        """Be in a state for a time when the next iteration comes; return the state after it."""
        self.divided.clear()
        self.ticks += 100
        memory = self.robot.memory.components["Drawn"]
        memory.state, memory.entered_ns = state, self.ticks * TICK_NS - elapsed_ns
        for name, value in inputs.items():
            self.robot.set_input("Drawn", name, value)
        self.robot.step(self.ticks * TICK_NS)
        return memory.state


def draw_design(rng: random.Random) -> Design:
    numbers = iter(range(101, 200))

    def quotient(divisors: tuple[str, ...]) -> str:
        return f"{next(numbers)} / ({rng.choice(divisors)})"

    def guard() -> str:
        compared = f"{quotient(DIVISORS)} > {rng.choice((-1, 60, 1000))}"
        kind, test = rng.randrange(4), rng.choice(TESTS)
        return (compared, f"{test} and {compared}", f"{test} or {compared}", f"{compared} if {test} else b")[kind]

    def state(name: str) -> State:
        first = Transition(to=rng.choice(NAMES), guard=Guard(when=rng.choice(TESTS)))
        second = Transition(to=rng.choice(NAMES), guard=Guard(when=guard()))
        values = (("v", quotient(DIVISORS)), ("w", f"{quotient(DIVISORS)} if {rng.choice(TESTS)} else 0"))
        transitions = rng.choice(((first, second), (second, first)))
        return State(name=name, transitions=transitions, actions=(Assign(values=values),))

    variables = tuple(Declaration(name=name, type="float") for name in "vw")
    states = tuple(map(state, NAMES))
    return Design(component="Drawn", parameters=PARAMETERS, variables=variables, initial="A", states=states)


def find_divisions(design: Design) -> dict[int, tuple[DesignPath, Example]]:
    """The paths and examples of divisions by zero, by their dividend."""
    context = build_context(Project(name="p", designs=(design,)), design)
    search = DivisionSearch(context.machine, {"v", "w"})
    return {
        int(division.left.value): (expression.path, example)  # type: ignore[union-attr]
        for expression in context.expressions
        if expression.tree is not None
        for division, example in search.find(expression.tree, expression.path)
    }


def split_time(example: Example) -> tuple[dict[str, Value], int]:
    """The inputs of an example, and the time in the state in nanoseconds."""
    inputs = {name: value for name, value in example.items() if name != "state_time"}
    return inputs, round(float(example.get("state_time", 0.02)) * 1e9)


@pytest.mark.parametrize("seed", SEEDS)
def test_divisions_by_zero_happen_with_the_values_found(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    design = draw_design(random.Random(seed))
    robot = Robot(design, monkeypatch)
    for dividend, (path, example) in find_divisions(design).items():
        values, time_ns = split_time(example)
        # An action runs after a guard that leads to its state, too.
        sources = (str(path[1]),) if path[2] == "transitions" else NAMES
        times = (time_ns,) if path[2] == "transitions" else (time_ns, TICK_NS, 3 * TICK_NS)
        # What the example leaves out may have any value.
        runs = product(sources, times, ({**inputs, **values} for inputs in INPUTS))
        assert any(dividend in _divided(robot, *run) for run in runs), (path, example)


def _divided(robot: Robot, state: str, time_ns: int, inputs: Mapping[str, Value]) -> set[float]:
    robot.step(state, time_ns, inputs)
    return set(robot.divided)


@pytest.mark.parametrize("seed", SEEDS)
def test_divisions_by_zero_that_happen_are_found(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    design = draw_design(random.Random(seed))
    robot = Robot(design, monkeypatch)
    happened = set[float]()
    reachable = MachineAnalysis(Project(name="p", designs=(design,)), design).reachable
    for state, time_ns, inputs in product(reachable, (TICK_NS, 3 * TICK_NS), INPUTS):
        happened |= _divided(robot, state, time_ns, inputs)
    divisors = _find_divisors(design)
    assert {each for each in happened if divisors[int(each)] in WITH_RANGE} <= find_divisions(design).keys()


def _find_divisors(design: Design) -> dict[int, str]:
    context = build_context(Project(name="p", designs=(design,)), design)
    texts = (each.text for each in context.expressions if "/" in each.text)
    halves = (text.split(" / (", 1) for text in texts)
    return {int(before.split()[-1]): _until_closed(after) for before, after in halves}


def _until_closed(text: str) -> str:
    depth = 1
    for index, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if depth == 0:
            return text[:index]
    raise ValueError(text)


@pytest.mark.parametrize("seed", SEEDS)
def test_guards_that_hold_together_are_found_and_the_first_is_taken(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(seed)
    transitions = tuple(
        Transition(to=f"T{index}", guard=Guard(when=f"{rng.choice(TESTS)} and {rng.choice(TESTS)}"))
        for index in range(3)
    )
    states = (State(name="A", transitions=transitions), *(State(name=each.to) for each in transitions))
    design = Design(component="Drawn", parameters=PARAMETERS, initial="A", states=states)
    robot = Robot(design, monkeypatch)
    alone = [
        Robot(replace(design, states=(replace(states[0], transitions=(each,)), *states[1:])), monkeypatch)
        for each in transitions
    ]

    def find_pairs(time_ns: int, inputs: Mapping[str, Value]) -> set[tuple[int, int]]:
        taken = robot.step("A", time_ns, inputs)
        holding = [index for index, each in enumerate(alone) if each.step("A", time_ns, inputs) == f"T{index}"]
        return {(holding[0], other) for other in holding[1:] if taken == f"T{holding[0]}"}

    guards = MachineAnalysis(Project(name="p", designs=(design,)), design).guards
    found = {(int(first[-1]), int(second[-1])): example for first, second, example in find_overlaps(guards, "A")}
    for pair, example in found.items():
        values, time_ns = split_time(example)
        assert all(pair in find_pairs(time_ns, {**inputs, **values}) for inputs in INPUTS)
    explored = product((TICK_NS, 3 * TICK_NS), INPUTS)
    assert found.keys() == {pair for time_ns, inputs in explored for pair in find_pairs(time_ns, inputs)}
