"""Which ints of a design need a limit: ranges hold in every order of works, and counters need none."""

import random
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from vicode.generators import generate
from vicode.generators.plan import int_growth, plan_project, typed_tree
from vicode.model.design import Assign, Declaration, Design, RunCode, State, Use
from vicode.model.design import Code as DesignCode
from vicode.model.expressions import INT, build_scope
from vicode.model.project import Interface, Project
from vicode.store import open_project

ROOT = Path(__file__).parents[2]
MOST = 2**53
Assignments = Sequence[tuple[str, str]]


def project_of(assignments: Assignments, *, initial: str = "0", code: str = "") -> Project:
    """A project whose component sets n, m and k from each other, a parameter p and an output of Sensor."""
    actions: tuple[Any, ...] = tuple(Assign(values=(each,)) for each in assignments)
    if code:
        actions += (RunCode(code=DesignCode(texts=(("python", code),))),)
    design = Design(
        component="Player",
        uses=(Use(alias="sensor", component="Sensor"),),
        parameters=(Declaration(name="p", type="int"),),
        outputs=(Declaration(name="k", type="int"),),
        variables=(
            *(Declaration(name=name, type="int", initial=initial) for name in "nm"),
            Declaration(name="x", type="float"),
        ),
        initial="On",
        states=(State(name="On", actions=actions),),
    )
    sensor = Interface(component="Sensor", implementation="parts:Sensor", outputs=(Declaration(name="a", type="int"),))
    return Project(name="ranges", languages=("python", "cpp"), components=(sensor,), designs=(design,))


def code_of(project: Project) -> str:
    files = generate(project, languages=("python",))
    return next(file.text for file in files if file.path.endswith("player.py"))


def draw(rng: random.Random, depth: int) -> str:
    if depth == 0 or rng.random() < 0.2:
        return rng.choice(("n", "m", "k", "p", "sensor.a", "0", "1", "5", "100", "4503599627370496"))
    one, other, third = (draw(rng, depth - 1) for _ in range(3))
    return rng.choice(
        (
            *(f"({one} {sign} {other})" for sign in "+-*"),
            *(f"-{one}", f"abs({one})", f"min({one}, {other}, {third})", f"max({one}, {other})"),
            *(f"clamp({one}, {other}, {third})", f"sign({one})", f"({one} if p > 0 else {other})"),
        )
    )


def limited(value: int, least: int, most: int) -> int:
    return max(least, min(value, most))


def calculate(text: str, values: dict[str, int], sensor: int) -> int:
    """Calculate with the integers of Python, without limits: the texts stay below 64 bits, or the test stops there."""

    class Sensor:
        a = sensor

    def clamp(x: int, low: int, high: int) -> int:
        return low if x < low else min(x, high)

    names = {"abs": abs, "min": min, "max": max, "clamp": clamp, "sign": lambda x: (x > 0) - (x < 0)}
    return int(eval(text, {"__builtins__": {}, **names, "sensor": Sensor, **values}))


