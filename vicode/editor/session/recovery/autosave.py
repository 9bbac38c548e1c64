"""Autosave and recovery: journals unsaved designs, saves idle ones, and restores what a killed server left."""

import contextlib
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from difflib import unified_diff

from vicode.editor.session import texts
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import ChangeNotice, DocumentSession
from vicode.editor.session.library import Library
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.recovery.open_folders import OpenFolders
from vicode.editor.session.recovery.recovery_store import JournalSnapshot, RecoverableDesign, RecoveryStore
from vicode.editor.session.workspace import DiskConflictError, Workspace
from vicode.model.merge import merge_designs
from vicode.store import read_design

_DELAY_VARIABLE = "VICODE_AUTOSAVE_S"
_DELAY_S = 1.0
_EDITOR_CHECK_INTERVAL_S = 2.0


@dataclass(eq=False)
class AutosaveService:
    """Journals and saves all open designs of a library; a design is saved `delay_s` seconds after its last edit."""

    library: Library
    recovery: RecoveryStore
    delay_s: float = _DELAY_S
    clock: Callable[[], float] = time.time

    def __post_init__(self) -> None:
        self._open_folders = OpenFolders(self.recovery.folder / "open")
        self._editors_checked_s = 0.0

    def pending_snapshots(self) -> list[JournalSnapshot]:
        """The journals that must be written now."""
        found = (
            self.recovery.next_snapshot(workspace.folder, document.design.component, document.shared)
            for workspace, document in self._open_documents()
        )
        return [snapshot for snapshot in found if snapshot is not None]

    def save_idle_documents(self, idle_s: float | None = None) -> None:
        """Save the designs that have not changed for `idle_s` seconds, by default `delay_s`."""
        wanted_s = self.delay_s if idle_s is None else idle_s
        for workspace, document in self._open_documents():
            is_idle = self.clock() - document.history.current.at_s > wanted_s
            if document.is_saved or document.shared.disk_conflict or not is_idle:
                continue
            try:
                workspace.save(document)
            except DiskConflictError:
                # The header shows the conflict until a user resolves it.
                continue
            except (OSError, ValueError) as error:
                _notify_once(document, f"{document.file.name} cannot be saved: {error_reason(error)}")

    def find_other_editors(self, interval_s: float = _EDITOR_CHECK_INTERVAL_S) -> None:
        """Note which projects another editor has open, at most once per interval, and notify the users."""
        now_s = time.monotonic()
        if now_s - self._editors_checked_s < interval_s:
            return
        self._editors_checked_s = now_s
        for workspace in self.library.workspaces:
            is_shared = False
            with contextlib.suppress(OSError):
                is_shared = self._open_folders.has_other_editor(workspace.folder)
            if is_shared == workspace.has_other_editor:
                continue
            workspace.has_other_editor = is_shared
            for document in workspace.documents:
                _notify_once(
                    document, texts.OTHER_EDITOR if is_shared else "No other editor has this folder open any more"
                )

    def close(self) -> None:
        """Save and journal the latest edits, then close the journals."""
        self.save_idle_documents(0)
        for snapshot in self.pending_snapshots():
            with contextlib.suppress(OSError):
                self.recovery.write(snapshot)
        self.recovery.close()
        self._open_folders.close()

    def recoverable(self, workspace: Workspace) -> tuple[RecoverableDesign, ...]:
        """The recoverable designs of a project; journals equal to their file are discarded.

        The journal of a design whose file is currently unreadable is kept, but not listed.
        """
        offered = []
        for lost in self.recovery.recoverable(workspace.folder):
            document = workspace.open_document(lost.component)
            mine = read_design(lost.text).design
            if document is not None and mine == document.design:
                self.recovery.discard(lost)
            elif mine is not None and (document is not None or workspace.can_create(lost.component)):
                offered.append(lost)
        return tuple(offered)

    def recover(self, workspace: Workspace, lost: RecoverableDesign, person: str) -> int:
        """Merge lost work into the design as one edit; a missing file is created again.

        Returns:
            The number of conflicts with the current file, in each of which the lost work won.

        Raises:
            OSError: The file cannot be created.
        """
        document = workspace.open_document(lost.component)
        base, mine = read_design(lost.base_text).design, read_design(lost.text).design
        if mine is None:
            return 0
        if document is None:
            workspace.create(lost.component, lost.text)
            self.recovery.discard(lost)
            return 0
        merged = merge_designs(base or document.design, mine, document.design)
        DocumentSession(document.shared, person).edit("recover unsaved changes", lambda _design: merged.design)
        self.recovery.discard(lost)
        return len(merged.conflicts)

    def _open_documents(self) -> Iterator[tuple[Workspace, DocumentSession]]:
        for workspace in self.library.workspaces:
            for document in workspace.documents:
                yield workspace, document


def read_delay_s() -> float:
    """The delay before a design is saved. Tests lengthen it, so that what nobody saves stays unsaved."""
    return float(os.environ.get(_DELAY_VARIABLE, _DELAY_S))


def format_diff(lost: RecoverableDesign) -> str:
    """The changes of lost work against its file, as a unified diff without file headers."""
    old, new = lost.base_text.splitlines(), lost.text.splitlines()
    return "\n".join(list(unified_diff(old, new, lineterm="", n=2))[2:])


def _notify_once(document: DocumentSession, text: str) -> None:
    shared = document.shared
    if shared.notice.text != text:
        shared.notice = ChangeNotice(text, DISK_USER, shared.rev)
        shared.changes.notify(DocumentSession(shared, DISK_USER))
