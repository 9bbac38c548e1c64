"""The places in the drawing where two scenes differ."""

from collections.abc import Mapping
from typing import Any

from vicode.editor.view.scene_types import Scene, SceneList
from vicode.model.design import Point

_DRAWN: tuple[SceneList, ...] = ("states", "components", "notes", "transitions")
# What belongs to an item and not to its drawing: findings follow changes anywhere.
_FINDINGS = ("severity", "messages")


def find_changed_places(old: Scene, new: Scene) -> list[Point]:
    """The centers of the nodes and transitions that were added, changed, moved or removed, those that remain first."""
    kept: list[Point] = []
    removed: list[Point] = []
    for name in _DRAWN:
        before, after = _items(old, name), _items(new, name)
        kept += [_center(new, after[key]) for key in after if before.get(key) != after[key]]
        removed += [_center(old, before[key]) for key in before if key not in after]
    return [*kept, *removed]


def _items(scene: Scene, name: SceneList) -> dict[str, dict[str, Any]]:
    return {item["id"]: {key: value for key, value in item.items() if key not in _FINDINGS} for item in scene[name]}


def _center(scene: Scene, item: Mapping[str, Any]) -> Point:
    """The center of a node, or the middle between the ends of a transition."""
    if "x" in item:
        return (item["x"], item["y"])
    nodes = {state["id"]: state for state in scene["states"]}
    ends = [nodes.get(item[end]) or scene["common"] for end in ("source", "target")]
    known = [end for end in ends if end]
    if not known:
        return (0, 0)
    return (sum(end["x"] for end in known) / len(known), sum(end["y"] for end in known) / len(known))
