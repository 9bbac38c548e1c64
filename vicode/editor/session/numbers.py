"""Numbers as a person types them."""

import math


def refuse_frequency(text: str) -> str:
    """Why a text is no frequency, in words; nothing if it is one, or empty."""
    if not text.strip():
        return ""
    try:
        value = float(text)
    except ValueError:
        return f"'{text[:20]}' is no number: write Hz, such as 10 or 0.5"
    return "" if math.isfinite(value) and value > 0 else "a frequency is above 0 Hz"


def frequency_of(text: str) -> float | None:
    """Hz from a text that `refuse_frequency` takes, None for an empty one."""
    return float(text) if text.strip() else None


def text_of(value: float | None) -> str:
    """The shortest text of a number; whole ones without a point."""
    if value is None:
        return ""
    return str(int(value)) if value == int(value) else repr(value)
