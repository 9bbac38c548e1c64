"""An open design: the document that all windows share, and the session of one user on it."""

import operator
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from vicode.diagram.kept_positions import keep_positions
from vicode.editor.session import texts
from vicode.editor.session.code.outside_edits import OutsideEdits
from vicode.editor.session.forms.form_data import FormLists, Forms, FormWriter
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.history import CompoundEdit, HistoryEntry, UndoConflict, UndoHistory
from vicode.editor.session.presence import DISK_USER, PresenceRoom, UserDirectory
from vicode.editor.view import Scene, SceneChanges, diff_scenes, make_scene
from vicode.editor.view.unfinished import unfinished_states
from vicode.findings import Finding
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Design
from vicode.model.lowering import lower_design, lower_edit
from vicode.model.merge import Conflict, merge_designs
from vicode.model.paths import describe_path
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.store import UnreadContentError, save_design
from vicode.subscribers import Subscribers

DesignChecker = Callable[[Design], tuple[Finding, ...]]
_MAX_RECENT_DESIGNS = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class DiskVersion:
    """The content of a file; `design` is None if it cannot be read as one."""

    text: str
    design: Design | None
    parse_findings: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class FileTransaction:
    """An edit by a user of the files of several designs; `undone_edit` is the edit that it undoes."""

    files: frozenset[Path]
    label: str
    user_id: str = ""
    compound: CompoundEdit | None = None
    undone_edit: CompoundEdit | None = None


@dataclass(frozen=True, slots=True)
class ChangeNotice:
    """An announcement to the other users of a design."""

    text: str = ""
    user_id: str = ""
    rev: int = 0


