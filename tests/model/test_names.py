"""Conversion of text to names."""

import pytest

from vicode.model.names import is_valid_name, name_from_text


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("My robot", "MyRobot"),
        ("look-for ball", "LookForBall"),
        ("1st Törhüter", "StTorhuter"),
        ("my_robot 2", "My_robot2"),
        ("世界", ""),
        ("42", ""),
        ("x" * 81, ""),
    ],
)
def test_name_from_text_returns_a_valid_name_or_nothing(text: str, name: str) -> None:
    assert name_from_text(text) == name
    assert not name or is_valid_name(name)
