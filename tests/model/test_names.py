"""Names that are near to what was typed."""

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
def test_the_nearest_name_is_one_or_nothing(text: str, name: str) -> None:
    assert name_from_text(text) == name
    assert not name or is_valid_name(name)
