"""Edits of a design's generated code by other programs: which were applied, and what waits for a user."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from vicode.editor.session.gestures.item_paths import TrackedItem
from vicode.editor.session.history import UndoHistory
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath, Finding
from vicode.model.decision_keys import parse_transition_key
from vicode.sync import FileEdits, RecordedEdit, RegionEdit, RegionKey


@dataclass(frozen=True, slots=True, kw_only=True)
class OutsideEdit:
    """An edit of a region that is missing from the design.

    Attributes:
        file: The generated file.
        region: The edited region.
        path: Its code in the design, () if the design has no such code any more.
        finding: Why it was not applied, None if a user has undone it.
    """

    file: FileEdits
    region: RegionEdit
    path: DesignPath
    finding: Finding | None = None

    @property
    def key(self) -> RegionKey:
        return (self.file.path, self.region.id)

    @property
    def name(self) -> str:
        """The id of the code, with the current name of its state."""
        return self.region.target or self.region.id

    @property
    def version(self) -> tuple[str, str, str, str]:
        """Differs for each edit of a region."""
        return (*self.key, self.region.checksum, self.region.file_text)


@dataclass(frozen=True, slots=True, kw_only=True)
class AppliedNotice:
    """An announcement of an applied edit; `entry_id` is its entry in the undo history, 0 for none."""

    text: str = ""
    entry_id: int = 0
    number: int = 0


@dataclass(eq=False, slots=True)
class OutsideEdits:
    """The edits of the generated code of one open design.

    Attributes:
        waiting: The edits missing from the design.
        problems: Errors in the generated files, such as broken marks.
        edited_outside: Files with edits outside regions, which are read back by Generate.
        is_postponed: Whether the design has errors, so that edits cannot be found.
        notice: The last announcement.
        offered: The versions of edits that were applied once; after an undo they wait for a user.
        seen: The files and the design at the last comparison.
    """

    waiting: tuple[OutsideEdit, ...] = ()
    problems: tuple[Finding, ...] = ()
    edited_outside: tuple[FileEdits, ...] = ()
    is_postponed: bool = False
    notice: AppliedNotice = field(default_factory=AppliedNotice)
    offered: set[tuple[str, str, str, str]] = field(default_factory=set)
    seen: object = None
    _taken: dict[RegionKey, tuple[RecordedEdit, int]] = field(default_factory=dict)
    _marked: tuple[tuple[TrackedItem, int], ...] = ()

    @property
    def is_open(self) -> bool:
        """Whether a change of the design may change what waits."""
        return bool(self.waiting or self.problems or self.is_postponed)

    @property
    def conflicts(self) -> tuple[OutsideEdit, ...]:
        """The edits about which a user must decide."""
        return tuple(edit for edit in self.waiting if edit.region.is_conflict)

    @property
    def lacks_edits(self) -> bool:
        """Whether the generated files contain something that the design lacks."""
        return bool(self.waiting or self.problems or self.edited_outside)

    @property
    def findings(self) -> tuple[Finding, ...]:
        return (*self.problems, *(edit.finding for edit in self.waiting if edit.finding is not None))

    def marked_items(self, history: UndoHistory) -> frozenset[ItemRef]:
        """The states and sections with code that was changed outside and not looked at since."""
        done = history.done_ids if self._marked else ()
        return frozenset(
            _owner(item.path) for item, entry_id in self._marked if item.path is not None and entry_id in done
        )

    def announce(self, text: str, entry_id: int) -> None:
        self.notice = AppliedNotice(text=text, entry_id=entry_id, number=self.notice.number + 1)

    def mark(self, items: Iterable[TrackedItem], entry_id: int) -> None:
        self._marked = (*self._marked, *((item, entry_id) for item in items))

    def unmark(self, items: Iterable[ItemRef] | None = None) -> bool:
        """Remove the marks of items, by default all; returns whether there were any."""
        left = None if items is None else {_owner_of(item) for item in items}
        kept = tuple(mark for mark in self._marked if left is not None and _owner(mark[0].path or ()) not in left)
        is_changed, self._marked = kept != self._marked, kept
        return is_changed

    def record(self, edits: Iterable[OutsideEdit], entry_id: int) -> None:
        """Record edits that the design contains since an entry of its history; with 0, that a user refused them."""
        for edit in edits:
            region = edit.region
            applied = RecordedEdit(
                checksum=region.checksum,
                file_text=region.file_text,
                design_text=region.design_text if entry_id else None,
            )
            self._taken[edit.key] = (applied, entry_id)

    def applied_edits(self, history: UndoHistory) -> Mapping[RegionKey, RecordedEdit | None]:
        """The edits that the current design contains; None for those that were undone."""
        done = history.done_ids

        def is_done(entry_id: int) -> bool:
            # The oldest entries are dropped.
            return not entry_id or entry_id in done or entry_id not in history.entries

        return {key: applied if is_done(entry_id) else None for key, (applied, entry_id) in self._taken.items()}


def _owner(path: DesignPath) -> ItemRef:
    """The item of the canvas that shows the code at a path: the source of a transition."""
    match path:
        case ("states", str(name), *_):
            return ItemRef(kind="states", id=name)
        case ("common", *_):
            return ItemRef(kind="common", id="@common")
        case _:
            return ItemRef(kind="design")


def _owner_of(item: ItemRef) -> ItemRef:
    return _owner(parse_transition_key(item.id)) if item.kind == "transitions" else item
