"""Constants are evaluated at generation time as the generated program evaluates them."""

import pytest

from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import Declaration
from vicode.model.project import Enumeration, Project


@pytest.mark.parametrize(
    ("type_", "text", "value"),
    [
        ("int", "", 0),
        ("bool", "", False),
        ("Side", "", "left"),
        ("Side", "Side.right", "right"),
        ("int", "2 + 3 * 4 - 1", 13),
        ("float", "-near + 7 // 2", 1),
        ("float", "near / 4", 0.5),
        ("float", "1.5 if near > 1 else 2.5", 1.5),
        ("float", "1.5 if near < 1 else 2.5", 2.5),
        ("float", "clamp(9, 0, near) + abs(-1)", 3),
        ("bool", "not near == 2", False),
        ("bool", "1 < near <= 2", True),
        ("bool", "1 < near < 2", False),
        ("bool", "near >= 2 and near != 3", True),
        ("bool", "near >= 2 and near > 2", False),
        ("bool", "near > 2 or near == 2", True),
        ("bool", "near > 2 or near < 2", False),
        ("float", "nowhere + 1", None),
        ("float", "later", None),
        ("int", "true", None),
    ],
)
def test_a_constant_has_the_value_of_its_expression(type_: str, text: str, value: object) -> None:
    constants = (
        Declaration(name="near", type="float", initial="2"),
        Declaration(name="it", type=type_, initial=text),
        Declaration(name="later", type="float", initial="1"),
    )
    sides = Enumeration(name="Side", elements=(("left", ""), ("right", "")))
    values = evaluate_constants(Project(name="Values", constants=constants, enumerations=(sides,)))
    assert values.get("it") == value
    assert type(values.get("it")) is bool or type_ != "bool"
