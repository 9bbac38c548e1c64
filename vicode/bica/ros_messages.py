"""The message types of ROS 2 and their fields, the only module that imports rosbags; also reads recorded bags."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from .errors import NetworkError

INSTALL = "pip install 'vicode-fsm[ros2]' (on a robot without vicode: pip install cyclonedds rosbags)"
TYPES = "VICODE_ROS_TYPES"
"""The variable with folders of other message types: files PACKAGE/msg/NAME.msg."""
MAX_ITEMS = 100_000
"""Messages with longer arrays are ignored."""
_BASE, _NAME, _ARRAY = 1, 2, 3
_SOURCE = re.compile(r"(?:(?P<fold>[a-z]+)\((?P<folded>[\w.]+)\)|(?P<plain>[\w.]+))\Z", re.ASCII)
_FOLDS: dict[str, Callable[[Sequence[Any]], Any]] = {
    "min": min,
    "max": max,
    "mean": lambda items: math.fsum(items) / len(items),
    "count": len,
    "first": lambda items: items[0],
}
FOLDS = tuple(_FOLDS)
FieldType = tuple[int, Any]
"""The type of a field in rosbags: base type, name of a message, array or sequence with the type of the items."""


class FieldError(ValueError):
    """A message type, field or fold that does not exist; `known` are names that do."""

    def __init__(self, message: str, name: str, known: Sequence[str]) -> None:
        super().__init__(message)
        self.name, self.known = name, tuple(known)


@dataclass(frozen=True, slots=True, kw_only=True)
class MessageField:
    """A field, or what a fold makes of an array.

    Attributes:
        path: The names from the message to the field.
        kind: "bool", "int", "float" or "string".
        fold: One of FOLDS; "" for a single value.
    """

    path: tuple[str, ...]
    kind: str
    fold: str = ""

    def read(self, message: Any) -> Any:
        """The value in a message; None if no item of an array is finite, or if the value is no number.

        Raises:
            ValueError: The array is too long.
        """
        value = message
        for name in self.path:
            value = getattr(value, name)
        if not self.fold:
            return None if isinstance(value, float) and not math.isfinite(value) else value
        if len(value) > MAX_ITEMS:
            raise ValueError(f"an array with {len(value)} items; at most {MAX_ITEMS} are read")
        items = [item for item in value if not isinstance(item, float) or math.isfinite(item)]
        return _FOLDS[self.fold](items) if items or self.fold == "count" else None


def find_field(type_: str, source: str) -> MessageField:
    """Find a field such as `pose.position.x` or `min(ranges)` of a message type.

    Raises:
        FieldError: The type has no such field, or the field cannot be folded.
        NetworkError: rosbags is not installed.
    """
    match = _SOURCE.match(source)
    if match is None:
        raise FieldError(f"'{source}' is no field; write a field such as pose.x, or min(ranges)", source, ())
    fold, path = match["fold"] or "", (match["folded"] or match["plain"]).split(".")
    if fold and fold not in FOLDS:
        raise FieldError(f"unknown function '{fold}'", fold, FOLDS)
    found: FieldType = (_NAME, type_)
    for name in path:
        fields = dict(message_fields(found[1])) if found[0] == _NAME else {}
        if name not in fields:
            raise FieldError(f"{type_} has no field '{'.'.join(path)}'", name, tuple(fields))
        found = fields[name]
    is_array = found[0] not in (_BASE, _NAME)
    base = found[1][0] if is_array else found
    if base[0] != _BASE or is_array != bool(fold):
        reason = "an array; use min, max, mean, count or first" if is_array else "a message" if not fold else "no array"
        raise FieldError(f"'{'.'.join(path)}' of {type_} is {reason}", path[-1], ())
    kind = _kind(base[1][0])
    if fold in ("min", "max", "mean") and kind not in ("int", "float"):
        raise FieldError(f"{fold} needs numbers, and '{'.'.join(path)}' of {type_} has items of type {kind}", fold, ())
    return MessageField(path=tuple(path), kind={"count": "int", "mean": "float"}.get(fold, kind), fold=fold)


def message_fields(type_: str) -> tuple[tuple[str, FieldType], ...]:
    """The fields of a message type such as `std_msgs/msg/String`.

    Raises:
        FieldError: There is no such type.
        NetworkError: rosbags is not installed.
    """
    definitions = _load_types().fielddefs
    if type_ not in definitions:
        raise FieldError(f"unknown message type '{type_}'", type_, tuple(definitions))
    return tuple((name, _plain(field)) for name, field in definitions[type_][1])


def is_fixed_array(type_: FieldType) -> bool:
    return type_[0] == _ARRAY


def is_message(type_: FieldType) -> bool:
    return type_[0] == _NAME


def is_base(type_: FieldType) -> bool:
    return type_[0] == _BASE


def read_bag(path: str, topics: Sequence[str]) -> tuple[dict[str, list[tuple[int, str, bytes]]], int]:
    """Read the messages of topics from a bag: a folder, or an .mcap or .db3 file.

    Returns:
        Time since the start in ns, type and content of each message by topic, and the duration in ns.

    Raises:
        NetworkError: The bag cannot be read, or rosbags is not installed.
    """
    _load_types()
    from rosbags.highlevel import AnyReader  # noqa: PLC0415 - optional

    messages: dict[str, list[tuple[int, str, bytes]]] = {topic: [] for topic in topics}
    try:
        with AnyReader([Path(path)], default_typestore=_load_types()) as reader:
            start_ns = reader.start_time
            chosen = [each for each in reader.connections if each.topic in messages]
            for connection, time_ns, content in reader.messages(chosen) if chosen else ():
                messages[connection.topic].append((time_ns - start_ns, connection.msgtype, bytes(content)))
            return messages, reader.duration
    except Exception as error:
        raise NetworkError(f"cannot read the bag {path}: {str(error)[:300]}") from error


@cache
def _load_types() -> Any:
    try:
        from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415 - optional
    except ImportError as error:
        raise NetworkError(f"the message types of ROS 2 need rosbags, which is not installed: {INSTALL}") from error
    store = get_typestore(Stores.ROS2_JAZZY)
    for folder in filter(None, os.environ.get(TYPES, "").split(os.pathsep)):
        store.register(_read_types(Path(folder)))
    return store


def _read_types(folder: Path) -> dict[str, Any]:
    """The message types of the files PACKAGE/msg/NAME.msg in a folder."""
    from rosbags.typesys import get_types_from_msg  # noqa: PLC0415 - optional

    types: dict[str, Any] = {}
    for file in sorted(folder.glob("*/msg/*.msg")):
        try:
            types |= get_types_from_msg(file.read_text("utf-8"), f"{file.parents[1].name}/msg/{file.stem}")
        except Exception as error:
            raise NetworkError(f"cannot read the message type {file}: {str(error)[:300]}") from error
    if not types:
        raise NetworkError(f"{TYPES}={folder}: there is no file PACKAGE/msg/NAME.msg")
    return types


def _plain(field: tuple[Any, Any]) -> FieldType:
    kind, detail = int(field[0]), field[1]
    return (kind, detail) if kind in (_BASE, _NAME) else (kind, (_plain(detail[0]), detail[1]))


def _kind(base: str) -> str:
    return base if base in ("bool", "string") else "float" if base.startswith("float") else "int"
