"""Values of dataclasses and changes of single fields, derived from the types: a new field is covered by itself."""

import types
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from itertools import count
from typing import Any, Union, get_args, get_origin, get_type_hints

Place = tuple[str | int, ...]
NOT_WRITTEN = "origin"
"""The field that marks what is derived, and not in the file."""


def full_value(hint: Any) -> Any:
    """A value in which each field is set, each list has an item of each type, and no class contains itself."""
    return _Builder().build(hint, ())


def iter_changes(value: Any, left_out: frozenset[str] = frozenset()) -> Iterator[tuple[Place, Any]]:
    """The value with one field changed, in each way for each field of each dataclass in it; without some fields."""
    for field in fields(value):
        if not field.init or field.name in (*left_out, NOT_WRITTEN):
            continue
        hint, content = get_type_hints(type(value))[field.name], getattr(value, field.name)
        for other in _others(hint, content):
            yield (field.name,), replace(value, **{field.name: other})
        for place, changed in _changes_inside(content):
            yield (field.name, *place), replace(value, **{field.name: changed})


def _changes_inside(content: Any) -> Iterator[tuple[Place, Any]]:
    if is_dataclass(content):
        yield from iter_changes(content)
    elif isinstance(content, tuple):
        for index, item in enumerate(content):
            for place, changed in _changes_inside(item):
                yield (index, *place), (*content[:index], changed, *content[index + 1 :])


def _others(hint: Any, content: Any) -> Iterator[Any]:
    """Other values of a type."""
    arms = _arms(hint)
    if type(None) in arms and content is not None:
        yield None
    match content:
        case None:
            yield full_value(hint)
        case bool():
            yield not content
        case int() | float():
            yield content + 1
        case str():
            yield f"{content}x"
        case tuple():
            yield from _other_tuples(_real_arm(arms), content)


def _other_tuples(hint: Any, content: tuple[Any, ...]) -> Iterator[tuple[Any, ...]]:
    item = _item_hint(hint)
    if item is not None:
        yield (*content, full_value(item))
        if content:
            yield content[1:]
    for index, each in enumerate(content):
        if not is_dataclass(each):
            others = _others(get_args(hint)[index] if item is None else item, each)
            yield from ((*content[:index], other, *content[index + 1 :]) for other in others)


def _arms(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if get_origin(hint) in (Union, types.UnionType) else (hint,)


def _real_arm(arms: tuple[Any, ...]) -> Any:
    return next(arm for arm in arms if arm is not type(None))


def _item_hint(hint: Any) -> Any:
    """The type of the items of a list; None for a tuple of fixed length."""
    parts = get_args(_real_arm(_arms(hint)))
    return parts[0] if parts[-1] is Ellipsis else None


class _Builder:
    """Builds values; all numbers and texts of one builder differ."""

    def __init__(self) -> None:
        self._numbers = count(1)

    def build(self, hint: Any, owners: tuple[type, ...]) -> Any:
        arm = _real_arm(_arms(hint))
        if is_dataclass(arm):
            return self._build_record(arm, (*owners, arm))  # type: ignore[arg-type]
        if get_origin(arm) is tuple:
            item = _item_hint(arm)
            items = get_args(arm) if item is None else _arms(item)
            return tuple(self.build(each, owners) for each in items if each not in owners)
        return True if arm is bool else f"n{next(self._numbers)}" if arm is str else arm(next(self._numbers))

    def _build_record(self, kind: type, owners: tuple[type, ...]) -> Any:
        hints = get_type_hints(kind)
        names = [field.name for field in fields(kind) if field.init and field.name != NOT_WRITTEN]  # type: ignore[arg-type]
        return kind(**{name: self.build(hints[name], owners) for name in names})
