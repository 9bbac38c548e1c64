"""Small random designs, explored with the reference interpreter: every state, time and input.

The guards compare with constants only, so the analysis must find exactly what happens, not just a part of it.
"""

import os
import random
from collections.abc import Mapping
from itertools import product

import pytest

from vicode.analysis.alternation import AlternationSearch
from vicode.analysis.machines import MachineAnalysis
from vicode.model.design import Decision, DecisionGroup, Declaration, Design, Guard, State, Stay, Transition
from vicode.model.project import Project
from vicode.semantics import Interpreter, Value

TICK_NS = 20_000_000
TIMERS = (1, 2, 4)
"""In ticks."""
LAST = max(TIMERS) + 1
NAMES = ("A", "B", "C", "D")
INPUTS: tuple[Mapping[str, Value], ...] = tuple(
    dict(zip(("seen", "near", "n", "x"), values, strict=True))
    for values in product((False, True), (False, True), (0, 1, 2), (0.0, 0.5, 1.0, 1.5, 2.0))
)
ATOMS = (
    *("seen", "not seen", "near", "near or seen", "n > 0", "n == 1", "n != 2", "n < 2 and near", "x < 1", "x >= 1"),
    *("0 < x < 2", "x == 2 or n == 0", "not (x > 1 and seen)", "x < 0", "n > 2", "True"),
)
Explored = dict[tuple[str, int], set[str]]
"""The next states, by state and time in ticks."""


def draw_design(rng: random.Random) -> Design:
    def guard() -> Guard:
        timer = f"{rng.choice(TIMERS) * TICK_NS / 1e9:g}" if rng.random() < 0.3 else ""
        return Guard(when="" if timer and rng.random() < 0.5 else rng.choice(ATOMS), after=timer)

    def decision(depth: int) -> Decision:
        if depth and rng.random() < 0.2:
            then, otherwise = ([decision(0) for _ in range(rng.randint(least, 2))] for least in (1, 0))
            return DecisionGroup(guard=guard(), then=tuple(then), otherwise=tuple(otherwise))
        return Stay(guard=guard()) if rng.random() < 0.2 else Transition(to=rng.choice(NAMES), guard=guard())

    return Design(
        component="Drawn",
        parameters=(
            Declaration(name="seen", type="bool"),
            Declaration(name="near", type="bool"),
            Declaration(name="n", type="int", range=(0, 2)),
            Declaration(name="x", type="float", range=(0, 2)),
        ),
        initial="A",
        states=tuple(
            State(name=name, transitions=tuple(decision(1) for _ in range(rng.randint(0, 3)))) for name in NAMES
        ),
    )


class Explorer:
    """Steps one design from any state, with any time in it and any inputs."""

    def __init__(self, design: Design) -> None:
        self.robot = Interpreter(Project(name="p", designs=(design,)), "Drawn")
        self.robot.step(0)
        self.ticks = 0

    def enter(self, state: str, elapsed: int) -> None:
        """Be in a state for some ticks when the next iteration comes."""
        memory = self.robot.memory.components["Drawn"]
        memory.state, memory.entered_ns = state, (self.ticks + 1 - elapsed) * TICK_NS

    def step(self, inputs: Mapping[str, Value]) -> str:
        for name, value in inputs.items():
            self.robot.set_input("Drawn", name, value)
        self.ticks += 1
        self.robot.step(self.ticks * TICK_NS)
        return self.robot.memory.components["Drawn"].state

    def explore(self) -> Explored:
        found: Explored = {}
        for state, elapsed in product(NAMES, range(LAST + 1)):
            found[state, elapsed] = set()
            for inputs in INPUTS:
                self.enter(state, elapsed)
                found[state, elapsed].add(self.step(inputs))
        return found

    def alternates(self, states: tuple[str, ...]) -> bool:
        """Whether some inputs that hold still lead from state to state in each iteration."""
        for inputs in INPUTS:
            self.enter(states[0], 1)
            if all(self.step(inputs) == states[(index + 1) % len(states)] for index in range(2 * len(states))):
                return True
        return False


def find_reachable(explored: Explored) -> set[str]:
    pending, reachable = ["A"], set[str]()
    while pending:
        state = pending.pop()
        if state not in reachable:
            reachable.add(state)
            pending += {each for elapsed in range(LAST + 1) for each in explored[state, elapsed]}
    return reachable


# A run of 500 designs is done by hand: VICODE_EXPLORED=500.
@pytest.mark.parametrize("seed", range(int(os.environ.get("VICODE_EXPLORED", "20"))))
def test_the_analysis_finds_exactly_what_happens(seed: int) -> None:
    design = draw_design(random.Random(seed))
    machine = MachineAnalysis(Project(name="p", designs=(design,)), design)
    explorer = Explorer(design)
    explored = explorer.explore()
    assert machine.reachable == find_reachable(explored)
    for state in NAMES:
        leaves = [explored[state, elapsed] - {state} for elapsed in range(LAST + 1)]
        stays = [state in explored[state, elapsed] for elapsed in range(LAST + 1)]
        assert {each.target for each in machine.live[state]} == set().union(*leaves)
        time = machine.time_in(state)
        assert time is not None
        if any(leaves):
            assert time.at_least_ns == next(at for at, each in enumerate(leaves) if each) * TICK_NS
        # "More than 2 s" is met at the next tick.
        at_most = None if time.at_most_ns is None else -(-time.at_most_ns // TICK_NS)
        assert at_most == (None if stays[-1] else max((at + 1 for at, each in enumerate(stays) if each), default=0))


@pytest.mark.parametrize("seed", range(int(os.environ.get("VICODE_EXPLORED", "20"))))
def test_states_that_alternate_are_found(seed: int) -> None:
    design = draw_design(random.Random(seed))
    project = Project(name="p", designs=(design,))
    machine = MachineAnalysis(project, design)
    explorer = Explorer(design)
    passing = {
        state
        for state in NAMES
        if (time := machine.time_in(state)) and time.at_most_ns is not None and time.at_most_ns <= TICK_NS
    }
    expected = {
        frozenset(states)
        for states in product(NAMES, NAMES)
        if states[0] < states[1]
        and not passing & set(states)
        and set(states) <= machine.reachable
        and explorer.alternates(states)
    }
    found = {frozenset(each.states) for each in AlternationSearch(project, machine).find() if len(each.states) == 2}
    assert found == expected
