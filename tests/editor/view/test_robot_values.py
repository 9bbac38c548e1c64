"""Values and step times of a robot's components."""

import pytest

from vicode.editor.view.robot_values import RobotComponentRow, component_row, input_row, parse_value


def row(
    *, step_ms: float = 1.0, frequency_hz: float | None = 10, iteration_hz: float = 50.0, age_s: float = 0.0
) -> RobotComponentRow:
    step = {"step_ns": int(step_ms * 1e6), "values": {"light": 2.5, "mood": "Mood.calm"}}
    return component_row(
        "Eye",
        step,
        age_s=age_s,
        frequency_hz=frequency_hz,
        iteration_hz=iteration_hz,
        held={("Eye", "light"): 1.0, ("Lamp", "mood"): 1},
    )


def test_values_are_listed_with_their_age() -> None:
    shown = row(age_s=2.34)
    assert [(each.name, each.text, each.is_held) for each in shown.values] == [
        ("light", "2.5", True),
        ("mood", "Mood.calm", False),
    ]
    assert (shown.timing, shown.age, shown.warning) == ("10 Hz · 1.00 ms", "2.3 s ago", "")
    assert row(frequency_hz=None).timing == "each iteration · 1.00 ms"


def test_a_component_that_misses_its_rate_is_marked() -> None:
    assert row(step_ms=120).warning == "Its step takes 120.0 ms, longer than its period of 100 ms"
    assert row(frequency_hz=100).warning == (
        "It works at 50 Hz at most, as often as the robot iterates, instead of 100 Hz"
    )
    assert row(frequency_hz=52).warning == ""
    assert row(frequency_hz=100, iteration_hz=0.0).warning == ""


@pytest.mark.parametrize(
    ("text", "old", "value"),
    [
        ("true", False, True),
        (" False ", True, False),
        ("1", True, None),
        ("12", 3, 12),
        ("1.5", 3, None),
        ("1e3", 0.5, 1000.0),
        ("far", 0.5, None),
        ("Mood.angry", "Mood.calm", "Mood.angry"),
        ("", "Mood.calm", None),
        ("2", "inf", 2.0),
    ],
)
def test_texts_become_values_of_the_same_type(text: str, old: object, value: object) -> None:
    assert parse_value(text, old) == value
    assert type(parse_value(text, old)) is type(value)


def test_inputs_have_values_without_a_frequency() -> None:
    row = input_row("Floor", {"slope": 2.5})
    assert (row.component, row.timing, row.is_input) == ("Floor", "input", True)
    assert [(each.name, each.text) for each in row.values] == [("slope", "2.5")]
