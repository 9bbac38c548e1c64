"""Lines up three versions of a list: every thing that survives, in an order that keeps what each side moved."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

from vicode.model.merge.matching import item_key, match_items

PathStep = str | int
MergeItem = Callable[[PathStep, Any, Any, Any], Any]
"""What a thing becomes, by its step in the path and its three versions (None: not there); None: it goes."""
ChoosesTheirs = Callable[[], bool]
_Node = tuple[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class ListVersions:
    """One list in three versions; the things in it are keyed by name, or stand in an order with a meaning."""

    base: tuple[Any, ...]
    ours: tuple[Any, ...]
    theirs: tuple[Any, ...]
    is_keyed: bool


def merge_lists(lists: ListVersions, merge: MergeItem, chooses_theirs: ChoosesTheirs) -> list[Any]:
    """The merged list; `chooses_theirs` is asked which order to take where both sides moved things."""
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
        there = next(each for each in sides if each is not None)
        thing = merge(str(item_key(there)) if lists.is_keyed else node[1], *sides)
        if thing is not None:
            merged.append(thing)
    return merged


def _nodes(side: str, things: Sequence[Any], matches: dict[int, int]) -> list[_Node]:
    """Every thing by where it comes from: the base, or this side."""
    origins = {to: at for at, to in matches.items()}
    return [("base", origins[at]) if at in origins else (side, at) for at in range(len(things))]


def _added_by_both(lists: ListVersions, ours: list[_Node], theirs: list[_Node]) -> dict[_Node, _Node]:
    """What both sides added: of the same name, or the same to the letter; from their node to ours."""

    def identity(thing: Any) -> Hashable:
        return item_key(thing) if lists.is_keyed else thing

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
    """All nodes of both sides, and those of the base that both removed left out."""
    shared = set(ours) & set(theirs)
    mine, yours = ([node for node in side if node in shared] for side in (ours, theirs))
    was = sorted(node for node in shared if node[0] == "base")
    has_moved = [node for node in mine if node[0] == "base"] != was
    have_they_moved = [node for node in yours if node[0] == "base"] != was
    is_torn = has_moved and have_they_moved and mine != yours
    takes_theirs = chooses_theirs() if is_torn else not has_moved
    return _interleave(theirs, ours, after_added=False) if takes_theirs else _interleave(ours, theirs, after_added=True)


def _interleave(first: list[_Node], second: list[_Node], *, after_added: bool) -> list[_Node]:
    """The nodes of `second` that `first` lacks, each put behind the one it follows (and what was added there)."""
    order, known = list(first), set(first)
    before: _Node | None = None
    for node in second:
        if node not in known:
            at = order.index(before) + 1 if before is not None else 0
            while after_added and at < len(order) and order[at][0] == "ours":
                at += 1
            order.insert(at, node)
            known.add(node)
        before = node
    return order
