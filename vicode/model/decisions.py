"""Changes that go through a whole tree of decisions."""

from collections.abc import Collection
from dataclasses import replace

from vicode.model.design import Decision, Group, Transition


def retarget(items: tuple[Decision, ...], old: str, new: str) -> tuple[Decision, ...]:
    """The same decisions, leading to `new` where they led to `old`."""

    def renamed(item: Decision) -> Decision:
        if isinstance(item, Group):
            return replace(item, then=retarget(item.then, old, new), otherwise=retarget(item.otherwise, old, new))
        if isinstance(item, Transition) and item.to == old:
            return replace(item, to=new)
        return item

    return tuple(renamed(item) for item in items)


def drop_targets(items: tuple[Decision, ...], names: Collection[str]) -> tuple[Decision, ...]:
    """The decisions without transitions to `names`; a group that this leaves empty goes too."""
    kept: list[Decision] = []
    for item in items:
        if isinstance(item, Transition) and item.to in names:
            continue
        if isinstance(item, Group):
            then, otherwise = drop_targets(item.then, names), drop_targets(item.otherwise, names)
            if not then and not otherwise:
                continue
            kept.append(replace(item, then=then, otherwise=otherwise))
        else:
            kept.append(item)
    return tuple(kept)
