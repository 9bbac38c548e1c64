"""Texts of a design as a file can hold them: what forms and browsers may send is more than that."""

import re
from dataclasses import fields, is_dataclass, replace
from typing import Any

from vicode.model.design import Design

_LONE_SURROGATE = re.compile("[\ud800-\udfff]")


def sanitize_design(design: Design) -> Design:
    """The design with nothing where a text is blank, and a replacement sign for half a character."""
    tidied: Design = _sanitize(design)
    return tidied


def _sanitize(value: Any) -> Any:
    if isinstance(value, str):
        return _LONE_SURROGATE.sub("\ufffd", value) if value.strip() else ""
    if isinstance(value, tuple):
        return tuple(_sanitize(each) for each in value)
    if is_dataclass(value) and not isinstance(value, type):
        return replace(
            value, **{each.name: _sanitize(getattr(value, each.name)) for each in fields(value) if each.init}
        )
    return value
