"""Three-way merge of designs. Renames are applied first, so that both sides use the same names.

Dataclasses are merged field by field and lists item by item, so no key of the format needs code of its own. An item
that one side removed while the other added references to it is found afterwards, as references are spread over the
design: its removal is then contested, and the merge runs again, until no reference is broken. A conflict is a value
with a path, and resolved with our side; merging again with the path in `theirs_at` resolves it with theirs.
"""

from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Call, Declaration, Design, Transition
from vicode.model.edits import rename_state, rename_use
from vicode.model.lowering import lift_design, lower_design
from vicode.model.merge.list_merge import ListVersions, merge_lists
from vicode.model.merge.matching import find_renamed_states, find_renamed_uses, item_key
from vicode.model.merge.text_merge import merge_lines
from vicode.model.project import Project
from vicode.model.traversal import iter_actions, iter_transitions

_POSITIONS = (("at",), ("label_at",))
_ORDERED = {"transitions", "then", "otherwise", "enter", "actions", "leave", "properties", "interrupts"}
# Named items whose order is their priority.
_RANKED = {"layers", "steps"}
# File keys that differ from field names. Empty: the field has no key in the file.
_FILE_KEYS: dict[str, DesignPath] = {
    "guard": (),
    "texts": (),
    "otherwise": ("else",),
    "frequency_hz": ("frequency",),
    "values": ("set",),
}
_VALUE_KEYS: dict[str | int, str] = {"parameters": "default", "arguments": "default", "constants": "value"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """Different changes of one item by both sides. None stands for a missing item."""

    path: DesignPath
    base: object
    ours: object
    theirs: object


@dataclass(frozen=True, slots=True, kw_only=True)
class MergeResult:
    """The merged design. Conflicts are resolved with our side unless theirs was chosen."""

    design: Design
    conflicts: tuple[Conflict, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectMergeResult:
    """The merged declarations of a project; conflicts as in `MergeResult`."""

    project: Project
    conflicts: tuple[Conflict, ...] = ()


def merge_designs(base: Design, ours: Design, theirs: Design, *, theirs_at: Collection[DesignPath] = ()) -> MergeResult:
    """Merge the changes that two sides made to `base`.

    Args:
        base: The common ancestor.
        ours: One side; its order and its changes take precedence.
        theirs: The other side.
        theirs_at: The paths of conflicts, from a previous merge of the same designs, to resolve with their side.
    """
    if theirs in (ours, base):
        return MergeResult(design=ours)
    if ours == base:
        return MergeResult(design=theirs)
    base, ours, theirs = map(lift_design, (base, ours, theirs))
    renaming = _Merger(frozenset(theirs_at))
    base, ours, theirs = _unify_names(renaming, base, ours, theirs)
    contested: frozenset[DesignPath] = frozenset()
    while True:
        merger = _Merger(frozenset(theirs_at), contested)
        design = merger.merge_record((), base, ours, theirs)
        broken = _broken_references(design, base, (ours, theirs)) - contested
        if not broken:
            return MergeResult(design=lower_design(design), conflicts=(*renaming.conflicts, *merger.conflicts))
        contested |= broken


def merge_projects(
    base: Project, ours: Project, theirs: Project, *, theirs_at: Collection[DesignPath] = ()
) -> ProjectMergeResult:
    """Merge the changes that two sides made to project.yaml; see `merge_designs`. The designs are those of our side."""
    merger = _Merger(frozenset(theirs_at))
    project = merger.merge_record((), base, ours, replace(theirs, designs=ours.designs))
    return ProjectMergeResult(project=project, conflicts=tuple(merger.conflicts))


def _unify_names(merger: "_Merger", base: Design, ours: Design, theirs: Design) -> tuple[Design, Design, Design]:
    """Apply the renames of both sides to all three designs."""
    kinds: tuple[tuple[str, Callable[..., dict[str, str]], Callable[..., Design]], ...] = (
        ("states", find_renamed_states, rename_state),
        ("uses", find_renamed_uses, rename_use),
    )
    for section, find, rename in kinds:
        by_us, by_them = find(base, ours), find(base, theirs)
        for old in (*by_us, *(name for name in by_them if name not in by_us)):
            mine, yours = by_us.get(old, old), by_them.get(old, old)
            new = merger.merge_value((section, old, "name"), old, mine, yours)
            pairs = ((base, old), (ours, mine), (theirs, yours))
            # A step or a layer is renamed as the state that it becomes.
            base, ours, theirs = (lift_design(rename(lower_design(side), name, new)) for side, name in pairs)
    return base, ours, theirs


def _broken_references(design: Design, base: Design, sides: tuple[Design, Design]) -> set[DesignPath]:
    """Return states and uses that one side removed although the other side refers to them.

    A dangling reference within the design of one side is a finding, not a conflict.
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
    """Count the references to each state and use, by path."""
    targets = (located.decision.to for located in iter_transitions(design) if isinstance(located.decision, Transition))
    called = (located.action.alias for located in iter_actions(design) if isinstance(located.action, Call))
    required = (alias for state in design.states for alias in state.requires)
    return Counter((*(("states", name) for name in targets), *(("uses", alias) for alias in (*called, *required))))


def _defines(design: Design, path: DesignPath) -> bool:
    section, name = path
    return (design.state if section == "states" else design.use)(str(name)) is not None


class _Merger:
    """Merges values recursively and collects conflicts."""

    def __init__(self, theirs_at: frozenset[DesignPath], contested: frozenset[DesignPath] = frozenset()) -> None:
        """Removing a `contested` item is a conflict even if the other side did not change it."""
        self.theirs_at, self.contested = theirs_at, contested
        self.conflicts: list[Conflict] = []

    def add_conflict(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """Record a conflict and return the chosen side. Positions are no conflict: ours is kept."""
        if path[-1:] in _POSITIONS:
            return ours
        self.conflicts.append(Conflict(path=path, base=base, ours=ours, theirs=theirs))
        return theirs if path in self.theirs_at else ours

    def merge_value(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
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
        """Merge a dataclass field by field."""
        changes: dict[str, Any] = {}
        for field in fields(base):
            if not field.init:
                continue
            values = [getattr(side, field.name) for side in (base, ours, theirs)]
            here = (*path, *_path_step(base, field.name, path))
            if all(_is_list(value) for value in values):
                merged: Any = self.merge_items(here, *values, is_keyed=field.name not in _ORDERED)
            else:
                merged = self.merge_value(here, *values)
            if merged is not values[1]:
                changes[field.name] = merged
        return replace(ours, **changes) if changes else ours

    def merge_items(
        self, path: DesignPath, base: tuple[Any, ...], ours: tuple[Any, ...], theirs: tuple[Any, ...], *, is_keyed: bool
    ) -> tuple[Any, ...]:
        if not self._is_contested(path, base):
            if theirs in (ours, base):
                return ours
            if ours == base:
                return theirs

        def chooses_theirs() -> bool:
            is_ordered = not is_keyed or path[-1] in _RANKED
            return is_ordered and self.add_conflict(path, base, ours, theirs) is theirs

        lists = ListVersions(base=base, ours=ours, theirs=theirs, is_keyed=is_keyed)
        merged = merge_lists(lists, lambda step, *sides: self._merge_item((*path, step), *sides), chooses_theirs)
        return _resolve_duplicates(self, path, lists, merged) if is_keyed else tuple(merged)

    def _is_contested(self, path: DesignPath, base: tuple[Any, ...]) -> bool:
        return any(
            contested[:-1] == path and contested[-1] in {item_key(item) for item in base}
            for contested in self.contested
        )

    def _merge_item(self, path: DesignPath, base: Any, ours: Any, theirs: Any) -> Any:
        """Merge a list item; None stands for a missing item."""
        is_removed = base is not None and (ours is None or theirs is None)
        if is_removed and path in self.contested and not (ours is None and theirs is None):
            return self.add_conflict(path, base, ours, theirs)
        return self.merge_value(path, base, ours, theirs)


def _resolve_duplicates(merger: _Merger, path: DesignPath, lists: ListVersions, merged: list[Any]) -> tuple[Any, ...]:
    """Report a conflict if both sides added different items with the same name."""
    kept: dict[Any, Any] = {}
    duplicate_keys = {item_key(item) for side in (lists.ours, lists.theirs) for item in _duplicates(side)}
    result: list[Any] = []
    for item in merged:
        name = item_key(item)
        if name in kept and name not in duplicate_keys:
            merger.add_conflict((*path, str(name)), None, kept[name], item)
            if (*path, str(name)) in merger.theirs_at:
                result[result.index(kept[name])] = item
            continue
        kept[name] = item
        result.append(item)
    return tuple(result)


def _duplicates(items: tuple[Any, ...]) -> list[Any]:
    names = [item_key(item) for item in items]
    return [item for item, name in zip(items, names, strict=True) if names.count(name) > 1]


def _path_step(record: Any, field: str, path: DesignPath) -> DesignPath:
    if isinstance(record, Declaration) and field == "initial" and path[-2] in _VALUE_KEYS:
        return (_VALUE_KEYS[path[-2]],)
    if isinstance(record, Call) and field == "arguments":
        return () if "modulates" in path else ("with",)
    return _FILE_KEYS.get(field, (field,))


def _is_list(value: Any) -> bool:
    """Return whether a value is a list of items. A point or range is a single value."""
    return isinstance(value, tuple) and not any(isinstance(part, int | float) for part in value)


def _is_pair(item: Any) -> bool:
    """Return whether a value is a pair of name and text: an assignment, an argument, or code in a language."""
    return isinstance(item, tuple) and len(item) == 2 and all(isinstance(part, str) for part in item)
