"""Statements that every language can express, and the reasons why others are not translated."""

import pytest

from vicode.model.design import Declaration, Design, Use
from vicode.model.expressions import build_scope
from vicode.model.portable_code import (
    NotPortable,
    PortableAssign,
    PortableCall,
    PortableIf,
    PortableReturn,
    parse_portable,
)
from vicode.model.project import Enumeration, Interface, Project

EYES = Interface(
    component="Eyes",
    outputs=(
        Declaration(name="seen", type="bool"),
        Declaration(name="bearing", type="float", arguments=(Declaration(name="x", type="float"),)),
    ),
)
DESIGN = Design(
    component="Player",
    uses=(Use(alias="eyes", component="Eyes"),),
    outputs=(Declaration(name="n", initial="0"), Declaration(name="side", type="Side")),
)
PROJECT = Project(
    name="Sample",
    enumerations=(Enumeration(name="Side", elements=(("left", ""), ("right", ""))),),
    constants=(Declaration(name="far", initial="2.5"),),
    components=(EYES,),
    designs=(DESIGN,),
)
SCOPE = build_scope(PROJECT, DESIGN)


def test_statements_become_expressions_of_designs() -> None:
    text = """
# A comment.
if self.eyes.bearing(x=1) > far:
    self.n += 2
    self.eyes.bearing(self.state_time)
elif self.side is Side.left:
    return
"""
    assert parse_portable(text, "action", SCOPE) == (
        PortableIf(
            test="eyes.bearing(x=1) > far",
            then=(PortableAssign(target="n", value="n + 2"), PortableCall(call="eyes.bearing(state_time)")),
            otherwise=(PortableIf(test="side == Side.left", then=(PortableReturn(value=""),), otherwise=()),),
        ),
    )


@pytest.mark.parametrize(
    ("text", "role", "line", "reason"),
    [
        (
            "self.n = 1\nfor i in range(3):\n    pass",
            "action",
            2,
            "'for i in range(3):' is outside the portable subset",
        ),
        ("self.n = self.n / 2", "action", 1, "expected int, found float"),
        ("self._distances = []", "action", 1, "'self._distances' is no variable or output of the design"),
        ("far = 3", "action", 1, "'far' is no variable or output of the design"),
        ("self.n = hidden", "action", 1, "'hidden' is not declared in the design"),
        ("self.n = n", "action", 1, "'n' is not declared in the design"),
        ("self.far", "action", 1, "outside the portable subset"),
        ("self.world.log('x')", "action", 1, "'self.world' is not declared in the design"),
        ("return self.n", "predicate", 1, "bool"),
        ("if self.n:\n    return True", "predicate", 1, "bool"),
        ("return 1 <", "predicate", 1, "it is not valid Python"),
        ("self.eyes.seen = True", "action", 1, "'self.eyes.seen' is no variable or output of the design"),
        ("self.n: int = 1", "action", 1, "outside the portable subset"),
    ],
)
def test_the_reason_names_what_is_not_portable(text: str, role: str, line: int, reason: str) -> None:
    found = parse_portable(text, role, SCOPE)  # type: ignore[arg-type]
    assert isinstance(found, NotPortable)
    assert found.line == line
    assert reason in found.reason
