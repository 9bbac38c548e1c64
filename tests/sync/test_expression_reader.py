"""Each Python expression is read as the expression of the design from which it is generated."""

import ast
from typing import Any

import pytest

from vicode.model.design import Code, Declaration, Design, Guard, Use
from vicode.model.project import WORLD, Enumeration, Interface, Project
from vicode.sync.interpret.expression_reader import ExpressionReader, PythonGuard

PROJECT = Project(
    name="p",
    world="w:World",
    constants=(Declaration(name="NEAR", initial="1"), Declaration(name="END_", initial="1")),
    enumerations=(Enumeration(name="Side", elements=(("left", ""), ("right", ""))),),
    components=(
        Interface(
            component="Eyes",
            implementation=WORLD,
            outputs=(Declaration(name="distance"), Declaration(name="width", xabsl_name="ball.width")),
        ),
        Interface(component="Memory", outputs=(Declaration(name="age"),)),
    ),
)
USES = (
    Use(alias="eyes", component="Eyes"),
    Use(alias="memory", component="Memory"),
    Use(alias="walk", component="Walk"),
)
TIMER = "self.root.now_ns - self._entered_ns"


def reader(**changes: Any) -> ExpressionReader:
    return ExpressionReader.of(PROJECT, Design(component="Lamp", initial="A", uses=USES, **changes))


