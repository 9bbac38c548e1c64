"""Merges designs field by field and thing by thing; renames first, so that they meet the other side's edits."""

from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Call, Declaration, Design, Transition
from vicode.model.edits import rename_state, rename_use
from vicode.model.merge.list_merge import ListVersions, merge_lists
from vicode.model.merge.matching import find_renamed_states, find_renamed_uses, item_key
from vicode.model.merge.text_merge import merge_lines
from vicode.model.traversal import iter_actions, iter_transitions

_ORDERED = {"transitions", "then", "otherwise", "enter", "actions", "leave"}
# The words of the file, where they are not those of the model; none for what the file has no word for.
_FILE_KEYS: dict[str, DesignPath] = {
    "guard": (),
    "texts": (),
    "otherwise": ("else",),
    "frequency_hz": ("frequency",),
    "values": ("set",),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """Both sides changed one thing, differently; None stands for a thing that is not there."""

    path: DesignPath
    base: object
    ours: object
    theirs: object


@dataclass(frozen=True, slots=True, kw_only=True)
class MergeResult:
    """The design with the changes of both sides; at each conflict it holds ours, unless theirs was chosen."""

    design: Design
    conflicts: tuple[Conflict, ...] = ()


def merge_designs(base: Design, ours: Design, theirs: Design, *, theirs_at: Collection[DesignPath] = ()) -> MergeResult:
    """Bring together what two sides made of `base`.

    Args:
        base: What both began with.
        ours: One side; its order and its choice go first.
        theirs: The other side.
        theirs_at: The paths of conflicts (as an earlier merge of the same three named them) in which theirs is taken.
    """
    if theirs in (ours, base):
        return MergeResult(design=ours)
    if ours == base:
        return MergeResult(design=theirs)
    renaming = _Merger(frozenset(theirs_at))
    base, ours, theirs = _unify_names(renaming, base, ours, theirs)
    contested: frozenset[DesignPath] = frozenset()
    while True:
        merger = _Merger(frozenset(theirs_at), contested)
        design = merger.merge_record((), base, ours, theirs)
        torn = _torn_references(design, base, (ours, theirs)) - contested
        if not torn:
            return MergeResult(design=design, conflicts=(*renaming.conflicts, *merger.conflicts))
        contested |= torn


def _unify_names(merger: "_Merger", base: Design, ours: Design, theirs: Design) -> tuple[Design, Design, Design]:
    """Base and both sides with all renames done everywhere."""
    kinds: tuple[tuple[str, Callable[..., dict[str, str]], Callable[..., Design]], ...] = (
        ("states", find_renamed_states, rename_state),
        ("uses", find_renamed_uses, rename_use),
    )
    for section, find, rename in kinds:
        by_us, by_them = find(base, ours), find(base, theirs)
        for old in (*by_us, *(name for name in by_them if name not in by_us)):
            mine, yours = by_us.get(old, old), by_them.get(old, old)
            new = merger.merge_value((section, old, "name"), old, mine, yours)
            base, ours, theirs = rename(base, old, new), rename(ours, mine, new), rename(theirs, yours, new)
    return base, ours, theirs


def _torn_references(design: Design, base: Design, sides: tuple[Design, Design]) -> set[DesignPath]:
    """States and uses that one side removed although the other side refers to them.

    A reference that dangles within one side's own design is a finding there, not a conflict between the two.
    """
    counts = _count_references(design)
    side_counts = [(side, _count_references(side)) for side in sides]
    return {
        path
        for path, count in counts.items()
        if _defines(base, path)
        and not _defines(design, path)
        and all(count > there[path] for side, there in side_counts if not _defines(side, path))
    }


def _count_references(design: Design) -> Counter[DesignPath]:
    """How often each state is a target and each use is called or required, by its path."""
    targets = (at.decision.to for at in iter_transitions(design) if isinstance(at.decision, Transition))
    called = (each.action.alias for each in iter_actions(design) if isinstance(each.action, Call))
    required = (alias for state in design.states for alias in state.requires)
    return Counter((*(("states", name) for name in targets), *(("uses", alias) for alias in (*called, *required))))


def _defines(design: Design, path: DesignPath) -> bool:
    section, name = path
    return (design.state if section == "states" else design.use)(str(name)) is not None


class _Merger:
    """Walks three values at once and collects what both sides touched."""

    def __init__(self, theirs_at: frozenset[DesignPath], contested: frozenset[DesignPath] = frozenset()) -> None:
        """Take theirs at some paths; removing what is `contested` is a conflict, though the other side kept it."""
        self.theirs_at, self.contested = theirs_at, contested
        self.conflicts: list[Conflict] = []

    def add_conflict(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """Note a conflict; returns the side that is taken."""
        self.conflicts.append(Conflict(path=path, base=base, ours=ours, theirs=theirs))
        return theirs if path in self.theirs_at else ours

    def merge_value(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """One value of the three."""
        if theirs in (ours, base):
            return ours
        if ours == base:
            return theirs
        if type(base) is type(ours) is type(theirs):
            if is_dataclass(base):
                return self.merge_record(path, base, ours, theirs)
            if _is_pair(base):
                return (base[0], self.merge_value(path, base[1], ours[1], theirs[1]))
            lines = merge_lines(base, ours, theirs) if isinstance(base, str) else None
            if lines is not None:
                return lines
        return self.add_conflict(path, base, ours, theirs)

    def merge_record(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """One record of the three, field by field."""
        changes: dict[str, Any] = {}
        for each in fields(base):
            values = [getattr(side, each.name) for side in (base, ours, theirs)]
            here = (*path, *_path_step(base, each.name, path))
            if all(_is_list(value) for value in values):
                merged: Any = self.merge_items(here, *values, is_keyed=each.name not in _ORDERED)
            else:
                merged = self.merge_value(here, *values)
            if merged is not values[1]:
                changes[each.name] = merged
        return replace(ours, **changes) if changes else ours

    def merge_items(
        self, path: DesignPath, base: tuple[Any, ...], ours: tuple[Any, ...], theirs: tuple[Any, ...], *, is_keyed: bool
    ) -> tuple[Any, ...]:
        """One list of the three."""
        if not self._is_contested(path, base):
            if theirs in (ours, base):
                return ours
            if ours == base:
                return theirs

        def chooses_theirs() -> bool:
            return not is_keyed and self.add_conflict(path, base, ours, theirs) is theirs

        lists = ListVersions(base=base, ours=ours, theirs=theirs, is_keyed=is_keyed)
        merged = merge_lists(lists, lambda step, *sides: self._merge_item((*path, step), *sides), chooses_theirs)
        return _resolve_duplicates(self, path, lists, merged) if is_keyed else tuple(merged)

    def _is_contested(self, path: DesignPath, base: tuple[Any, ...]) -> bool:
        return any(each[:-1] == path and each[-1] in {item_key(thing) for thing in base} for each in self.contested)

    def _merge_item(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """One thing of a list, None where it is not (any more)."""
        is_removed = base is not None and (ours is None or theirs is None)
        if is_removed and path in self.contested and not (ours is None and theirs is None):
            return self.add_conflict(path, base, ours, theirs)
        return self.merge_value(path, base, ours, theirs)


def _resolve_duplicates(merger: _Merger, path: DesignPath, lists: ListVersions, merged: list[Any]) -> tuple[Any, ...]:
    """A name that both sides gave to different things stays with ours; the other is told."""
    kept: dict[Any, Any] = {}
    doubles = {item_key(thing) for side in (lists.ours, lists.theirs) for thing in _duplicates(side)}
    result: list[Any] = []
    for thing in merged:
        name = item_key(thing)
        if name in kept and name not in doubles:
            merger.add_conflict((*path, str(name)), None, kept[name], thing)
            if (*path, str(name)) in merger.theirs_at:
                result[result.index(kept[name])] = thing
            continue
        kept[name] = thing
        result.append(thing)
    return tuple(result)


def _duplicates(things: tuple[Any, ...]) -> list[Any]:
    names = [item_key(thing) for thing in things]
    return [thing for thing, name in zip(things, names, strict=True) if names.count(name) > 1]


def _path_step(record: Any, field: str, path: DesignPath) -> DesignPath:
    if isinstance(record, Declaration) and field == "initial" and path[0] == "parameters":
        return ("default",)
    if isinstance(record, Call) and field == "arguments":
        return () if "modulates" in path else ("with",)
    return _FILE_KEYS.get(field, (field,))


def _is_list(value: Any) -> bool:
    """Whether a value holds things; a point or a range is one value made of numbers."""
    return isinstance(value, tuple) and not any(isinstance(part, int | float) for part in value)


def _is_pair(thing: Any) -> bool:
    """A name with its text: an assignment, an argument, a code in its language."""
    return isinstance(thing, tuple) and len(thing) == 2 and all(isinstance(part, str) for part in thing)
