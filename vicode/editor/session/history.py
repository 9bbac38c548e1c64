"""Where a design has been: a tree of steps, each with who made it; undo takes back a person's own steps only."""

from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.merge import merge_designs

MAX_ENTRIES = 500
_MAX_COALESCE_DEPTH = 12
_COALESCE_TIMEOUT_S = 60.0


class CompoundEdit(Protocol):
    """An edit of other files, too, or of others alone; a step that has one is its part in one design.

    Equal ones are the same. The design of the step may be that of the step before.
    """

    @property
    def label(self) -> str:
        """What the histories call it."""
        ...

    def undo(self, person: str) -> str:
        """Take it back in all files; returns why not."""
        ...

    def redo(self, person: str) -> str:
        """Do it again in all files; returns why not."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryEntry:
    """A design with the edit that made it.

    `undone_id` is the step whose change it takes out although others worked since, 0 for none; `coalesce_key` the field
    it was typed into; `at_s` the time of day, in seconds since 1970; `compound` the edit of several files it is part of.
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
    """Why a step cannot be taken back: `by` changed, at `path`, what `entry` had done."""

    entry: HistoryEntry
    blocking_entry: HistoryEntry
    path: DesignPath


@dataclass(frozen=True, kw_only=True)
class UndoHistory:
    """All steps by id, and the one the design is `at`. `redo_stacks` holds what each person may do again, newest last.

    The first step has id 0.
    """

    entries: Mapping[int, HistoryEntry]
    current_id: int = 0
    redo_stacks: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    @staticmethod
    def begin(design: Design, at_s: float = 0.0) -> "UndoHistory":
        """A history with nothing but a start."""
        return UndoHistory(entries={0: HistoryEntry(label="open", design=design, at_s=at_s)})

    @property
    def current(self) -> HistoryEntry:
        """The step that holds the design as it is now."""
        return self.entries[self.current_id]

    @cached_property
    def path(self) -> tuple[HistoryEntry, ...]:
        """The steps from the start to now."""
        path = [self.current]
        while path[-1].parent in self.entries:
            path.append(self.entries[path[-1].parent])
        return tuple(reversed(path))

    def append(self, step: HistoryEntry) -> "UndoHistory":
        """The history after an edit; what is typed into one field goes on as one step."""
        if step.design == self.current.design and not (step.compound or step.undone_id):
            return self
        going_on = self._coalesced(step) if step.coalesce_key else None
        taken_back = {**self.redo_stacks, step.user_id: self._remaining_redo_ids(step)}
        return replace(going_on or self._appended(step), redo_stacks=taken_back)

    def append_branch(self, step: HistoryEntry) -> "UndoHistory":
        """The history with a step that leads nowhere: a design that somebody may want to go back to."""
        appended = self._appended(step)
        return replace(appended, current_id=self.current_id)

    def moved_to(self, entry_id: int) -> "UndoHistory":
        """The history at another of its steps."""
        return replace(self, current_id=entry_id) if entry_id in self.entries else self

    def undo(self, person: str, at_s: float = 0.0) -> "UndoHistory | UndoConflict":
        """One's own newest step taken back: by going back to before it, or out of what others did since."""
        step = self.next_undo(person)
        if step is None:
            return self
        taken_back = {**self.redo_stacks, person: (*self.redo_stacks.get(person, ()), step.id)}
        if step.id == self.current_id:
            return replace(self, current_id=step.parent, redo_stacks=taken_back)
        parent = self.entries[step.parent]
        merged = merge_designs(step.design, self.current.design, parent.design)
        if merged.conflicts:
            return UndoConflict(
                entry=step, blocking_entry=self._first_conflicting(step, parent), path=merged.conflicts[0].path
            )
        undoing = HistoryEntry(
            user_id=person, label=f"undo {step.label}", at_s=at_s, undone_id=step.id, design=merged.design
        )
        return replace(self._appended(undoing), redo_stacks=taken_back)

    def redo(self, person: str, at_s: float = 0.0) -> "UndoHistory | UndoConflict":
        """What a person took back last, done again: by going forward to it, or into what others did since."""
        step = self.next_redo(person)
        if step is None:
            return self
        stack = self.redo_stacks.get(person, ())
        taken_back = {**self.redo_stacks, person: stack[: stack.index(step.id)]}
        if step.parent == self.current_id:
            return replace(self, current_id=step.id, redo_stacks=taken_back)
        parent = self.entries[step.parent]
        merged = merge_designs(parent.design, self.current.design, step.design)
        if merged.conflicts:
            return UndoConflict(entry=step, blocking_entry=self.current, path=merged.conflicts[0].path)
        again = HistoryEntry(user_id=person, label=f"redo {step.label}", at_s=at_s, design=merged.design)
        return replace(self._appended(again), redo_stacks=taken_back)

    def next_undo(self, person: str) -> HistoryEntry | None:
        """What undo would take back for a person."""
        path = self.path[1:]
        gone = {step.undone_id for step in path}
        own = (step for step in reversed(path) if step.user_id == person and not step.undone_id and step.id not in gone)
        return next(own, None)

    def next_redo(self, person: str) -> HistoryEntry | None:
        """What redo would do again for a person."""
        path = self.path
        undone = {step.undone_id for step in path}
        done = {step.id for step in path} - undone
        stack = (self.entries.get(id_) for id_ in reversed(self.redo_stacks.get(person, ())))
        return next((step for step in stack if step and step.id not in done and step.parent in self.entries), None)

    def compound_entries(self) -> tuple[HistoryEntry, ...]:
        """The steps on the way to now that edited several files, and were not taken back."""
        gone = {step.undone_id for step in self.path}
        return tuple(step for step in self.path if step.compound and not step.undone_id and step.id not in gone)

    def _remaining_redo_ids(self, step: HistoryEntry) -> tuple[int, ...]:
        """What the person may do again after a step; doing something new gives up the rest."""
        stack = self.redo_stacks.get(step.user_id, ())
        if step.undone_id:
            return (*stack, step.undone_id)
        known = (
            at for at, each in enumerate(stack) if each in self.entries and self.entries[each].compound == step.compound
        )
        again = max(known, default=0) if step.compound else 0
        return stack[:again]

    def _appended(self, step: HistoryEntry) -> "UndoHistory":
        id_ = max(self.entries) + 1
        steps = {**self.entries, id_: replace(step, id=id_, parent=self.current_id)}
        return replace(self, entries=_without_oldest(steps, id_), current_id=id_)

    def _coalesced(self, step: HistoryEntry) -> "UndoHistory | None":
        """The history in which `entry` belongs to the person's last one, if that was typed into the same field.

        What others typed meanwhile stands above it, so each of their steps is given the new text, too.
        """
        since: list[HistoryEntry] = []
        for last in reversed(self.path[-_MAX_COALESCE_DEPTH:]):
            if last.user_id == step.user_id:
                break
            since.append(last)
        goes_on = (last.user_id, last.coalesce_key) == (
            step.user_id,
            step.coalesce_key,
        ) and step.at_s - last.at_s < _COALESCE_TIMEOUT_S
        has_branch = any(each.parent == self.current_id for each in self.entries.values())
        if not goes_on or has_branch or not all(each.coalesce_key for each in since):
            return None
        grown = {}
        for each in (last, *since[1:]):
            merged = merge_designs(self.current.design, each.design, step.design)
            if merged.conflicts:
                return None
            grown[each.id] = replace(each, design=merged.design)
        grown[last.id] = replace(grown[last.id], at_s=step.at_s)
        grown[self.current_id] = replace(grown.get(self.current_id, self.current), design=step.design)
        return replace(self, entries={**self.entries, **grown})

    def _first_conflicting(self, step: HistoryEntry, parent: HistoryEntry) -> HistoryEntry:
        """The first later step with which `entry` can no longer be taken out."""
        later = [each for each in self.path if each.id > step.id]

        def touches(each: HistoryEntry) -> bool:
            return bool(merge_designs(step.design, each.design, parent.design).conflicts)

        return later[min(bisect_left(later, True, key=touches), len(later) - 1)]


def _without_oldest(steps: dict[int, HistoryEntry], newest: int) -> dict[int, HistoryEntry]:
    """The steps without the oldest, once there are too many; the next one becomes the start of its branch."""
    if len(steps) <= MAX_ENTRIES:
        return steps
    path = [newest]
    while steps[path[-1]].parent in steps:
        path.append(steps[path[-1]].parent)
    # A step beside the way that leads here is given up first.
    oldest = min(steps, key=lambda id_: (id_ in path, id_))
    return {id_: step for id_, step in steps.items() if id_ != oldest}
