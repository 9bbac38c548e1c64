"""Designs that calculate with ints, and inputs around the limits of ints, doubles and 64 bits."""

import random
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from vicode.conformance.inputs import ConformanceRun, RunStep
from vicode.model.design import Assign, Call, CommonSection, Declaration, Design, State, Use
from vicode.model.project import INTERNAL, WORLD, Interface, Project

MOST = 2**53
INTS = (
    0,
    1,
    -1,
    2,
    -3,
    *(sign * value for value in (2**31, MOST - 1, MOST, MOST + 2, 2**62, 2**63) for sign in (1, -1)),
)
FLOATS = (
    *(0.0, -0.0, 0.5, -1.5, 1.0, -1.0, 2.0**31, -(2.0**53), 2.0**53 - 1, 2.0**62, -(2.0**63), 1e300, -1e300),
    *(float("inf"), float("-inf"), float("nan")),
)
_INT_NAMES = ("p", "n", "m", "sensor.a", "sensor.b", "eyes.count", "memory.shared", "helper.total", "big", "team_size")
_FLOAT_NAMES = ("x", "sensor.x", "eyes.y", "0.0", "-0.5", "3.0", "9007199254740993.0", "1e300")
_LITERALS = ("0", "1", "-1", "7", "31", "2147483648", "9007199254740991", "9007199254740992", "-9007199254740992")
_SIGNS = ("<", "<=", ">", ">=", "==", "!=")


INTERFACES = (
    Interface(
        component="Sensor",
        implementation="parts:Sensor",
        outputs=(
            *(Declaration(name=each, type="int") for each in "ab"),
            Declaration(name="x", type="float"),
            Declaration(name="far", type="int", arguments=(Declaration(name="k", type="int", initial="1"),)),
        ),
    ),
    Interface(
        component="Eyes",
        implementation=WORLD,
        outputs=(
            Declaration(name="count", type="int"),
            Declaration(name="y", type="float"),
            Declaration(name="near", type="int", arguments=(Declaration(name="k", type="int", initial="1"),)),
        ),
    ),
    Interface(component="Memory", implementation=INTERNAL, variables=(Declaration(name="shared", type="int"),)),
    Interface(component="Arm", implementation="parts:Arm", parameters=(Declaration(name="turns", type="int"),)),
)


def int_project(name: str, values: Iterable[tuple[str, str, str]]) -> Project:
    """A project whose component Player sets variables in each iteration: names, types and expressions."""
    values = tuple(values)
    helper = Design(
        component="Helper",
        parameters=(Declaration(name="q", type="int", initial="5"),),
        outputs=(Declaration(name="total", type="int"),),
        initial="On",
        states=(State(name="On", actions=(Assign(values=(("total", "total + q"),)),)),),
    )
    player = Design(
        component="Player",
        uses=tuple(
            Use(alias=alias, component=alias.capitalize()) for alias in ("sensor", "eyes", "memory", "helper", "arm")
        ),
        parameters=(Declaration(name="p", type="int", initial="3"),),
        variables=(
            *(Declaration(name=each, type="int", initial="1") for each in ("n", "m")),
            Declaration(name="x", type="float"),
            *(Declaration(name=each, type=type_) for each, type_, _text in values),
        ),
        initial="On",
        states=(State(name="On"),),
        common=CommonSection(actions=tuple(Assign(values=((each, text),)) for each, _type, text in values)),
    )
    return Project(
        name=name,
        languages=("python", "cpp"),
        constants=(Declaration(name="big", type="int", initial="2147483648 * 2147483648"),),
        components=INTERFACES,
        designs=(helper, player),
    )


def random_values(seed: int, count: int) -> list[tuple[str, str, str]]:
    """Draw names, types and expressions of variables."""
    draw = _Drawer(random.Random(seed))
    return [(f"r{number}", *draw.typed()) for number in range(count)]


