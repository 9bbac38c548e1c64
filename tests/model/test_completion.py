"""Completion proposes all names in scope with their types, and no others."""

from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.designs import designs
from vicode.model.completion import (
    CompletionResult,
    complete_assignments,
    complete_expression,
    complete_python,
)
from vicode.model.design import Declaration, Design, Use
from vicode.model.project import Enumeration, Interface, Project

BALL = Declaration(name="ball_x", type="float", unit="mm", doc="Ahead of the robot.", range=(0, 900))
PROJECT = Project(
    name="P",
    enumerations=(Enumeration(name="Side", elements=(("left", "of the goal"), ("right", ""))),),
    constants=(Declaration(name="reach", initial="250"),),
    components=(
        Interface(component="Perception", doc="Sees.", implementation="a:B", outputs=(BALL,)),
        Interface(component="Head", implementation="a:C", parameters=(Declaration(name="pan", unit="deg"),)),
    ),
)
DESIGN = Design(
    component="Player",
    uses=(Use(alias="perception", component="Perception"), Use(alias="head", component="Head")),
    parameters=(Declaration(name="speed", type="float", unit="mm/s"),),
    variables=(Declaration(name="tries", initial="0", doc="So far."),),
)


def labels(completion: CompletionResult) -> list[str]:
    return [option.label for option in completion.options]


def test_outputs_have_type_unit_and_doc() -> None:
    result = complete_expression(PROJECT, DESIGN, "1 < perception.ba", 17)
    assert result.start == 15
    (option,) = result.options
    assert (option.label, option.detail) == ("ball_x", "float mm output")
    assert option.doc == "Ahead of the robot. (0 to 900)"


def test_an_expression_completes_all_names_in_scope() -> None:
    names = labels(complete_expression(PROJECT, DESIGN, "not ", 4))
    for name in ("speed", "tries", "perception", "reach", "Side", "state_time", "component_time", "done", "abs", "and"):
        assert name in names
    assert labels(complete_expression(PROJECT, DESIGN, "side == Side.", 13)) == ["left", "right"]
    assert labels(complete_expression(PROJECT, DESIGN, "done(", 5)) == ["perception", "head"]
    assert labels(complete_expression(PROJECT, DESIGN, "nobody.", 7)) == []


def test_an_assignment_completes_settable_names_then_expressions() -> None:
    settable = DESIGN.variables
    assert labels(complete_assignments(PROJECT, DESIGN, settable, "tries = 1\ntr", 12)) == ["tries"]
    assert complete_assignments(PROJECT, DESIGN, settable, "tries = 1\ntr", 12).start == 10
    assert "speed" in labels(complete_assignments(PROJECT, DESIGN, settable, "tries = sp", 10))


def test_code_completes_members_of_self() -> None:
    members = labels(complete_python(PROJECT, DESIGN, "self.", 5))
    assert {"speed", "tries", "perception", "head", "state_time", "is_done"} <= set(members)
    assert "pan" in labels(complete_python(PROJECT, DESIGN, "if self.head.p", 14))
    assert labels(complete_python(PROJECT, DESIGN, "Side.", 5)) == ["left", "right"]
    assert "reach" in labels(complete_python(PROJECT, DESIGN, "x = ", 4))


@given(designs, st.text("ab.(=:\n d\u2028é😀", max_size=30), st.integers(0, 40))
def test_no_text_raises(design: Design, text: str, offset: int) -> None:
    at = min(offset, len(text))
    for result in (
        complete_expression(PROJECT, design, text, at),
        complete_python(PROJECT, design, text, at),
        complete_assignments(PROJECT, design, design.variables, text, at),
    ):
        assert 0 <= result.start <= at
