"""One open design: the sheet that all windows share, and the hold of one person on it."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from vicode.editor.session.descriptions import describe_path
from vicode.editor.session.history import CompoundEdit, HistoryEntry, UndoConflict, UndoHistory
from vicode.editor.session.presence import DISK_USER, PresenceRoom, UserDirectory
from vicode.editor.view import Scene, diff_scenes, make_scene, parse_transition_key
from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.merge import Conflict, merge_designs
from vicode.model.project import Project
from vicode.model.traversal import find_decision

DocumentListener = Callable[["DocumentSession"], None]
DesignChecker = Callable[[Design], tuple[Finding, ...]]
_MAX_RECENT_DESIGNS = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class DiskVersion:
    """What a file holds: its text, the design in it (None when there is none), what was wrong with the text."""

    text: str
    design: Design | None
    parse_findings: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class FileTransaction:
    """What somebody here did to the files of several designs, as their histories tell it.

    `undone_edit` is the edit that it takes back.
    """

    files: frozenset[Path]
    label: str
    user_id: str = ""
    compound: CompoundEdit | None = None
    undone_edit: CompoundEdit | None = None


@dataclass(frozen=True, slots=True)
class ChangeNotice:
    """What somebody did to the whole design, to be told to the others."""

    text: str = ""
    user_id: str = ""
    rev: int = 0


@dataclass(eq=False, kw_only=True)
class SharedDocument:
    """What all windows on a design share: its history, what is wrong with it, who watches it, who is here.

    `rev` counts the changes. `disk_text` is the text last read from or written to `file`, `saved` the design in it,
    `parse_findings` what is wrong with it: keys that mean nothing are not in the design, but they are in the file. `disk_conflict` is
    what another program wrote into the file where unsaved work is, until somebody chooses.
    """

    file: Path
    disk_text: str
    saved: Design
    check: DesignChecker
    parse_findings: tuple[Finding, ...] = ()
    users: UserDirectory = field(default_factory=UserDirectory)
    clock: Callable[[], float] = time.time
    presence: PresenceRoom = field(init=False, default_factory=PresenceRoom)
    history: UndoHistory = field(init=False)
    findings: tuple[Finding, ...] = field(init=False, default=())
    rev: int = field(init=False, default=0)
    disk_conflict: DiskVersion | None = field(init=False, default=None)
    notice: ChangeNotice = field(init=False, default=ChangeNotice())
    listeners: list[DocumentListener] = field(init=False, default_factory=list)
    _drawn: tuple[Project, tuple[Finding, ...], Scene] | None = field(init=False, default=None)
    _recent_designs: dict[int, Design] = field(init=False, default_factory=dict)
    _differences: deque[tuple[Scene, Scene, dict[str, Any]]] = field(
        init=False, default_factory=lambda: deque(maxlen=8)
    )

    def __post_init__(self) -> None:
        """Begin with what is on disk."""
        self.history = UndoHistory.begin(self.saved, self.clock())
        self.findings = self._find()

    def set_history(self, history: UndoHistory, origin: "DocumentSession") -> None:
        """Go on with another history, and tell everybody."""
        if history is self.history:
            return
        self._recent_designs[self.rev] = self.history.current.design
        self._recent_designs.pop(self.rev - _MAX_RECENT_DESIGNS, None)
        self.history = history
        self.rev += 1
        self.findings = self._find()
        self.notify_listeners(origin)

    def scene(self, project: Project) -> Scene:
        """What the canvas draws; worked out once for all windows."""
        drawn = self._drawn
        if drawn is None or drawn[0] is not project or drawn[1] is not self.findings or drawn[2]["rev"] != self.rev:
            scene = make_scene(project, self.history.current.design, self.findings, self.rev)
            self._drawn = drawn = (project, self.findings, scene)
        return drawn[2]

    def scene_diff(self, before: Scene, now: Scene) -> dict[str, Any]:
        """What differs between two scenes; worked out once for all windows that show the first."""
        for old, new, changes in self._differences:
            if old is before and new is now:
                return changes
        changes = diff_scenes(before, now)
        self._differences.append((before, now, changes))
        return changes

    def design_at(self, rev: int) -> Design:
        """The design as it was at a recent `rev`, as it is now for any other."""
        return self._recent_designs.get(rev, self.history.current.design)

    def mark_saved(self, disk: DiskVersion) -> None:
        """Note what the file holds now."""
        assert disk.design is not None
        self.saved, self.disk_text, self.parse_findings, self.disk_conflict = (
            disk.design,
            disk.text,
            disk.parse_findings,
            None,
        )
        self.findings = self._find()

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """What both sides of a clash touched by now: whoever works on may touch more, or take something back."""
        if self.disk_conflict is None or self.disk_conflict.design is None:
            return ()
        return merge_designs(self.saved, self.history.current.design, self.disk_conflict.design).conflicts

    def recheck(self) -> None:
        """Check once more, because another design of the project has changed."""
        findings = self._find()
        if findings != self.findings:
            self.findings = findings
            self.notify_listeners(DocumentSession(self, DISK_USER))

    def notify_listeners(self, origin: "DocumentSession") -> None:
        """Tell every watcher that `origin` changed something."""
        for watcher in tuple(self.listeners):
            watcher(origin)

    def _find(self) -> tuple[Finding, ...]:
        return tuple(dict.fromkeys((*self.parse_findings, *self.check(self.history.current.design))))


@dataclass(eq=False)
class DocumentSession:
    """An open design in the hands of one person; what others do to the sheet is seen here at once.

    Every change goes through `edit`, `undo`, `redo` or `jump_to`; watchers are told after each.
    """

    shared: SharedDocument
    user_id: str = ""

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self.shared.history.current.design

    @property
    def history(self) -> UndoHistory:
        """Where it has been."""
        return self.shared.history

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What is wrong with it."""
        return self.shared.findings

    @property
    def rev(self) -> int:
        """How often it has changed."""
        return self.shared.rev

    @property
    def file(self) -> Path:
        """Where it is saved."""
        return self.shared.file

    @property
    def is_file_missing(self) -> bool:
        """Whether there is no such file any more, or nothing in it; one that is no text is there."""
        return not self.file.is_file() or not self.file.stat().st_size

    @property
    def is_saved(self) -> bool:
        """Whether the file holds the design as it is now."""
        return self.design == self.shared.saved

    def edit(self, label: str, change: Callable[[Design], Design], *, coalesce_key: str = "") -> None:
        """Change the design; `label` names the edit in the history.

        A person's edits that follow each other with the same `coalesce_key` (a field being typed in) are one step of it.
        """
        self._append(self._step(label, change(self.design), coalesce_key))

    def undo(self) -> str:
        """Take one's own last edit back; returns why not, if what it did was changed by another since."""
        step = self.history.next_undo(self.user_id)
        if step is not None and step.compound is not None:
            return self.undo_compound(step.compound)
        return self._adopt_history(self.history.undo(self.user_id, self.shared.clock()), "taken back")

    def redo(self) -> str:
        """Do again what undo took back; returns why not."""
        step = self.history.next_redo(self.user_id)
        if step is not None and step.compound is not None:
            refused = step.compound.redo(self.user_id)
            if not refused:
                self.record_compound(step.compound, f"redo {step.compound.label}")
            return refused
        return self._adopt_history(self.history.redo(self.user_id, self.shared.clock()), "done again")

    def undo_compound(self, whole: CompoundEdit) -> str:
        """Take an edit of other files back, as a step if it was one here; returns why not."""
        refused = whole.undo(self.user_id)
        step = next((each for each in reversed(self.history.compound_entries()) if each.compound == whole), None)
        if not refused and step is not None:
            self._append(replace(self._step(f"undo {whole.label}", self.design), undone_id=step.id))
        return refused

    def record_compound(self, whole: CompoundEdit, label: str = "") -> None:
        """Have an edit of other files that was done from here as a step, if it is none yet."""
        if all(each.compound != whole for each in self.history.compound_entries()):
            self._append(replace(self._step(label or whole.label, self.design), compound=whole))

    @property
    def undo_label(self) -> str:
        """What undo would take back, empty if nothing."""
        step = self.history.next_undo(self.user_id)
        return step.label if step else ""

    @property
    def redo_label(self) -> str:
        """What redo would do again, empty if nothing."""
        step = self.history.next_redo(self.user_id)
        return step.label if step else ""

    def jump_to(self, step: int) -> str:
        """Go to any point of the history; what is left stays in it, one jump away.

        What was one edit of several files on the way is taken back, or done again, in all of them; returns why not.
        One that changed nothing of this design keeps nobody from going: that it stays as it is, is told.
        """
        start = self.history.current_id
        before, after = self.history.compound_entries(), self.history.moved_to(step).compound_entries()
        left = [each for each in reversed(before) if each.compound not in {other.compound for other in after}]
        entered = [each for each in after if each.compound not in {other.compound for other in before}]
        told: list[str] = []
        for number, each in enumerate((*left, *entered)):
            refused = self._undo_or_redo(each, is_back=number < len(left))
            if refused and each.compound and self._changes_only_other_files(each):
                told.append(f"{each.compound.label} stays as it is. {refused}")
            elif refused:
                if not number:
                    self.shared.set_history(self.history.moved_to(start), self)
                return refused
        self.post_notice(
            f"{self.shared.users.name_of(self.user_id)} went to “{self.history.moved_to(step).current.label}”"
        )
        self.shared.set_history(self.history.moved_to(step), self)
        return "; ".join(told)

    def _changes_only_other_files(self, step: HistoryEntry) -> bool:
        """Whether a step changed other files alone."""
        parent = self.history.entries.get(step.parent)
        return parent is not None and parent.design == step.design

    def _undo_or_redo(self, step: HistoryEntry, *, is_back: bool) -> str:
        """Take an edit of several files back, or do it again: from here, or where the design is as the file has it."""
        assert step.compound is not None
        if not self.is_saved and not self._changes_only_other_files(step):
            self.shared.set_history(self.history.moved_to(step.id if is_back else step.parent), self)
        return step.compound.undo(self.user_id) if is_back else step.compound.redo(self.user_id)

    def adopt_disk_version(self, disk: DiskVersion, label: str, design: Design | None = None) -> None:
        """Note what the file holds now, and go on with that, or with `design`; the file's own stays in the history."""
        assert disk.design is not None
        self.shared.mark_saved(disk)
        history = self.history
        if design is not None and design != disk.design:
            theirs = HistoryEntry(
                user_id=DISK_USER, label="as it was on disk", at_s=self.shared.clock(), design=disk.design
            )
            history = history.append_branch(theirs)
            self.post_notice(f"Merged with what another program wrote into {self.file.name}")
        grown = history.append(self._step(label, design if design is not None else disk.design))
        if grown is self.history:
            self.shared.notify_listeners(self)
        else:
            self.shared.set_history(grown, self)

    def apply_transaction(self, act: FileTransaction, design: Design) -> None:
        """Go on with what an edit of several files made of this one, as a step of who did it."""
        undone = next(
            (step.id for step in reversed(self.history.compound_entries()) if step.compound == act.undone_edit), 0
        )
        whole = None if undone else act.compound
        step = replace(self._step(act.label, design), user_id=act.user_id, compound=whole, undone_id=undone)
        grown = self.history.append(step)
        if grown is self.history:
            self.shared.notify_listeners(self)
        else:
            self.shared.set_history(grown, self)

    def has_decision(self, key: str) -> bool:
        """Whether there is a decision with this canvas id."""
        return find_decision(self.design, parse_transition_key(key)) is not None

    def post_notice(self, text: str) -> None:
        """Say to the others what was done to the whole design."""
        self.shared.notice = ChangeNotice(text, self.user_id, self.shared.rev)

    def subscribe(self, watcher: DocumentListener) -> Callable[[], None]:
        """Tell `watcher` after every change, and by whom; what is returned ends it."""
        watchers = self.shared.listeners
        watchers.append(watcher)
        return lambda: watchers.remove(watcher) if watcher in watchers else None

    def _step(self, label: str, design: Design, typing_in: str = "") -> HistoryEntry:
        return HistoryEntry(
            user_id=self.user_id, label=label, at_s=self.shared.clock(), coalesce_key=typing_in, design=design
        )

    def _append(self, step: HistoryEntry) -> None:
        self.shared.set_history(self.history.append(step), self)

    def _adopt_history(self, outcome: UndoHistory | UndoConflict, done: str) -> str:
        if isinstance(outcome, UndoConflict):
            who, what = self.shared.users.name_of(outcome.blocking_entry.user_id), describe_path(outcome.path)
            return f"“{outcome.entry.label}” cannot be {done}: {who} changed {what} since (“{outcome.blocking_entry.label}”)"
        self.shared.set_history(outcome, self)
        return ""
