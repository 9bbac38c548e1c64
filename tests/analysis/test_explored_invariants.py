"""Conditions that hold after each step of small random designs, compared with an exploration of all their values."""

import os
import random
from collections import Counter

import pytest

from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.properties import PropertyAnalysis, PropertyVerdict
from vicode.model.design import (
    Assign,
    Code,
    CommonSection,
    Declaration,
    Design,
    Guard,
    InvariantProperty,
    RunCode,
    State,
    Transition,
)
from vicode.model.project import Project
from vicode.semantics import Interpreter

NAMES = ("A", "B", "C")
VALUES = (
    "0",
    "1",
    "n + 1 if n < 5 else 0",
    "n - 1 if n > -2 else n",
    "m",
    "n",
    "min(n + 1, 3)",
    "abs(n - m)",
    "2 if seen else m",
    "min(max(n, m), 2)",
)
GUARDS = ("", "seen", "n < 3", "n > 0", "n == m", "not seen and m > 1", "n + m < 4")
CONDITIONS = (
    *("n <= 3", "n >= 0", "n <= 1", "m == 0", "n <= m", "n + m <= 6", "n < 5 or m > 0", "m <= 3 and n <= 4"),
    *("n != 2", "seen or n <= 3", "True", "abs(n) <= 3", "state_time >= 0", "half <= 1.5"),
)
MOST = 400
TICK_NS = 20_000_000


def draw_design(rng: random.Random) -> Design:
    def actions(most: int) -> tuple[Assign, ...]:
        names = [("n", VALUES), ("m", VALUES), ("half", ("n / 2", "m / 4", "0.5"))]
        drawn = (rng.choice(names) for _ in range(rng.randint(0, most)))
        return tuple(Assign(values=((name, rng.choice(values)),)) for name, values in drawn)

    def transitions() -> tuple[Transition, ...]:
        return tuple(
            Transition(to=rng.choice(NAMES), guard=Guard(when=rng.choice(GUARDS))) for _ in range(rng.randint(0, 3))
        )

    return Design(
        component="Drawn",
        parameters=(Declaration(name="seen", type="bool"),),
        variables=(Declaration(name="n", initial="0"), Declaration(name="m", initial="0")),
        outputs=(Declaration(name="half", initial="0.0"),),
        initial="A",
        common=CommonSection(actions=actions(1) if rng.random() < 0.3 else ()),
        states=tuple(
            State(
                name=name,
                enter=actions(1),
                actions=actions(2) if rng.random() < 0.5 else (),
                leave=actions(1) if rng.random() < 0.3 else (),
                transitions=transitions(),
            )
            for name in NAMES
        ),
    )


def find_broken(project: Project) -> set[str] | None:
    """The conditions that are false after some step; None if there are too many values to try them all."""
    robot = Interpreter(project, "Drawn")
    pending, known, broken, ticks = [robot.memory.copy()], set[tuple[object, ...]](), set[str](), 0
    while pending:
        before = pending.pop()
        for seen in (False, True):
            robot.memory = before.copy()
            robot.set_input("Drawn", "seen", seen)
            ticks += 1
            robot.step(ticks * TICK_NS)
            broken |= {each for each in CONDITIONS if not robot.evaluate("Drawn", each, "bool")}
            memory = robot.memory.components["Drawn"]
            here = (memory.state, *(memory.values[name] for name in ("n", "m", "half")))
            if here not in known:
                known.add(here)
                pending.append(robot.memory.copy())
        if len(known) > MOST:
            return None
    return broken


def test_conditions_are_judged_as_all_values_say() -> None:
    verdicts: Counter[tuple[PropertyVerdict, bool]] = Counter()
    for seed in range(int(os.environ.get("VICODE_EXPLORED", "20"))):
        design = draw_design(random.Random(seed))
        project = Project(name="p", designs=(design,))
        broken = find_broken(project)
        analysis = PropertyAnalysis(project, MachineAnalysis(project, design))
        for each in CONDITIONS if broken is not None else ():
            verdict = analysis.judge(InvariantProperty(holds=each)).verdict
            verdicts[verdict, each in (broken or ())] += 1
            if verdict is PropertyVerdict.GUARANTEED:
                assert each not in (broken or ()), (seed, each)
            if verdict is PropertyVerdict.FAILS:
                assert each in (broken or ()), (seed, each)
    # Conditions that only hold because of others are not proved.
    kept = sum(count for (_verdict, is_broken), count in verdicts.items() if not is_broken)
    assert verdicts[PropertyVerdict.GUARANTEED, False] / kept > 0.6, verdicts
    assert verdicts[PropertyVerdict.FAILS, True] / (sum(verdicts.values()) - kept) > 0.6, verdicts


@pytest.mark.parametrize("condition", ["n <= 3", "speed <= 2"])
def test_code_can_set_any_value(condition: str) -> None:
    design = Design(
        component="P",
        variables=(Declaration(name="n", initial="0"),),
        outputs=(Declaration(name="speed", initial="0.0"),),
        initial="A",
        states=(State(name="A", actions=(RunCode(code=Code(texts=(("python", "self.measure()"),))),)),),
    )
    project = Project(name="p", designs=(design,))
    analysis = PropertyAnalysis(project, MachineAnalysis(project, design))
    assert analysis.judge(InvariantProperty(holds=condition)).verdict is PropertyVerdict.UNDECIDED
