"""Numbers in text fields: frequencies, ranges and counts."""

import pytest

from vicode.editor.session import texts
from vicode.editor.session.gestures.number_text import (
    format_number,
    format_range,
    parse_count,
    parse_frequency,
    parse_range,
    validate_count,
    validate_frequency,
    validate_range,
)


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", ""),
        ("  ", ""),
        ("0, 9000", ""),
        ("[-1.5, 2]", ""),
        ("5, 5", ""),
        ("5", texts.INVALID_RANGE),
        ("1, 2, 3", texts.INVALID_RANGE),
        ("1,", texts.INVALID_RANGE),
        ("low, high", texts.INVALID_RANGE),
        ("0, inf", texts.INVALID_RANGE),
        ("nan, 1", texts.INVALID_RANGE),
        ("2, 1", texts.RANGE_REVERSED),
    ],
)
def test_a_range_is_two_finite_numbers_in_order(text: str, error: str) -> None:
    assert validate_range(text) == error
    if not error:
        value = parse_range(text)
        assert parse_range(format_range(value)) == value


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", ""),
        ("0.5", ""),
        ("0", texts.FREQUENCY_TOO_LOW),
        ("-1", texts.FREQUENCY_TOO_LOW),
        ("inf", texts.FREQUENCY_TOO_LOW),
        ("1O", "'1O' is not a number: enter Hz, such as 10 or 0.5"),
    ],
)
def test_a_frequency_is_positive_and_finite(text: str, error: str) -> None:
    assert validate_frequency(text) == error
    if not error:
        value = parse_frequency(text)
        assert parse_frequency(format_number(value)) == value


@pytest.mark.parametrize(
    ("text", "is_valid"), [("", True), ("3", True), ("999999", True), ("1000000", False), ("1.5", False), ("-1", False)]
)
def test_a_count_is_a_whole_number(text: str, *, is_valid: bool) -> None:
    assert validate_count(text) == ("" if is_valid else texts.INVALID_COUNT)
    if is_valid:
        assert parse_count(text) == (float(text) if text else None)
