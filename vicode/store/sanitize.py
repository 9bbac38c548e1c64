"""Replaces texts that a design file cannot contain; forms and browsers may send such texts."""

import re
from dataclasses import fields, is_dataclass, replace
from typing import Any

from vicode.model.design import Design

_LONE_SURROGATE = re.compile("[\ud800-\udfff]")


def sanitize_design(design: Design) -> Design:
    """Empty all blank texts of a design and replace lone surrogates by U+FFFD."""
    sanitized: Design = _sanitize(design)
    return sanitized


def _sanitize(value: Any) -> Any:
    if isinstance(value, str):
        return _LONE_SURROGATE.sub("\ufffd", value) if value.strip() else ""
    if isinstance(value, tuple):
        return tuple(_sanitize(item) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        return replace(
            value, **{field.name: _sanitize(getattr(value, field.name)) for field in fields(value) if field.init}
        )
    return value
