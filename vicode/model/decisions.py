"""Edits of decision trees."""

from collections.abc import Collection, Mapping
from dataclasses import replace

from vicode.model.design import Decision, DecisionGroup, Transition


def retarget(items: tuple[Decision, ...], old: str, new: str) -> tuple[Decision, ...]:
    """Replace the target `old` by `new` in all transitions."""
    return retarget_all(items, {old: new})


def retarget_all(items: tuple[Decision, ...], new_targets: Mapping[str, str]) -> tuple[Decision, ...]:
    """Replace the targets of all transitions according to a mapping of old to new names."""

    def renamed(item: Decision) -> Decision:
        if isinstance(item, DecisionGroup):
            then, otherwise = retarget_all(item.then, new_targets), retarget_all(item.otherwise, new_targets)
            return replace(item, then=then, otherwise=otherwise)
        if isinstance(item, Transition) and item.to in new_targets:
            return replace(item, to=new_targets[item.to])
        return item

    return tuple(renamed(item) for item in items)


def drop_targets(items: tuple[Decision, ...], targets: Collection[str]) -> tuple[Decision, ...]:
    """Remove the transitions to `targets`, and groups that become empty."""
    kept: list[Decision] = []
    for item in items:
        if isinstance(item, Transition) and item.to in targets:
            continue
        if isinstance(item, DecisionGroup):
            then, otherwise = drop_targets(item.then, targets), drop_targets(item.otherwise, targets)
            if not then and not otherwise:
                continue
            kept.append(replace(item, then=then, otherwise=otherwise))
        else:
            kept.append(item)
    return tuple(kept)