@pytest.mark.parametrize("seed", range(400))
def test_values_stay_in_their_ranges(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    works = 12
    monkeypatch.setattr(int_growth, "_WORKS", works)
    rng = random.Random(seed)
    assignments = [(rng.choice("nmk"), draw(rng, rng.choice((1, 1, 2, 3)))) for _ in range(rng.choice((1, 2, 3, 5)))]
    project = project_of(assignments, initial=rng.choice(("0", "-7", "9007199254740000")))
    (plan,) = plan_project(project, {"Player"}, {}, frozenset()).components
    scope, ranges = build_scope(project, plan.design), plan.ranges
    values = {"n": int(plan.design.variables[0].initial), "m": int(plan.design.variables[0].initial), "k": 0}
    for _work in range(works):
        values["p"], sensor = (rng.choice((0, 1, -1, 3, MOST, -MOST, rng.randint(-1000, 1000))) for _ in range(2))
        for name, text in rng.sample(assignments, rng.randint(0, len(assignments))):
            exact, tree = calculate(text, values, sensor), typed_tree(text, scope, INT)
            low, high = ranges.of(tree)
            if abs(exact) < 2**62:
                assert low <= exact <= high, text
            if ranges.is_storable(tree):
                assert abs(exact) <= MOST, text
            values[name] = limited(exact, -MOST, MOST)
            low, high = ranges.names[name]
            assert low <= values[name] <= high, f"{name} after {text}"


@pytest.mark.parametrize(
    "assignments",
    [
        [("n", "n + 1")],
        [("n", "n - 1"), ("n", "10"), ("m", "n")],
        [("n", "n + 1"), ("n", "1 + n"), ("m", "m - 100 * sign(n)")],
        [("n", "n + (2 if x > 0 else -3)")],
        [("n", "n + 1 if x > 0 else 0")],
        [("n", "max(n - 1, 0)"), ("n", "min(n + 5, 100)")],
        [("n", "n + sign(p)"), ("k", "abs(n) + 1")],
        [("n", "clamp(p, -5, 5)"), ("m", "m + n")],
        [("n", "p"), ("m", "-p"), ("k", "int(x)")],
        [("n", "clamp(n * 31 + 7, 0, 1000)")],
        [("n", "m + 1"), ("m", "clamp(n, 0, 9)")],
    ],
)
def test_these_need_no_limit(assignments: Assignments) -> None:
    code = code_of(project_of(assignments))
    assert "arithmetic.limit" not in code.replace("self.p = arithmetic.limit(p)", "")
    assert "saturate" not in code


@pytest.mark.parametrize(
    "assignments",
    [
        [("n", "n * 2")],
        [("n", "n * 31 + p")],
        [("n", "n + p")],
        [("n", "m + 1"), ("m", "n + 1")],
        [("n", "p + 1")],
        [("n", "n + 100000")],
        [("n", "sensor.a")],
        [("n", "n + n")],
        [("n", "-n - 1"), ("n", "n * p")],
    ],
)
def test_these_are_limited(assignments: Assignments) -> None:
    assert "self.n = arithmetic.limit(" in code_of(project_of(assignments, initial="1"))


def test_a_counter_near_the_limit_is_limited() -> None:
    assert "self.n += 1" in code_of(project_of([("n", "n + 1")], initial="1000"))
    assert "self.n = arithmetic.limit(self.n + 1)" in code_of(project_of([("n", "n + 1")], initial="9007199254740990"))


@pytest.mark.parametrize(
    ("code", "is_limited"),
    [
        ("self.n = len(self.names)", True),
        ("for self.n in range(3): pass\nself.n += self.p", True),
        ("self.n += 1", False),
        ("if self.n > 3:\n    self.n = 0", False),
        ("print(self.n)", False),
        ("print(self.n)\nself.n = 7", False),
        ("print(self.n)\nself.n += 7", False),
        ("print(self.n)\nself.n *= 7", True),
        ("print(self.n == 3)", False),
    ],
)
def test_code_that_sets_a_counter_to_any_value_limits_it(code: str, is_limited: bool) -> None:
    text = code_of(project_of([("n", "n + 1")], code=code))
    assert ("self.n = arithmetic.limit(self.n + 1)" in text) == is_limited
    assert ("self.n += 1\n" in text.partition("def _do_")[0]) != is_limited


def test_comparisons_with_numbers_inside_the_limits_read_as_they_are_written() -> None:
    code = code_of(project_of([("x", "1.5 if sensor.a > 3 and p * p < 100 and sensor.a + p != 7.5 else 0")]))
    assert "self.sensor.a > 3 and self.p * self.p < 100" in code


def test_shipped_designs_need_no_limit() -> None:
    for folder in ("forward", "rescue", "soccer2d", "blink"):
        project = open_project(ROOT / "designs" / folder).project
        text = "".join(file.text for file in generate(project, languages=("python",)))
        assert "arithmetic.limit" not in text
        assert "arithmetic.saturate" not in text