@dataclass(eq=False, kw_only=True)
class SharedDocument:
    """The state of a design that all its windows share.

    `rev` counts the changes. `disk_text` is the text last read from or written to `file`, `saved` the design in it, and
    `parse_findings` the findings about that text. `disk_conflict` is a version by another program that conflicts with
    unsaved edits, until a user resolves the conflict.
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
    deep_findings: tuple[Finding, ...] = field(init=False, default=())
    rev: int = field(init=False, default=0)
    disk_conflict: DiskVersion | None = field(init=False, default=None)
    notice: ChangeNotice = field(init=False, default=ChangeNotice())
    outside: OutsideEdits = field(init=False, default_factory=OutsideEdits)
    """Edits of the generated code by other programs."""
    list_ids: ListIds = field(init=False, default_factory=ListIds)
    """The ids of the actions in the current design."""
    changes: Subscribers[["DocumentSession"]] = field(init=False, default_factory=Subscribers)
    """Called after every change with the session that made it."""
    _drawn: tuple[tuple[object, ...], Scene] | None = field(init=False, default=None)
    _forms: FormWriter = field(init=False, default_factory=FormWriter)
    _recent_designs: dict[int, Design] = field(init=False, default_factory=dict)
    _differences: deque[tuple[Scene, Scene, SceneChanges]] = field(init=False, default_factory=lambda: deque(maxlen=8))

    def __post_init__(self) -> None:
        self.history = UndoHistory.begin(self.saved, self.clock())
        self.findings = self._find()

    def set_history(self, history: UndoHistory, origin: "DocumentSession") -> None:
        """Replace the history and notify the subscribers."""
        if history is self.history:
            return
        self._recent_designs[self.rev] = self.history.current.design
        self._recent_designs.pop(self.rev - _MAX_RECENT_DESIGNS, None)
        self.list_ids.follow(self.history.current.design, history.current.design)
        self.history, self.deep_findings = history, ()
        self.rev += 1
        self.findings = self._find()
        self.changes.notify(origin)

    def scene(self, project: Project) -> Scene:
        """The scene of the canvas, cached for all windows."""
        marked = frozenset(item.id for item in self.outside.marked_items(self.history) if item.kind == "states")
        key = (project, self.findings, self.rev, marked)
        if self._drawn is None or not _is_same(self._drawn[0], key):
            design = self.history.current.design
            marks = {"changed_outside": marked, "unfinished": self.unfinished_states}
            self._drawn = (key, make_scene(project, design, self.findings, self.rev, **marks))
        return self._drawn[1]

    @property
    def unfinished_states(self) -> frozenset[str]:
        """The states that were added since the design was opened and have no transition yet."""
        opened = next(iter(self.history.entries.values()))
        return unfinished_states(opened.design, self.history.current.design)

    def forms(self, project: Project) -> Forms:
        return self._forms.write(project, self.history.current.design, self.list_ids)

    def form_lists(self, project: Project) -> FormLists:
        """What the forms share."""
        return self._forms.lists(project, self.history.current.design)

    def scene_diff(self, before: Scene, now: Scene) -> SceneChanges:
        """The difference of two scenes, cached for all windows that show the first."""
        for old, new, changes in self._differences:
            if old is before and new is now:
                return changes
        changes = diff_scenes(before, now)
        self._differences.append((before, now, changes))
        return changes

    def design_at(self, rev: int) -> Design:
        """The design at revision `rev` if that is recent, otherwise the current design."""
        return self._recent_designs.get(rev, self.history.current.design)

    def mark_saved(self, disk: DiskVersion) -> None:
        assert disk.design is not None
        self.saved, self.disk_text, self.parse_findings = disk.design, disk.text, disk.parse_findings
        self.disk_conflict = None
        self.findings = self._find()

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """The conflicts between unsaved edits and `disk_conflict`, which change as editing continues."""
        if self.disk_conflict is None or self.disk_conflict.design is None:
            return ()
        return merge_designs(self.saved, self.history.current.design, self.disk_conflict.design).conflicts

    def find_lost_content(self, design: Design) -> str:
        """The content of the file that was not understood and that this design could not keep; empty if none."""
        if not self.parse_findings or design == self.saved:
            return ""
        try:
            save_design(design, self.disk_text)
        except UnreadContentError as error:
            return str(error)
        except ValueError:
            # Unfinished edits, such as duplicate names, are reported when the design is saved.
            return ""
        return ""

    def set_deep_findings(self, findings: tuple[Finding, ...]) -> None:
        """Show the findings of the checks that take longer, until the next edit."""
        self.deep_findings = findings
        self.recheck()

    def recheck(self) -> None:
        """Check the design again after a change of another design."""
        findings = self._find()
        if findings != self.findings:
            self.findings = findings
            self.changes.notify(DocumentSession(self, DISK_USER))

    def _find(self) -> tuple[Finding, ...]:
        found = self.check(self.history.current.design)
        return tuple(dict.fromkeys((*self.parse_findings, *found, *self.outside.findings, *self.deep_findings)))


@dataclass(eq=False)
class DocumentSession:
    """The session of one user on a shared document; edits of other users are visible at once."""

    shared: SharedDocument
    user_id: str = ""

    @property
    def design(self) -> Design:
        return self.shared.history.current.design

    @property
    def history(self) -> UndoHistory:
        return self.shared.history

    @property
    def findings(self) -> tuple[Finding, ...]:
        return self.shared.findings

    @property
    def rev(self) -> int:
        return self.shared.rev

    @property
    def file(self) -> Path:
        return self.shared.file

    @property
    def is_file_missing(self) -> bool:
        """Whether the file does not exist or is empty."""
        return not self.file.is_file() or not self.file.stat().st_size

    @property
    def is_saved(self) -> bool:
        return self.design == self.shared.saved

    def edit(self, label: str, change: Callable[[Design], Design], *, coalesce_key: str = "") -> None:
        """Change the design, unless content of its file that was not understood would be lost.

        Args:
            label: The label in the undo history.
            change: Maps the current design to the new one.
            coalesce_key: Consecutive edits of a user with the same key, such as a field being typed in, are one entry.
        """
        design, derived = lower_edit(self.design, change(self.design))
        design = lower_design(keep_positions(self.design, design))
        if reason := derived or self.shared.find_lost_content(design):
            self.shared.notice = ChangeNotice(f"Not changed: {reason}", DISK_USER, self.shared.notice.rev + 1)
            self.shared.changes.notify(self)
        else:
            self._append(self._new_entry(label, design, coalesce_key))

    def undo(self) -> str:
        """Undo the user's latest edit; returns an error message if it conflicts with later edits of others."""
        entry = self.history.next_undo(self.user_id)
        if entry is not None and entry.compound is not None:
            return self.undo_compound(entry.compound)
        outcome = self.history.undo(self.user_id, self.shared.clock())
        return self._adopt_history(outcome, texts.cannot_undo)

    def redo(self) -> str:
        """Redo the user's latest undone edit; returns an error message if it conflicts with later edits of others."""
        entry = self.history.next_redo(self.user_id)
        if entry is not None and entry.compound is not None:
            error = entry.compound.redo(self.user_id)
            if not error:
                self.record_compound(entry.compound, texts.redo_label(entry.compound.label))
            return error
        outcome = self.history.redo(self.user_id, self.shared.clock())
        return self._adopt_history(outcome, texts.cannot_redo)

    def undo_entry(self, entry_id: int) -> str:
        """Undo one edit by any user; returns an error message if it conflicts with later edits."""
        entry = self.history.entries.get(entry_id)
        if entry is None or entry_id not in self.history.done_ids:
            return ""
        return self._adopt_history(self.history.undo_entry(entry, self.user_id, self.shared.clock()), texts.cannot_undo)

    def undo_compound(self, compound: CompoundEdit) -> str:
        """Undo an edit of several files, and record that if this history contains it; returns an error message."""
        error = compound.undo(self.user_id)
        undone = next((each for each in reversed(self.history.compound_entries()) if each.compound == compound), None)
        if not error and undone is not None:
            label = texts.undo_label(compound.label)
            self._append(replace(self._new_entry(label, self.design), undone_id=undone.id))
        return error

    def record_compound(self, compound: CompoundEdit, label: str = "") -> None:
        """Add an entry for an edit of several files, unless the history contains it already."""
        if all(entry.compound != compound for entry in self.history.compound_entries()):
            self._append(replace(self._new_entry(label or compound.label, self.design), compound=compound))

    @property
    def undo_label(self) -> str:
        """The label of the edit that undo would revert, empty if there is none."""
        entry = self.history.next_undo(self.user_id)
        return entry.label if entry else ""

    @property
    def redo_label(self) -> str:
        """The label of the edit that redo would restore, empty if there is none."""
        entry = self.history.next_redo(self.user_id)
        return entry.label if entry else ""

    def jump_to(self, entry_id: int) -> str:
        """Jump to any entry of the history; all entries are kept.

        Edits of several files between the two entries are undone or redone in all files. If one fails, the jump fails,
        unless the edit changes only other files: then it is kept.

        Returns:
            Messages for the user: the error, or the edits that were kept.
        """
        start = self.history.current_id
        before, after = self.history.compound_entries(), self.history.moved_to(entry_id).compound_entries()
        undone = [entry for entry in reversed(before) if entry.compound not in {other.compound for other in after}]
        redone = [entry for entry in after if entry.compound not in {other.compound for other in before}]
        notes: list[str] = []
        for number, entry in enumerate((*undone, *redone)):
            error = self._undo_or_redo(entry, is_undo=number < len(undone))
            if error and entry.compound and self._changes_only_other_files(entry):
                notes.append(f"“{entry.compound.label}” was kept. {error}")
            elif error:
                if not number:
                    self.shared.set_history(self.history.moved_to(start), self)
                return error
        target = self.history.moved_to(entry_id)
        self.post_notice(
            f"{self.shared.users.name_of(self.user_id)} went to “{target.current.label}” in the undo history"
        )
        self.shared.set_history(target, self)
        return "; ".join(notes)

    def _changes_only_other_files(self, entry: HistoryEntry) -> bool:
        parent = self.history.entries.get(entry.parent)
        return parent is not None and parent.design == entry.design

    def _undo_or_redo(self, entry: HistoryEntry, *, is_undo: bool) -> str:
        assert entry.compound is not None
        if not self.is_saved and not self._changes_only_other_files(entry):
            # The edit applies to the saved design, which is the one next to it in the history.
            self.shared.set_history(self.history.moved_to(entry.id if is_undo else entry.parent), self)
        return entry.compound.undo(self.user_id) if is_undo else entry.compound.redo(self.user_id)

    def adopt_disk_version(self, disk: DiskVersion, label: str, design: Design | None = None) -> None:
        """Record the content of the file and continue with its design, or with `design`.

        In the second case the version on disk is added to the history as a branch.
        """
        assert disk.design is not None
        self.shared.mark_saved(disk)
        history = self.history
        if design is not None and design != disk.design:
            history = history.append_branch(replace(self._new_entry("version on disk", disk.design), user_id=DISK_USER))
            self.post_notice(f"Merged changes that another program wrote to {self.file.name}")
        self._set_history_or_notify(
            history.append(self._new_entry(label, design if design is not None else disk.design))
        )

    def apply_transaction(self, transaction: FileTransaction, design: Design) -> None:
        """Record the result of an edit of several files as an entry of the user who made it."""
        entries = reversed(self.history.compound_entries())
        undone_id = next((entry.id for entry in entries if entry.compound == transaction.undone_edit), 0)
        entry = replace(
            self._new_entry(transaction.label, design),
            user_id=transaction.user_id,
            compound=None if undone_id else transaction.compound,
            undone_id=undone_id,
        )
        self._set_history_or_notify(self.history.append(entry))

    def has_decision(self, key: str) -> bool:
        """Whether a decision with this canvas id exists."""
        return find_decision(self.design, parse_transition_key(key)) is not None

    def post_notice(self, text: str) -> None:
        """Announce a change of the whole design to the other users."""
        self.shared.notice = ChangeNotice(text, self.user_id, self.shared.rev)

    def _new_entry(self, label: str, design: Design, coalesce_key: str = "") -> HistoryEntry:
        return HistoryEntry(
            user_id=self.user_id, label=label, at_s=self.shared.clock(), coalesce_key=coalesce_key, design=design
        )

    def _append(self, entry: HistoryEntry) -> None:
        self.shared.set_history(self.history.append(entry), self)

    def _set_history_or_notify(self, history: UndoHistory) -> None:
        """Subscribers also show whether the design is saved, which changes without a new entry."""
        if history is self.history:
            self.shared.changes.notify(self)
        else:
            self.shared.set_history(history, self)

    def _adopt_history(
        self, outcome: UndoHistory | UndoConflict, describe_conflict: Callable[[str, str, str, str], str]
    ) -> str:
        if isinstance(outcome, UndoConflict):
            blocking, place = outcome.blocking_entry, describe_path(outcome.path)
            user = self.shared.users.name_of(blocking.user_id)
            return describe_conflict(outcome.entry.label, user, place, blocking.label)
        self.shared.set_history(outcome, self)
        return ""


def _is_same(before: tuple[object, ...], now: tuple[object, ...]) -> bool:
    """Whether two cache keys are the same; comparing projects and findings by value would take long."""
    *big, rev, marked = now
    return all(map(operator.is_, before, big)) and before[len(big) :] == (rev, marked)
