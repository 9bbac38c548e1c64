"""The undo history of a design: a tree of entries by all users, in which each user undoes their own edits only."""

from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

from vicode.editor.session import texts
from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.merge import merge_designs

MAX_ENTRIES = 500
_MAX_COALESCE_DEPTH = 12
_COALESCE_TIMEOUT_S = 60.0


class CompoundEdit(Protocol):
    """An edit of several files; each history entry that refers to it is its part in one design.

    Compound edits are compared by value. An entry may leave its design unchanged.
    """

    @property
    def label(self) -> str: ...

    def undo(self, user_id: str) -> str:
        """Undo the edit in all files; returns an error message or an empty string."""
        ...

    def redo(self, user_id: str) -> str:
        """Redo the edit in all files; returns an error message or an empty string."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryEntry:
    """A design and the edit that led to it.

    `undone_id` is the entry that this one reverts while keeping later edits, 0 for none. Consecutive edits with the
    same `coalesce_key` are merged into one entry. `at_s` is in seconds since the epoch.
    """

    id: int = 0
    parent: int = -1
    user_id: str = ""
    label: str
    at_s: float = 0.0
    undone_id: int = 0
    coalesce_key: str = ""
    compound: CompoundEdit | None = None
    design: Design


@dataclass(frozen=True, slots=True, kw_only=True)
class UndoConflict:
    """`blocking_entry` has changed, at `path`, what `entry` had changed, so that `entry` cannot be undone or redone."""

    entry: HistoryEntry
    blocking_entry: HistoryEntry
    path: DesignPath


@dataclass(frozen=True, kw_only=True)
class UndoHistory:
    """All entries by id; the first has id 0. `redo_stacks` holds entry ids by user; the last one is redone next."""

    entries: Mapping[int, HistoryEntry]
    current_id: int = 0
    redo_stacks: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    @staticmethod
    def begin(design: Design, at_s: float = 0.0) -> "UndoHistory":
        """A history that contains only the opened design."""
        return UndoHistory(entries={0: HistoryEntry(label="open", design=design, at_s=at_s)})

    @property
    def current(self) -> HistoryEntry:
        return self.entries[self.current_id]

    @cached_property
    def path(self) -> tuple[HistoryEntry, ...]:
        """The entries from the first to the current one."""
        path = [self.current]
        while path[-1].parent in self.entries:
            path.append(self.entries[path[-1].parent])
        return tuple(reversed(path))

    def append(self, entry: HistoryEntry) -> "UndoHistory":
        """The history after an edit, which is merged into the user's previous one if both coalesce."""
        if entry.design == self.current.design and not (entry.compound or entry.undone_id):
            return self
        coalesced = self._coalesced(entry) if entry.coalesce_key else None
        redo_stacks = {**self.redo_stacks, entry.user_id: self._remaining_redo_ids(entry)}
        return replace(coalesced or self._appended(entry), redo_stacks=redo_stacks)

    def append_branch(self, entry: HistoryEntry) -> "UndoHistory":
        """The history with an additional branch, a design to which users may jump; the current entry stays."""
        appended = self._appended(entry)
        return replace(appended, current_id=self.current_id)

    def moved_to(self, entry_id: int) -> "UndoHistory":
        """The history with another current entry; unchanged if there is none with this id."""
        return replace(self, current_id=entry_id) if entry_id in self.entries else self

    def undo(self, user_id: str, at_s: float = 0.0) -> "UndoHistory | UndoConflict":
        """Undo the user's latest edit: move to its parent, or revert it while keeping the later edits of others."""
        entry = self.next_undo(user_id)
        return self if entry is None else self.undo_entry(entry, user_id, at_s)

    def undo_entry(self, entry: HistoryEntry, user_id: str, at_s: float = 0.0) -> "UndoHistory | UndoConflict":
        """Undo one edit on behalf of a user, who can redo it."""
        redo_stacks = {**self.redo_stacks, user_id: (*self.redo_stacks.get(user_id, ()), entry.id)}
        if entry.id == self.current_id:
            return replace(self, current_id=entry.parent, redo_stacks=redo_stacks)
        parent = self.entries[entry.parent]
        merged = merge_designs(entry.design, self.current.design, parent.design)
        if merged.conflicts:
            return UndoConflict(
                entry=entry, blocking_entry=self._first_conflicting(entry, parent), path=merged.conflicts[0].path
            )
        label = texts.undo_label(entry.label)
        reverted = HistoryEntry(user_id=user_id, label=label, at_s=at_s, undone_id=entry.id, design=merged.design)
        return replace(self._appended(reverted), redo_stacks=redo_stacks)

    def redo(self, user_id: str, at_s: float = 0.0) -> "UndoHistory | UndoConflict":
        """Redo the user's latest undone edit: move to its entry, or merge it with the later edits of others."""
        entry = self.next_redo(user_id)
        if entry is None:
            return self
        stack = self.redo_stacks.get(user_id, ())
        redo_stacks = {**self.redo_stacks, user_id: stack[: stack.index(entry.id)]}
        if entry.parent == self.current_id:
            return replace(self, current_id=entry.id, redo_stacks=redo_stacks)
        parent = self.entries[entry.parent]
        merged = merge_designs(parent.design, self.current.design, entry.design)
        if merged.conflicts:
            return UndoConflict(entry=entry, blocking_entry=self.current, path=merged.conflicts[0].path)
        label = texts.redo_label(entry.label)
        redone = HistoryEntry(user_id=user_id, label=label, at_s=at_s, design=merged.design)
        return replace(self._appended(redone), redo_stacks=redo_stacks)

    @property
    def done_ids(self) -> frozenset[int]:
        """The ids of the entries on the current path that are not undone."""
        return frozenset(entry.id for entry in self.path) - {entry.undone_id for entry in self.path}

    def next_undo(self, user_id: str) -> HistoryEntry | None:
        path = self.path[1:]
        undone = {entry.undone_id for entry in path}
        own = (entry for entry in reversed(path) if entry.user_id == user_id and not entry.undone_id)
        return next((entry for entry in own if entry.id not in undone), None)

    def next_redo(self, user_id: str) -> HistoryEntry | None:
        path = self.path
        undone = {entry.undone_id for entry in path}
        done = {entry.id for entry in path} - undone
        stack = (self.entries.get(id_) for id_ in reversed(self.redo_stacks.get(user_id, ())))
        return next((entry for entry in stack if entry and entry.id not in done and entry.parent in self.entries), None)

    def compound_entries(self) -> tuple[HistoryEntry, ...]:
        """The entries of compound edits on the current path that are not undone."""
        undone = {entry.undone_id for entry in self.path}
        return tuple(entry for entry in self.path if entry.compound and not entry.undone_id and entry.id not in undone)

    def _remaining_redo_ids(self, edit: HistoryEntry) -> tuple[int, ...]:
        """The redo stack of a user after their edit: a new edit clears it, a redone compound edit shortens it."""
        stack = self.redo_stacks.get(edit.user_id, ())
        if edit.undone_id:
            return (*stack, edit.undone_id)
        if edit.compound is None:
            return ()
        entries = ((index, self.entries.get(id_)) for index, id_ in enumerate(stack))
        same = (index for index, entry in entries if entry is not None and entry.compound == edit.compound)
        return stack[: max(same, default=0)]

    def _appended(self, entry: HistoryEntry) -> "UndoHistory":
        id_ = max(self.entries) + 1
        entries = {**self.entries, id_: replace(entry, id=id_, parent=self.current_id)}
        return replace(self, entries=_without_oldest(entries, id_), current_id=id_)

    def _coalesced(self, edit: HistoryEntry) -> "UndoHistory | None":
        """The history with an edit merged into the user's last entry; None if the two do not coalesce.

        Entries that others typed since are based on that entry, so the edit is merged into each of them, too.
        """
        later: list[HistoryEntry] = []
        for last in reversed(self.path[-_MAX_COALESCE_DEPTH:]):
            if last.user_id == edit.user_id:
                break
            later.append(last)
        is_same_field = (last.user_id, last.coalesce_key) == (edit.user_id, edit.coalesce_key)
        is_recent = edit.at_s - last.at_s < _COALESCE_TIMEOUT_S
        has_branch = any(entry.parent == self.current_id for entry in self.entries.values())
        if not is_same_field or not is_recent or has_branch or not all(entry.coalesce_key for entry in later):
            return None
        changed = {}
        for entry in (last, *later[1:]):
            merged = merge_designs(self.current.design, entry.design, edit.design)
            if merged.conflicts:
                return None
            changed[entry.id] = replace(entry, design=merged.design)
        changed[last.id] = replace(changed[last.id], at_s=edit.at_s, label=edit.label)
        changed[self.current_id] = replace(changed.get(self.current_id, self.current), design=edit.design)
        return replace(self, entries={**self.entries, **changed})

    def _first_conflicting(self, entry: HistoryEntry, parent: HistoryEntry) -> HistoryEntry:
        """The first later entry that prevents reverting `entry`."""
        later = [other for other in self.path if other.id > entry.id]

        def touches(other: HistoryEntry) -> bool:
            return bool(merge_designs(entry.design, other.design, parent.design).conflicts)

        return later[min(bisect_left(later, True, key=touches), len(later) - 1)]


def _without_oldest(entries: dict[int, HistoryEntry], newest: int) -> dict[int, HistoryEntry]:
    """Drop the oldest entry if there are too many, preferring those outside the path to the newest."""
    if len(entries) <= MAX_ENTRIES:
        return entries
    path = [newest]
    while entries[path[-1]].parent in entries:
        path.append(entries[path[-1]].parent)
    oldest = min(entries, key=lambda id_: (id_ in path, id_))
    return {id_: entry for id_, entry in entries.items() if id_ != oldest}
