"""Decodes messages of other robots: JSON that is checked against the values that are known here."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from enum import Enum
from typing import Any

from .observer import to_json_value

_MAX_ITEMS = 1024
_MAX_INT = 2**53
"""Integers of designs are exact up to this (docs/semantics.md)."""

# `dumps` makes an encoder for each call.
_encode_json = json.JSONEncoder(separators=(",", ":")).encode


def encode(message: Mapping[str, Any]) -> bytes:
    return _encode_json(to_json_value(message)).encode()


def decode(payload: bytes) -> dict[str, Any]:
    """Decode a JSON object.

    Raises:
        ValueError: It is none.
    """
    try:
        message = json.loads(payload)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    if not isinstance(message, dict):
        raise ValueError("no object")  # noqa: TRY004 - of a text, its value is wrong
    return message


def convert(value: object, like: object) -> Any:
    """Convert a value of JSON to the type of another value.

    Raises:
        ValueError: It has another type.
    """
    if type(value) is type(like) and type(like) in (float, bool, str):
        return value
    for kind, converter in _CONVERTERS.items():
        if isinstance(like, kind):
            return converter(value, like)
    raise ValueError(f"{_shorten(value)} is no {type(like).__name__}")


def convert_parameters(given: object, modulate: Callable[..., None]) -> dict[str, Any]:
    """Convert parameters to the types that `modulate` declares, by its annotations or else by its default values.

    Raises:
        ValueError: A parameter is unknown or has another type.
    """
    if not isinstance(given, dict):
        raise ValueError("no parameters")  # noqa: TRY004 - of a message, its value is wrong
    defaults = getattr(modulate, "__kwdefaults__", None) or {}
    annotations = getattr(modulate, "__annotations__", {})
    converted = {}
    for name, value in given.items():
        if name not in defaults:
            raise ValueError(f"unknown parameter '{_shorten(name)}'")
        is_float = annotations.get(name) in (float, "float") and isinstance(defaults[name], int)
        try:
            converted[name] = convert(value, float(defaults[name]) if is_float else defaults[name])
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
    return converted


def _to_element(value: object, like: Enum) -> Enum:
    name, _dot, element = str(value).partition(".")
    if name == type(like).__name__ and element in type(like).__members__:
        return type(like)[element]
    raise ValueError(f"{_shorten(value)} is no {type(like).__name__}")


def _to_bool(value: object, _like: object) -> bool:
    if isinstance(value, bool):
        return value
    raise ValueError(f"{_shorten(value)} is no bool")


def _to_int(value: object, _like: object) -> int:
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) <= _MAX_INT:
        return value
    raise ValueError(f"{_shorten(value)} is no int")


def _to_float(value: object, _like: object = 0.0) -> float:
    if isinstance(value, str) and value in ("inf", "-inf", "nan"):
        return float(value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        with suppress(OverflowError):
            return float(value)
    raise ValueError(f"{_shorten(value)} is no float")


def _to_text(value: object, _like: object) -> str:
    if isinstance(value, str):
        return value
    raise ValueError(f"{_shorten(value)} is no text")


def _to_sequence(value: object, like: list[object] | tuple[object, ...]) -> list[object] | tuple[object, ...]:
    """Convert numbers, texts and truth values; other items have no type to be checked against."""
    if not isinstance(value, list) or len(value) > _MAX_ITEMS:
        raise ValueError(f"{_shorten(value)} is no list")
    return type(like)(item if isinstance(item, bool | str) else _to_float(item) for item in value)


# A bool is an int, and an element of an IntEnum, too.
_CONVERTERS: dict[type | tuple[type, ...], Callable[[object, Any], Any]] = {
    Enum: _to_element,
    bool: _to_bool,
    int: _to_int,
    float: _to_float,
    str: _to_text,
    (list, tuple): _to_sequence,
}


def _shorten(value: object) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= 40 else f"{text[:40]}…"
