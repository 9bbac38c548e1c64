"""Expressions that are evaluated with given values agree with the generated Python."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.generators.sound_designs import project_of, truths
from vicode.bica import arithmetic
from vicode.generators.plan import IntRanges
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.pretty_printer import render_doc
from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import Declaration, Design, Use
from vicode.model.expressions import BOOL, Value, build_scope, evaluate, parse_expression

DESIGN = Design(
    component="Tested",
    uses=(Use(alias="eyes", component="Eyes"), Use(alias="legs", component="Legs")),
    parameters=(Declaration(name="side", type="Side"), Declaration(name="k", type="int")),
    variables=(
        *(Declaration(name=name, type="float") for name in ("a", "b")),
        Declaration(name="n", type="int"),
        Declaration(name="seen", type="bool"),
    ),
)
PROJECT = project_of(DESIGN)
SCOPE = build_scope(PROJECT, DESIGN)
CONSTANTS = evaluate_constants(PROJECT)
NAMES = {**{name: name for name in CONSTANTS}, "Side": "Side", "arithmetic": "arithmetic"}

RANGES = IntRanges(external=frozenset({"eyes"}))

floats = st.floats() | st.sampled_from([0.0, -0.0, 1.0, -2.5, math.inf, math.nan])
ints = st.integers(-5, 5) | st.integers(-(2**53), 2**53)
values_of_names = st.fixed_dictionaries(
    {
        **dict.fromkeys(("a", "b", "eyes.distance", "state_time"), floats),
        **dict.fromkeys(("n", "k"), ints),
        "eyes.count": ints | st.integers(-(2**70), 2**70),
        **dict.fromkeys(("seen", "eyes.seen", "done(legs)"), st.booleans()),
        "side": st.sampled_from(["left", "right"]),
    }
)


def run_generated(text: str, values: dict[str, Any]) -> bool:
    tree = parse_expression(text, SCOPE, BOOL).tree
    assert tree is not None
    piece = PythonExpressionPrinter(names=NAMES, ranges=RANGES).to_doc(tree)
    code = "\n".join(render_doc(piece.unbreakable, 0)).strip()
    me = SimpleNamespace(**{name: value for name, value in values.items() if "." not in name and "(" not in name})
    me.eyes = SimpleNamespace(distance=values["eyes.distance"], count=values["eyes.count"], seen=values["eyes.seen"])
    me.legs = SimpleNamespace(is_done=values["done(legs)"])
    side = SimpleNamespace(left="left", right="right")
    return bool(eval(code, {"self": me, "Side": side, "arithmetic": arithmetic, **CONSTANTS}))


def evaluate_text(text: str, values: dict[str, Value]) -> Value | None:
    tree = parse_expression(text, SCOPE, BOOL).tree
    assert tree is not None
    return evaluate(tree, {**CONSTANTS, **values})


@given(truths.filter(lambda text: "bearing_to" not in text), values_of_names)
def test_it_agrees_with_the_generated_code(text: str, values: dict[str, Any]) -> None:
    assume(not parse_expression(text, SCOPE, BOOL).diagnostics)
    assert evaluate_text(text, values) is run_generated(text, values)


@given(truths, values_of_names, st.data())
def test_what_is_known_stays_true_when_more_is_known(text: str, values: dict[str, Any], data: st.DataObject) -> None:
    assume(not parse_expression(text, SCOPE, BOOL).diagnostics)
    kept = data.draw(st.sets(st.sampled_from(sorted(values))))
    some = evaluate_text(text, {name: value for name, value in values.items() if name in kept})
    assert some is None or some == evaluate_text(text, values)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("seen and a > 1", None),
        ("n > 5 and a > 1", False),
        ("n < 5 or a > 1", True),
        ("0 < a < -1", None),
        ("1 < n < a", False),
        ("eyes.bearing_to(x=n) > 1", None),
        ("side == Side.left", True),
        ("conflict", None),
        ("(a if seen else n) > 0", None),
    ],
)
def test_unknown_values(text: str, expected: bool | None) -> None:
    assert evaluate_text(text, {"n": 1, "side": "left"}) is expected
