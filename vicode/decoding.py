"""Decodes JSON values and events from the browser into the types of their declaration."""

import math
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints, is_typeddict

_T = TypeVar("_T")


class MalformedEventError(ValueError):
    """An event from the browser does not match its declaration."""


def decode_event(payload: object, kinds: Mapping[str, type[_T]]) -> _T:
    """Decode an event, an object with the field `kind` and the fields of its type.

    Raises:
        MalformedEventError: The kind is unknown, or the fields do not match its declaration.
    """
    if not isinstance(payload, dict):
        raise MalformedEventError("an event must be an object")
    kind = payload.get("kind")
    if not isinstance(kind, str) or kind not in kinds:
        raise MalformedEventError(f"unknown kind of event: {kind!r:.40}")
    return decode({name: value for name, value in payload.items() if name != "kind"}, kinds[kind], kind)


def decode(value: object, expected: type[_T], name: str) -> _T:
    """Decode a value; `expected` is a dataclass, a TypedDict, a tuple, a union, a literal or a JSON type.

    A field of a dataclass may have another name in JSON: `metadata={"json": name}`.

    Args:
        value: the JSON value.
        expected: its declared type.
        name: the name of the value for error messages.

    Raises:
        MalformedEventError: The value has another type; a field is missing or unknown.
    """
    decoded: _T = _decode(value, expected, name)
    return decoded


def _decode(value: Any, expected: Any, name: str) -> Any:
    origin = get_origin(expected)
    if is_dataclass(expected):
        return _decode_dataclass(value, expected, name)
    if is_typeddict(expected):
        hints = _type_hints(expected)
        return _decode_fields(value, hints, set(hints), name)
    if origin is tuple:
        return _decode_tuple(value, get_args(expected), name)
    if origin in (Union, UnionType):
        return _decode_union(value, get_args(expected), name)
    if _is_instance(value, expected, origin):
        return value
    raise MalformedEventError(f"{name}: expected {_type_name(expected)}, got {value!r:.40}")


def _decode_dataclass(value: Any, expected: Any, name: str) -> Any:
    declared = {field.metadata.get("json", field.name): field for field in fields(expected)}
    required = {key for key, field in declared.items() if field.default is MISSING}
    hints = {key: _type_hints(expected)[field.name] for key, field in declared.items()}
    decoded = _decode_fields(value, hints, required, name)
    return expected(**{declared[key].name: item for key, item in decoded.items()})


def _decode_fields(value: Any, hints: dict[str, Any], required: set[str], name: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise MalformedEventError(f"{name}: not an object")
    if unknown := value.keys() - hints.keys():
        raise MalformedEventError(f"{name}: unknown fields {sorted(map(str, unknown))}")
    if missing := required - value.keys():
        raise MalformedEventError(f"{name}: missing fields {sorted(missing)}")
    return {key: _decode(item, hints[key], f"{name}.{key}") for key, item in value.items()}


def _decode_tuple(value: Any, types: tuple[Any, ...], name: str) -> tuple[Any, ...]:
    if not isinstance(value, list):
        raise MalformedEventError(f"{name}: not a list")
    if types[-1] is Ellipsis:
        types = types[:1] * len(value)
    if len(types) != len(value):
        raise MalformedEventError(f"{name}: {len(types)} values expected")
    return tuple(_decode(item, expected, name) for item, expected in zip(value, types, strict=True))


def _decode_union(value: Any, types: tuple[Any, ...], name: str) -> Any:
    if value is None and type(None) in types:
        return None
    (expected,) = (expected for expected in types if expected is not type(None))
    return _decode(value, expected, name)


def _is_instance(value: Any, expected: Any, origin: Any) -> bool:
    if origin is Literal:
        return isinstance(value, str) and value in get_args(expected)
    if expected is float:
        return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    return type(value) is (dict if origin is dict else expected)


@cache
def _type_hints(expected: Any) -> dict[str, Any]:
    return get_type_hints(expected)


def _type_name(expected: Any) -> str:
    if get_origin(expected) is Literal:
        return f"one of {', '.join(get_args(expected))}"
    return "a finite number" if expected is float else str(expected.__name__)
