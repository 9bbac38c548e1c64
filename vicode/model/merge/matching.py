"""Matching of list items between versions: by name, id, content, and finally position."""

from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

from vicode.matching import Match, match_equal
from vicode.model.decisions import retarget
from vicode.model.design import Call, Design, State, Transition

Matches = dict[int, int]
"""Maps indices of the old list to indices of the new list."""


def match_items(old: Sequence[Any], new: Sequence[Any], *, is_keyed: bool) -> Matches:
    """Match items of `old` with items of `new`, by name if `is_keyed`."""
    if is_keyed:
        matches = _match_by(item_key, old, new)
        return _match_neighbors(old, new, matches, _is_renamed)
    matches = _match_by(_item_id, old, new)
    matches = _match_equal(old, new, matches)
    return _match_neighbors(old, new, matches, _is_similar)


def item_key(item: Any) -> Hashable:
    """Return the name that identifies an item in a keyed list."""
    if is_dataclass(item):
        names = (getattr(item, key, None) for key in ("name", "alias", "component", "do"))
        return next((name for name in names if name is not None), str(item))
    return str(item[0]) if isinstance(item, tuple) and len(item) == 2 else str(item)


def find_renamed_states(old: Design, new: Design) -> dict[str, str]:
    """Map the old names of renamed states, steps and layers to the new ones."""
    renamed: dict[str, str] = {}
    for before, after in zip(_iter_stateful(old), _iter_stateful(new), strict=True):
        olds, news = ({each.name for each in side} for side in (before, after))
        added = [each for each in after if each.name not in olds]
        for item in (each for each in before if each.name not in news):
            same = next((candidate for candidate in added if _is_same_state(item, candidate)), None)
            if same is not None:
                renamed[item.name] = same.name
                added.remove(same)
    return renamed


def _iter_stateful(design: Design) -> Iterator[tuple[Any, ...]]:
    """The lists whose items are states, or become states."""
    yield from (design.states, design.layers, design.competence.steps if design.competence else ())


def find_renamed_uses(old: Design, new: Design) -> dict[str, str]:
    """Map the old aliases of renamed uses to the new ones. Only components that are used once are matched."""
    removed = [use for use in old.uses if new.use(use.alias) is None]
    added = [use for use in new.uses if old.use(use.alias) is None]
    is_single = {
        name for name, count in Counter(use.component for use in (*removed, *added)).items() if count == 2 and name
    }
    after = {use.component: use.alias for use in added if use.component in is_single}
    return {use.alias: after[use.component] for use in removed if use.component in after}


def _is_same_state(old: Any, new: Any) -> bool:
    """Whether a state, step or layer has the id of another, or mostly its content."""
    if isinstance(new, State):
        if new.id and new.id in (old.id, old.name):
            return True
        if old.origin and new.origin:
            # All transitions of a derived state name its construct.
            kept = ("doc", "requires", "modulates")
            return old.origin[:-1] == new.origin[:-1] and all(getattr(old, key) == getattr(new, key) for key in kept)
        new = replace(new, id=old.id, transitions=retarget(new.transitions, new.name, old.name))
    if replace(new, name=old.name) == old:
        return True
    compared = {field.name for field in fields(old)} - {"id", "color", "final"}
    shared: int = sum(bool(getattr(old, name)) and getattr(old, name) == getattr(new, name) for name in compared)
    return shared >= 2


def _match_by(key: Callable[[Any], Hashable], old: Sequence[Any], new: Sequence[Any]) -> Matches:
    """Match the n-th items with equal keys. Items with an empty key are not matched."""
    new_indices = {entry: index for index, entry in enumerate(_numbered(key, new)) if entry is not None}
    numbered = enumerate(_numbered(key, old))
    return {index: new_indices[entry] for index, entry in numbered if entry is not None and entry in new_indices}


def _numbered(key: Callable[[Any], Hashable], items: Sequence[Any]) -> list[tuple[Hashable, int] | None]:
    counts: Counter[Hashable] = Counter()
    numbered: list[tuple[Hashable, int] | None] = []
    for item in items:
        name = key(item)
        numbered.append((name, counts[name]) if name != "" else None)
        counts[name] += 1
    return numbered


def _item_id(item: Any) -> Hashable:
    return (type(item), item.id) if getattr(item, "id", "") else ""


def _match_equal(old: Sequence[Any], new: Sequence[Any], matches: Matches) -> Matches:
    by_new: list[Match] = [None] * len(new)
    for index, to in matches.items():
        by_new[to] = index
    match_equal(old, new, by_new)
    return {index: to for to, index in enumerate(by_new) if index is not None}


def _match_neighbors(
    old: Sequence[Any], new: Sequence[Any], matches: Matches, is_same: Callable[[Any, Any], bool]
) -> Matches:
    """Match similar items whose previous or next item is matched."""
    matched, taken = dict(matches), set(matches.values())

    def match(index: int, to: int) -> None:
        if index not in matched and to not in taken and 0 <= to < len(new) and is_same(old[index], new[to]):
            matched[index] = to
            taken.add(to)

    for index in range(len(old)):
        match(index, matched.get(index - 1, -2) + 1 if index else 0)
    for index in reversed(range(len(old))):
        match(index, matched.get(index + 1, -1) - 1 if index < len(old) - 1 else len(new) - 1)
    return matched


def _is_renamed(old: Any, new: Any) -> bool:
    is_named = hasattr(old, "name") and type(old) is type(new) and not isinstance(old, State)
    return is_named and bool(replace(new, name=old.name) == old)


def _is_similar(old: Any, new: Any) -> bool:
    if type(old) is not type(new):
        return False
    match old:
        case Transition(to=to, guard=guard):
            return bool(new.to == to) or (not guard.is_empty and bool(new.guard == guard))
        case Call(alias=alias):
            return bool(new.alias == alias)
        case _:
            return True
