"""Parses, validates and formats numbers in text fields. Each `validate_` function returns an error message or ""."""

import math

from vicode.editor.session import texts

_MAX_COUNT_LENGTH = 6


def validate_frequency(text: str) -> str:
    if not text.strip():
        return ""
    try:
        value = float(text)
    except ValueError:
        return f"'{text[:20]}' is not a number: enter Hz, such as 10 or 0.5"
    return "" if math.isfinite(value) and value > 0 else texts.FREQUENCY_TOO_LOW


def parse_frequency(text: str) -> float | None:
    """The frequency in Hz in a valid text, None for an empty one."""
    return float(text) if text.strip() else None


def format_number(value: float | None) -> str:
    """The shortest text of a number; integers have no decimal point."""
    if value is None:
        return ""
    return str(int(value)) if value == int(value) else repr(value)


def validate_range(text: str) -> str:
    parts = text.replace("[", " ").replace("]", " ").split(",")
    if not text.strip():
        return ""
    try:
        values = [float(part) for part in parts]
    except ValueError:
        return texts.INVALID_RANGE
    if len(values) != 2 or not all(math.isfinite(value) for value in values):
        return texts.INVALID_RANGE
    return "" if values[0] <= values[1] else texts.RANGE_REVERSED


def parse_range(text: str) -> tuple[float, float] | None:
    """The range in a valid text, None for an empty one."""
    if not text.strip():
        return None
    low, high = text.replace("[", " ").replace("]", " ").split(",")
    return (float(low), float(high))


def format_range(value: tuple[float, float] | None) -> str:
    return "" if value is None else f"{format_number(value[0])}, {format_number(value[1])}"


def validate_count(text: str) -> str:
    number = text.strip()
    is_count = number.isascii() and number.isdecimal() and len(number) <= _MAX_COUNT_LENGTH
    return "" if is_count or not number else texts.INVALID_COUNT


def parse_count(text: str) -> int | None:
    """The number of robots in a valid text, None for an empty one."""
    return int(text) if text.strip() else None
