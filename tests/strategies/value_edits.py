"""Random edits of designs and projects as values: each changes one item in one way."""

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from random import Random
from typing import Any

from vicode.model.design import DecisionGroup

# What identifies an item; a change of it is one of several items.
NAMES = {"name", "alias", "component", "designs", "unreadable", "_interfaces"}


@dataclass(frozen=True)
class ValueEdit:
    """An edited value; `kind` is "change", "insert", "remove", "move", "reverse" or "regroup"."""

    kind: str
    value: Any
    place: tuple[str | int, ...]


def draw_edit(chance: Random, value: Any, other: Any) -> ValueEdit | None:
    """An edit of a value; new content comes from another value. None if the edit changes nothing."""
    places = list(_iter_fields(value, ()))
    new_values: dict[tuple[type, str], list[Any]] = {}
    for owner, name, content, _place in _iter_fields(other, ()):
        new_values.setdefault((type(owner), name), []).append(content)
    owner, name, content, place = chance.choice(places)
    candidates = new_values.get((type(owner), name), [])
    is_list = isinstance(content, tuple) and any(is_dataclass(item) for item in content)
    kind = chance.choice(("insert", "remove", "move", "reverse", "regroup")) if is_list else "change"
    changed = _change(chance, kind, content, candidates)
    if changed is None or changed == content:
        return None
    return ValueEdit(kind, _with(value, place, changed), place)


def _change(chance: Random, kind: str, content: Any, candidates: list[Any]) -> Any:
    match kind:
        case "change":
            return chance.choice(candidates) if candidates else None
        case "insert":
            items = [item for each in candidates for item in each if is_dataclass(item)]
            at = chance.randrange(len(content) + 1)
            return (*content[:at], chance.choice(items), *content[at:]) if items else None
        case "remove":
            at = chance.randrange(len(content))
            return content[:at] + content[at + 1 :]
        case "move":
            items = list(content)
            items.insert(chance.randrange(len(items)), items.pop(chance.randrange(len(items))))
            return tuple(items)
        case "reverse":
            return content[::-1]
    return _move_out_of_group(chance, content)


def _move_out_of_group(chance: Random, content: tuple[Any, ...]) -> tuple[Any, ...] | None:
    groups = [at for at, item in enumerate(content) if isinstance(item, DecisionGroup) and item.then]
    if not groups:
        return None
    at = chance.choice(groups)
    group = content[at]
    index = chance.randrange(len(group.then))
    rest = replace(group, then=group.then[:index] + group.then[index + 1 :])
    items = [*content[:at], rest, *content[at + 1 :]]
    items.insert(chance.choice((at, at + 1)), group.then[index])
    return tuple(items)


def _iter_fields(value: Any, place: tuple[str | int, ...]) -> Iterator[tuple[Any, str, Any, tuple[str | int, ...]]]:
    """All fields of a value and of the values in it: owner, name, content, place."""
    for field in fields(value):
        if field.name in NAMES:
            continue
        content = getattr(value, field.name)
        here = (*place, field.name)
        yield value, field.name, content, here
        if is_dataclass(content):
            yield from _iter_fields(content, here)
        elif isinstance(content, tuple):
            for index, item in enumerate(content):
                if is_dataclass(item):
                    yield from _iter_fields(item, (*here, index))


def _with(value: Any, place: tuple[str | int, ...], content: Any) -> Any:
    if not place:
        return content
    step, *rest = place
    if isinstance(value, tuple):
        assert isinstance(step, int)
        return (*value[:step], _with(value[step], tuple(rest), content), *value[step + 1 :])
    return replace(value, **{str(step): _with(getattr(value, str(step)), tuple(rest), content)})
