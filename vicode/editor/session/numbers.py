"""Numbers as a person types them."""

import math

INVALID = -1.0


def frequency_of(text: str) -> float | None:
    """Hz from a text, None for an empty one, INVALID for one that is no frequency."""
    if not text.strip():
        return None
    try:
        value = float(text)
    except ValueError:
        return INVALID
    return value if math.isfinite(value) and value > 0 else INVALID


def text_of(value: float | None) -> str:
    """The shortest text of a number; whole ones without a point."""
    if value is None:
        return ""
    return str(int(value)) if value == int(value) else repr(value)
