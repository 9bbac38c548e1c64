"""Numbers as a person types them."""

import math

_LONGEST_COUNT = 6


def validate_frequency(text: str) -> str:
    """Why a text is no frequency, in words; nothing if it is one, or empty."""
    if not text.strip():
        return ""
    try:
        value = float(text)
    except ValueError:
        return f"'{text[:20]}' is no number: write Hz, such as 10 or 0.5"
    return "" if math.isfinite(value) and value > 0 else "a frequency is above 0 Hz"


def parse_frequency(text: str) -> float | None:
    """Hz from a text that `validate_frequency` takes, None for an empty one."""
    return float(text) if text.strip() else None


def format_number(value: float | None) -> str:
    """The shortest text of a number; whole ones without a point."""
    if value is None:
        return ""
    return str(int(value)) if value == int(value) else repr(value)


def validate_range(text: str) -> str:
    """Why a text is no range, in words; nothing if it is one, or empty."""
    parts = text.replace("[", " ").replace("]", " ").split(",")
    if not text.strip():
        return ""
    try:
        values = [float(part) for part in parts]
    except ValueError:
        return "write the lowest and the highest value, such as 0, 9000"
    if len(values) != 2 or not all(math.isfinite(value) for value in values):
        return "write the lowest and the highest value, such as 0, 9000"
    return "" if values[0] <= values[1] else "the lowest value comes first"


def parse_range(text: str) -> tuple[float, float] | None:
    """The range in a text that `validate_range` takes, None for an empty one."""
    if not text.strip():
        return None
    low, high = text.replace("[", " ").replace("]", " ").split(",")
    return (float(low), float(high))


def format_range(value: tuple[float, float] | None) -> str:
    """A range as it is typed."""
    return "" if value is None else f"{format_number(value[0])}, {format_number(value[1])}"


def validate_count(text: str) -> str:
    """Why a text is no number of robots, in words; nothing if it is one, or empty."""
    number = text.strip()
    is_count = number.isascii() and number.isdecimal() and len(number) <= _LONGEST_COUNT
    return "" if is_count or not number else "write a whole number of robots, such as 1, or nothing"


def parse_count(text: str) -> float | None:
    """A number of robots from a text that `validate_count` takes, None for an empty one."""
    return float(text) if text.strip() else None
