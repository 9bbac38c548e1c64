"""Expressions: trees, types and positions of errors."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.model.design import Declaration, Design, Use
from vicode.model.expressions import (
    Comparison,
    Expr,
    FunctionCall,
    Logic,
    Number,
    OutputRef,
    build_scope,
    parse_expression,
    walk,
)
from vicode.model.project import Enumeration, Interface, Project

DESIGN = Design(
    component="Player",
    uses=(Use(alias="perception", component="Perception"), Use(alias="ghost", component="Ghost")),
    parameters=(Declaration(name="side", initial="Side.left"),),
    variables=(
        Declaration(name="tries", initial="0"),
        Declaration(name="speed"),
        Declaration(name="ready", type="bool"),
    ),
)
PROJECT = Project(
    name="test",
    designs=(DESIGN,),
    enumerations=(Enumeration(name="Side", elements=(("left", ""), ("right", ""))),),
    constants=(Declaration(name="kick_range", initial="250"),),
    components=(
        Interface(
            component="Perception",
            outputs=(
                Declaration(name="ball_seen", type="bool"),
                Declaration(name="ball_x"),
                Declaration(name="bearing", arguments=(Declaration(name="x"), Declaration(name="y", initial="0"))),
            ),
        ),
    ),
)
SCOPE = build_scope(PROJECT, DESIGN)


def tree_of(text: str, expected: str | None = None) -> Expr:
    parsed = parse_expression(text, SCOPE, expected)
    assert parsed.diagnostics == ()
    assert parsed.tree is not None
    return parsed.tree


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("1", "int"),
        ("1.5", "float"),
        ("true and not False", "bool"),
        ("tries + 1", "int"),
        ("tries / 2", "float"),
        ("tries // 2", "float"),
        ("tries % 2 == 0", "bool"),
        ("-tries * 2", "int"),
        ("tries + speed", "float"),
        ("Side.left", "Side"),
        ("side == Side.right", "bool"),
        ("ready == True", "bool"),
        ("perception.ball_seen", "bool"),
        ("perception.bearing(1, y=2)", "float"),
        ("perception.bearing(x=3)", "float"),
        ("1 < tries <= kick_range", "bool"),
        ("min(1, 2, tries)", "int"),
        ("max(1, 2.0)", "float"),
        ("floor(speed)", "int"),
        ("clamp(speed, 0, 1)", "float"),
        ("1 if ready else 2.5", "float"),
        ("state_time > 2 and component_time < 10", "bool"),
        ("done(perception)", "bool"),
        ("ghost.anything > 3", "bool"),
        ("(tries\n  > 3)", "bool"),
    ],
)
def test_types(text: str, type_: str) -> None:
    assert tree_of(text).type == type_


@pytest.mark.parametrize(
    ("text", "code", "guilty"),
    [
        ("tries +", "E301", None),
        ("", "E301", None),
        ("tries # three", "E301", "# three"),
        ("a) or (b", "E301", ")"),
        ("tires > 1", "E303", "tires"),
        ("ready and percepton.ball_seen", "E303", "percepton"),
        ("perception.ball_sen", "E303", "perception.ball_sen"),
        ("perception > 1", "E303", "perception"),
        ("Side == side", "E303", "Side"),
        ("side == Side.lefft", "E306", "Side.lefft"),
        ("side == 1", "E304", "side == 1"),
        ("side < Side.right", "E304", "side < Side.right"),
        ("not tries", "E304", "tries"),
        ("ready + 1", "E304", "ready"),
        ("lambda: 1", "E302", "lambda: 1"),
        ("[1, 2]", "E302", "[1, 2]"),
        ("'left'", "E302", "'left'"),
        ("2 ** 3", "E302", "2 ** 3"),
        ("1 + 1e999", "E302", "1e999"),
        ("99999999999999999999", "E302", "99999999999999999999"),
        ("2j", "E302", "2j"),
        ("ready is True", "E302", "ready is True"),
        ("perception.bearing", "E305", "perception.bearing"),
        ("perception.bearing()", "E305", "perception.bearing()"),
        ("perception.bearing(z=1, x=2)", "E305", "1"),
        ("perception.ball_x()", "E305", "perception.ball_x()"),
        ("sqrt(1, 2)", "E305", "sqrt(1, 2)"),
        ("squrt(2)", "E303", "squrt"),
        ("done(tries)", "E303", "tries"),
        ("1 if tries else 2", "E304", "tries"),
        ("ready if ready else 1", "E304", "ready if ready else 1"),
        ("ready\n and tires", "E303", "tires"),
    ],
)
def test_diagnostics_have_exact_spans(text: str, code: str, guilty: str | None) -> None:
    mistakes = parse_expression(text, SCOPE).diagnostics
    assert [mistake.rule.code for mistake in mistakes] == [code]
    start, end = mistakes[0].span
    if guilty is not None:
        assert text[start:end] == guilty
    assert mistakes[0].message


def test_expected_types() -> None:
    assert parse_expression("tries", SCOPE, "float").diagnostics == ()
    (mistake,) = parse_expression("tries", SCOPE, "bool").diagnostics
    assert (mistake.rule.code, mistake.fix) == ("E304", "add a comparison, such as != 0")
    (mistake,) = parse_expression("speed", SCOPE, "int").diagnostics
    assert "round" in mistake.fix


def test_all_diagnostics_are_reported_with_the_nearest_name() -> None:
    mistakes = parse_expression("tires > 1 and perception.ball_sen", SCOPE, "bool").diagnostics
    assert [mistake.fix for mistake in mistakes] == ["did you mean 'tries'?", "did you mean 'ball_seen'?"]


def test_shape_of_trees() -> None:
    tree = tree_of("1 < min(tries, 3) < 4 or perception.ball_seen")
    assert isinstance(tree, Logic)
    comparison, reading = tree.operands
    assert isinstance(comparison, Comparison)
    assert comparison.operators == ("<", "<")
    assert isinstance(comparison.operands[1], FunctionCall)
    assert isinstance(reading, OutputRef)
    assert [node.value for node in walk(tree) if isinstance(node, Number)] == [1, 3, 4]


@pytest.mark.parametrize("text", ["ready or after 2 s", "ready or 500 ms", "after TIMEOUT or ready"])
def test_a_time_in_an_expression_is_explained(text: str) -> None:
    (mistake,) = parse_expression(text, SCOPE).diagnostics
    assert (mistake.rule.code, mistake.fix) == ("E301", "a time belongs to 'after'; it cannot be part of an expression")


@pytest.mark.parametrize(
    "text", ["(" * 300, "-" * 9000 + "1", "1+" * 4000 + "1", "x" * 20_000, "a\0b", "not " * 500 + "ready"]
)
def test_oversized_texts_are_rejected(text: str) -> None:
    assert [mistake.rule.code for mistake in parse_expression(text, SCOPE).diagnostics] == ["E301"]


@given(st.text(max_size=60) | st.text(alphabet="tries perception.ball_x()<>=+-*/%0123456789 \n#'\"\\", max_size=60))
def test_never_raises_and_spans_stay_within_the_text(text: str) -> None:
    parsed = parse_expression(text, SCOPE, "bool")
    assert (parsed.tree is not None) or parsed.diagnostics
    for mistake in parsed.diagnostics:
        assert 0 <= mistake.span[0] <= mistake.span[1] <= max(1, len(text))