def parsed(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


@pytest.mark.parametrize(
    ("python", "expected"),
    [
        ("self.count + 1", "count + 1"),
        ("self.eyes.bearing", "eyes.bearing"),
        ("self.root.team.size", "team_size"),
        ("self.root.team.name", "root.team.name"),
        ("self.team.size", "team.size"),
        ("self.size", "size"),
        # Components that are done.
        ("self.walk.is_done", "done(walk)"),
        ("self.run.is_done", "run.is_done"),
        ("self.walk.is_late", "walk.is_late"),
        # Outputs of the world.
        ("self.world.distance", "eyes.distance"),
        ("self.world.ball_width", "eyes.width"),
        ("self.world.age", "world.age"),
        ("self.root.distance", "root.distance"),
        ("float(self.world.distance)", "eyes.distance"),
        ("int(self.world.distance)", "eyes.distance"),
        ("Side(self.world.distance)", "eyes.distance"),
        ("bool(self.world.distance)", "eyes.distance"),
        ("Side_(self.world.distance)", "eyes.distance"),
        ("abs(self.world.distance)", "abs(eyes.distance)"),
        ("self.f(self.world.distance)", "f(eyes.distance)"),
        ("int(self.world.distance, 2)", "int(eyes.distance, 2)"),
        ("int(self.world.distance, base=2)", "int(eyes.distance, base=2)"),
        ("int(self.count)", "int(count)"),
        # Declared names that collide in the module.
        ("NEAR", "NEAR"),
        ("NEAR_", "NEAR"),
        ("NEAR__", "NEAR"),
        ("FAR_", "FAR_"),
        ("END_", "END_"),
        ("END__", "END_"),
        ("Side_.left", "Side.left"),
        # Conversions that a design does not name.
        ("float(self.count)", "count"),
        ("arithmetic.limit(self.count)", "count"),
        ("arithmetic.saturate(self.count)", "count"),
        ("float(self.count, 2)", "float(count, 2)"),
        ("float(x=self.count)", "float(x=count)"),
        ("abs(self.count)", "abs(count)"),
        # Operators and functions of the runtime.
        ("arithmetic.divide(self.a, self.b)", "a / b"),
        ("arithmetic.xabsl_divide(self.a, self.b)", "a / b"),
        ("arithmetic.floor_divide(self.a, self.b)", "a // b"),
        ("arithmetic.modulo(self.a, self.b)", "a % b"),
        ("arithmetic.xabsl_remainder(self.a, self.b)", "a % b"),
        ("arithmetic.divide(self.a)", "divide(a)"),
        ("arithmetic.to_int(self.a)", "int(a)"),
        ("arithmetic.round_half_even(self.a)", "round(a)"),
        ("arithmetic.minimum(self.a, self.b)", "minimum(a, b)"),
        ("math.divide(self.a, self.b)", "math.divide(a, b)"),
        # Outputs with parameters.
        ("self._ask(self.eyes.bearing, x=lambda: self.count, y=2)", "eyes.bearing(x=count, y=2)"),
        ("self._ask(self.eyes.bearing)", "eyes.bearing()"),
        ("self._ask(self.a, self.b)", "_ask(a, b)"),
        ("self._call(self.a)", "_call(a)"),
        # Comparisons that expressions do not have.
        ("self.on is True", "on"),
        ("self.on is not (self.world.distance is True)", "on is not eyes.distance"),
        ("self.count in (1, self.limit)", "count == 1 or count == limit"),
    ],
)
def test_an_expression_is_read(python: str, expected: str) -> None:
    assert reader().read(parsed(python)) == expected


@pytest.mark.parametrize(
    ("python", "ms", "s"),
    [
        (f"({TIMER}) / 1000000.0", "state_time", "(root.now_ns - _entered_ns) / 1000000.0"),
        (f"({TIMER}) / 1e6 > 5", "state_time > 5", "(root.now_ns - _entered_ns) / 1000000.0 > 5"),
        ("(self.root.now_ns - self._started_ns) / 1e6", "component_time",
         "(root.now_ns - _started_ns) / 1000000.0"),
        (f"({TIMER}) / 1e9", "(root.now_ns - _entered_ns) / 1000000000.0",
         "(root.now_ns - _entered_ns) / 1000000000.0"),
        ("(self.root.now_ns - self.count) / 1e6", "(root.now_ns - count) / 1000000.0",
         "(root.now_ns - count) / 1000000.0"),
        ("self.state_time", "state_time", "state_time"),
    ],
)  # fmt: skip
def test_the_time_in_milliseconds_is_read(python: str, ms: str, s: str) -> None:
    assert reader(time_unit="ms").read(parsed(python)) == ms
    assert reader().read(parsed(python)) == s


def test_a_converted_tree_shares_nothing_with_the_given_one() -> None:
    node = parsed("self.count + float(self.count)")
    before = ast.dump(node)
    converted = reader().convert(node)
    assert (ast.unparse(converted), ast.dump(node)) == ("count + count", before)
    assert not {id(each) for each in ast.walk(node)} & {id(each) for each in ast.walk(converted) if each._fields}


@pytest.mark.parametrize(
    ("text", "old", "new", "expected"),
    [
        # The text that keeps most comes first, then the form of Python, then comparisons with 0.
        ("x  >  1", "self.x > 1.0", "self.x > 2.0", ["x  >  2", "x > 2.0"]),
        ("x", "self.x", "self.y", ["y", "y != 0"]),
        ("(x)  or z", "self.x or self.z", "self.y or self.z",
         ["(y)  or z", "y or z", "y != 0 or z != 0", "y != 0 or z", "y or z != 0"]),
        ("x  >  1", None, "self.x > 2.0", ["x > 2.0"]),
        ("", None, "not self.x", ["not x", "x == 0"]),
        ("ä > 1", "self.x > 1", "self.x > 2", ["x > 2"]),
    ],
)  # fmt: skip
def test_a_change_has_several_readings(text: str, old: str | None, new: str, expected: list[str]) -> None:
    assert reader().read_change(text, parsed(old) if old is not None else None, parsed(new)) == expected


# Guards


@pytest.mark.parametrize(
    ("test", "after", "when", "has_code"),
    [
        ("self.on", "", "self.on", False),
        ("self.on and self.off", "", "self.on and self.off", False),
        ("self.on or self.off", "", "self.on or self.off", False),
        (f"{TIMER} >= 500000000", "0.5", "", False),
        (f"{TIMER} >= 500000001.0", "0.500000001", "", False),
        (f"{TIMER} >= 1234567890123456", "1234567.89012", "", False),
        (f"{TIMER} >= round(self.delay * 1000000000.0)", "delay", "", False),
        (f"{TIMER} >= round((self.delay + 1) * 1000000000.0)", "delay + 1", "", False),
        (f"{TIMER} >= round(self.delay + 1)", "", f"{TIMER} >= round(self.delay + 1)", False),
        (f"{TIMER} >= self.delay", "", f"{TIMER} >= self.delay", False),
        (f"{TIMER} > 500000000", "", f"{TIMER} > 500000000", False),
        ("self.root.now_ns - self._started_ns >= 5", "", "self.root.now_ns - self._started_ns >= 5", False),
        (f"{TIMER} >= 500000000 and self.on", "0.5", "self.on", False),
        (f"{TIMER} >= 500000000 and self.on and self.off", "0.5", "self.on and self.off", False),
        (f"{TIMER} >= 500000000 or self.on", "", f"{TIMER} >= 500000000 or self.on", False),
        # Only the first test can be the time of the guard.
        (f"self.on and {TIMER} >= 500000000", "", f"self.on and {TIMER} >= 500000000", False),
        (f"{TIMER} >= 5e8 and {TIMER} >= 6e8", "0.5", f"{TIMER} >= 600000000.0", False),
        ("self._when_a_1()", "", "", True),
        (f"{TIMER} >= 500000000 and self.on and self._when_a_1()", "0.5", "self.on", True),
        (f"self._when_a_1() and {TIMER} >= 500000000", "0.5", "", True),
        ("self._when_a_1() and self.on", "", "self.on", True),
        ("self._when_a_1(1)", "", "self._when_a_1(1)", False),
        ("self._when_a_1(x=1)", "", "self._when_a_1(x=1)", False),
        ("self.walk._when_a_1()", "", "self.walk._when_a_1()", False),
        ("walk._when_a_1()", "", "walk._when_a_1()", False),
        ("self.is_near()", "", "self.is_near()", False),
    ],
)
def test_a_test_is_split_into_the_parts_of_a_guard(test: str, after: str, when: str, has_code: bool) -> None:
    found = reader().read_guard(parsed(test))
    read = ast.unparse(found.when) if found.when is not None else None
    assert (found.after, read, found.has_code) == (after, when or None, has_code)


def test_the_time_of_a_guard_has_the_unit_of_the_design() -> None:
    assert reader(time_unit="ms").read_guard(parsed(f"{TIMER} >= 500000000")).after == "500"


@pytest.mark.parametrize("has_code", [False, True])
def test_a_guard_keeps_the_code_that_it_calls(has_code: bool) -> None:
    code = Code(texts=(("python", "return True"),))
    read = PythonGuard(after="2", when=parsed("self.on"), has_code=has_code)
    old = Guard(when="off", after="1", code=code)
    assert read.as_guard(old, "on") == Guard(when="on", after="2", code=code if has_code else None)
