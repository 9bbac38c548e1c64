"""Three-way merge of lists that preserves the moves of each side.

A merge by lines sees a moved item as removed and added, and doubles it if the other side changed it. Here, each item is
a node: one of the base, or one that a side added. Both sides are orders of nodes, which are merged into one order; then
the versions of each node are merged. The order is only a conflict if both sides moved items of the base.
"""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

from vicode.model.merge.matching import item_key, match_items

PathStep = str | int
MergeItem = Callable[[PathStep, Any, Any, Any], Any]
"""Merges an item, given its path step and three versions. None stands for a missing item."""
ChoosesTheirs = Callable[[], bool]
_Node = tuple[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class ListVersions:
    """Three versions of a list. Items are identified by name if `is_keyed`, otherwise their order is significant."""

    base: tuple[Any, ...]
    ours: tuple[Any, ...]
    theirs: tuple[Any, ...]
    is_keyed: bool


def merge_lists(lists: ListVersions, merge: MergeItem, chooses_theirs: ChoosesTheirs) -> list[Any]:
    """Merge the lists. `chooses_theirs` selects the order if both sides moved items."""
    in_ours = match_items(lists.base, lists.ours, is_keyed=lists.is_keyed)
    in_theirs = match_items(lists.base, lists.theirs, is_keyed=lists.is_keyed)
    ours = _nodes("ours", lists.ours, in_ours)
    theirs = _nodes("theirs", lists.theirs, in_theirs)
    both = _added_by_both(lists, ours, theirs)
    theirs = [both.get(node, node) for node in theirs]
    added = {ours_node: theirs_node for theirs_node, ours_node in both.items()}

    def versions(node: _Node) -> tuple[Any, Any, Any]:
        side, at = node
        if side == "base":
            mine, yours = in_ours.get(at), in_theirs.get(at)
            return (
                lists.base[at],
                None if mine is None else lists.ours[mine],
                None if yours is None else lists.theirs[yours],
            )
        if side == "theirs":
            return None, None, lists.theirs[at]
        return None, lists.ours[at], lists.theirs[added[node][1]] if node in added else None

    merged: list[Any] = []
    for node in _merge_order(ours, theirs, chooses_theirs):
        sides = versions(node)
        present = next(side for side in sides if side is not None)
        item = merge(str(item_key(present)) if lists.is_keyed else node[1], *sides)
        if item is not None:
            merged.append(item)
    return merged


def _nodes(side: str, items: Sequence[Any], matches: dict[int, int]) -> list[_Node]:
    """Identify each item by its origin: the base or this side."""
    origins = {to: at for at, to in matches.items()}
    return [("base", origins[at]) if at in origins else (side, at) for at in range(len(items))]


def _added_by_both(lists: ListVersions, ours: list[_Node], theirs: list[_Node]) -> dict[_Node, _Node]:
    """Map the items that both sides added, with the same name or equal, from their node to ours."""

    def identity(item: Any) -> Hashable:
        return item_key(item) if lists.is_keyed else item

    free: dict[Hashable, list[_Node]] = {}
    for node in ours:
        if node[0] == "ours":
            free.setdefault(identity(lists.ours[node[1]]), []).append(node)
    both: dict[_Node, _Node] = {}
    for node in theirs:
        same = free.get(identity(lists.theirs[node[1]])) if node[0] == "theirs" else None
        if same:
            both[node] = same.pop(0)
    return both


def _merge_order(ours: list[_Node], theirs: list[_Node], chooses_theirs: ChoosesTheirs) -> list[_Node]:
    """Order the nodes of both sides, without base items that both removed."""
    shared = set(ours) & set(theirs)
    mine, yours = ([node for node in side if node in shared] for side in (ours, theirs))
    was = sorted(node for node in shared if node[0] == "base")
    has_moved = [node for node in mine if node[0] == "base"] != was
    have_they_moved = [node for node in yours if node[0] == "base"] != was
    is_conflict = has_moved and have_they_moved and mine != yours
    takes_theirs = chooses_theirs() if is_conflict else not has_moved
    return _interleave(theirs, ours, after_added=False) if takes_theirs else _interleave(ours, theirs, after_added=True)


def _interleave(first: list[_Node], second: list[_Node], *, after_added: bool) -> list[_Node]:
    """Insert the nodes of `second` that `first` lacks after their predecessors (and items added there)."""
    order, known = list(first), set(first)
    before: _Node | None = None
    for node in second:
        if node not in known:
            at = order.index(before) + 1 if before is not None else 0
            while after_added and at < len(order) and order[at][0] == "ours":
                at += 1
            order.insert(at, node)
        before = node
    return order
