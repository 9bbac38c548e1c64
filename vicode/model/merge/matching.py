"""Which things of two lists are the same: by name, by id, by what they hold, at last by where they stand."""

from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from dataclasses import fields, replace
from difflib import SequenceMatcher
from typing import Any

from vicode.model.decisions import retarget
from vicode.model.design import Call, Declaration, Design, State, Transition, Use

Matches = dict[int, int]
"""From an index of the older list to one of the newer."""


def match_items(old: Sequence[Any], new: Sequence[Any], *, is_keyed: bool) -> Matches:
    """What of `old` is still in `new`, and where; keyed things are named, others stand in an order with a meaning."""
    if is_keyed:
        matches = _match_by(item_key, old, new)
        return _match_neighbours(old, new, matches, _is_renamed)
    matches = _match_by(_item_id, old, new)
    matches = _match_equal(old, new, matches)
    return _match_neighbours(old, new, matches, _is_similar)


def item_key(thing: Any) -> Hashable:
    """The name under which a thing stands in its list."""
    match thing:
        case State(name=name) | Declaration(name=name):
            return name
        case Use(alias=alias) | Call(alias=alias):
            return alias
        case (name, _text):
            return str(name)
        case _:
            return str(thing)


def find_renamed_states(old: Design, new: Design) -> dict[str, str]:
    """The states that have another name in `new`, by their old one."""
    lost = [state for state in old.states if new.state(state.name) is None]
    found = [state for state in new.states if old.state(state.name) is None]
    renamed: dict[str, str] = {}
    for state in lost:
        same = next((each for each in found if _is_same_state(state, each)), None)
        if same is not None:
            renamed[state.name] = same.name
            found.remove(same)
    return renamed


def find_renamed_uses(old: Design, new: Design) -> dict[str, str]:
    """The used components that have another alias in `new`, by their old one; a component used once is the same."""
    lost = [use for use in old.uses if new.use(use.alias) is None]
    found = [use for use in new.uses if old.use(use.alias) is None]
    is_single = {
        name for name, count in Counter(use.component for use in (*lost, *found)).items() if count == 2 and name
    }
    after = {use.component: use.alias for use in found if use.component in is_single}
    return {use.alias: after[use.component] for use in lost if use.component in after}


def _is_same_state(old: State, new: State) -> bool:
    if new.id and new.id in (old.id, old.name):
        return True
    if replace(new, name=old.name, id=old.id, transitions=retarget(new.transitions, new.name, old.name)) == old:
        return True
    said = [each.name for each in fields(State) if each.name not in ("name", "id", "final", "transitions")]
    shared: int = sum(bool(getattr(old, name)) and getattr(old, name) == getattr(new, name) for name in said)
    arrows = retarget(new.transitions, new.name, old.name)
    shared += bool(arrows) and arrows == old.transitions
    return shared >= 2


def _match_by(key: Callable[[Any], Hashable], old: Sequence[Any], new: Sequence[Any]) -> Matches:
    """Match equal keys, the second of a key with the second; things without a key stay."""
    places = {each: at for at, each in enumerate(_numbered(key, new)) if each is not None}
    numbered = enumerate(_numbered(key, old))
    return {at: places[each] for at, each in numbered if each is not None and each in places}


def _numbered(key: Callable[[Any], Hashable], things: Sequence[Any]) -> list[tuple[Hashable, int] | None]:
    counts: Counter[Hashable] = Counter()
    numbered: list[tuple[Hashable, int] | None] = []
    for thing in things:
        name = key(thing)
        numbered.append((name, counts[name]) if name != "" else None)
        counts[name] += 1
    return numbered


def _item_id(thing: Any) -> Hashable:
    return (type(thing), thing.id) if getattr(thing, "id", "") else ""


def _match_equal(old: Sequence[Any], new: Sequence[Any], matches: Matches) -> Matches:
    """Add what is the same to the letter: first what keeps its order, then what was moved."""
    matched, taken = dict(matches), set(matches.values())
    for block in SequenceMatcher(None, old, new, autojunk=False).get_matching_blocks():
        for step in range(block.size):
            if block.a + step not in matched and block.b + step not in taken:
                matched[block.a + step] = block.b + step
                taken.add(block.b + step)
    for at, thing in enumerate(old):
        where = next((to for to, each in enumerate(new) if to not in taken and each == thing), None)
        if at not in matched and where is not None:
            matched[at] = where
            taken.add(where)
    return matched


def _match_neighbours(
    old: Sequence[Any], new: Sequence[Any], matches: Matches, is_same: Callable[[Any, Any], bool]
) -> Matches:
    """Add what stands after, or before, a thing that is matched, if it may be the same."""
    matched, taken = dict(matches), set(matches.values())

    def take(at: int, to: int) -> None:
        if at not in matched and to not in taken and 0 <= to < len(new) and is_same(old[at], new[to]):
            matched[at] = to
            taken.add(to)

    for at in range(len(old)):
        take(at, matched.get(at - 1, -2) + 1 if at else 0)
    for at in reversed(range(len(old))):
        take(at, matched.get(at + 1, -1) - 1 if at < len(old) - 1 else len(new) - 1)
    return matched


def _is_renamed(old: Any, new: Any) -> bool:
    return isinstance(old, Declaration) and isinstance(new, Declaration) and replace(new, name=old.name) == old


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