def random_design(seed: int, count: int) -> Project:
    """A project with random expressions: assigned, passed to other components, and assigned again from themselves."""
    rng = random.Random(seed)
    draw = _Drawer(rng)
    project = int_project(f"ints_{seed}", random_values(seed, count))
    others: list[Assign | Call] = []
    for _number in range(4):
        others += [
            Assign(values=((rng.choice(("n", "m", "memory.shared")), draw.whole(2)),)),
            Call(alias="helper", arguments=(("q", draw.whole(2)),)),
            Call(alias="arm", arguments=(("turns", draw.whole(2)),)),
            Assign(values=(("x", draw.real(2)),)),
        ]
    helper, player = project.designs
    common = CommonSection(actions=(*player.common.actions, *others))
    return replace(project, designs=(helper, replace(player, common=common)))


def random_int_run(project: Project, seed: int, iterations: int) -> ConformanceRun:
    """A run in which inputs change between the chosen values."""
    rng, steps = random.Random(seed), []
    keys = {
        **dict.fromkeys((("", "p"), ("Sensor", "a"), ("Sensor", "b"), ("Eyes", "count")), INTS),
        **dict.fromkeys((("Sensor", "far"), ("Eyes", "near")), INTS),
        **dict.fromkeys((("Sensor", "x"), ("Eyes", "y")), FLOATS),
    }
    for number in range(iterations):
        changed: dict[tuple[str, str], Any] = {
            key: rng.choice(choices) for key, choices in keys.items() if number == 0 or rng.random() < 0.6
        }
        steps.append(RunStep(time_ns=number * 20_000_000, inputs=(changed,)))
    return ConformanceRun(project=project, root="Player", steps=tuple(steps))


@dataclass(frozen=True)
class _Drawer:
    rng: random.Random

    def typed(self) -> tuple[str, str]:
        match self.rng.choice(("int", "int", "int", "float", "bool")):
            case "int":
                return "int", self.whole(3)
            case "float":
                return "float", self.real(3)
            case _:
                return "bool", self.truth(3)

    def pick(self, *choices: str) -> str:
        return self.rng.choice(choices)

    def whole(self, depth: int) -> str:
        if depth <= 0 or self.rng.random() < 0.15:
            return self.pick(*_INT_NAMES, *_LITERALS)
        inner, other, leaf = self.whole(depth - 1), self.whole(depth - 1), self.whole(0)
        return self.pick(
            *(f"({inner} {operator} {other})" for operator in "+-**"),
            *(f"-({inner})", f"abs({inner})", f"sign({inner})"),
            *(f"min({inner}, {other})", f"max({inner}, {leaf}, {other})", f"clamp({inner}, {leaf}, {other})"),
            *(f"{function}({self.number(depth - 1)})" for function in ("int", "floor", "ceil", "round")),
            f"({inner} if {self.truth(depth - 1)} else {other})",
            *(f"sensor.far(k={inner})", f"eyes.near(k={inner})"),
        )

    def number(self, depth: int) -> str:
        return self.whole(depth) if self.rng.random() < 0.5 else self.real(depth)

    def real(self, depth: int) -> str:
        if depth <= 0 or self.rng.random() < 0.15:
            return self.pick(*_FLOAT_NAMES)
        inner, other = self.number(depth - 1), self.number(depth - 1)
        match self.pick("mixed", "part", "part", "float", "min", "choice", "minus", "sqrt"):
            case "mixed":
                return f"({inner} {self.pick(*'+-*')} {self.real(depth - 1)})"
            case "part":
                return f"({inner} {self.pick('/', '//', '%')} {other})"
            case "min":
                return f"{self.pick('min', 'max')}({inner}, {self.real(depth - 1)})"
            case "choice":
                return f"({inner} if {self.truth(depth - 1)} else {self.real(depth - 1)})"
            case "minus":
                return f"-({self.real(depth - 1)})"
            case function:
                return f"{function}({inner})"

    def truth(self, depth: int) -> str:
        sides = [self.number(depth - 1) for _ in range(3)]
        signs = [self.pick(*_SIGNS) for _ in range(2)]
        if self.rng.random() < 0.25:
            return f"({sides[0]} {signs[0]} {sides[1]} {signs[1]} {sides[2]})"
        return f"({sides[0]} {signs[0]} {sides[1]})"


def values_of(run_traces: Iterable[Any]) -> Iterator[dict[str, str]]:
    """The values of Player after each iteration."""
    for iteration in run_traces:
        (step,) = (each for each in iteration.steps if each.component == "Player")
        yield {name.removeprefix("values."): value for name, value in step.fields.items() if name.startswith("values.")}
