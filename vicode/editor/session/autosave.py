"""Keeps work from being lost: journals what is unsaved, saves by itself where that is wanted, offers what was left."""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from difflib import unified_diff

from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.document import ChangeNotice, DocumentSession
from vicode.editor.session.library import Library
from vicode.editor.session.presence import DISK_USER
from vicode.editor.session.recovery import JournalSnapshot, RecoverableDesign, RecoveryStore
from vicode.editor.session.workspace import DiskConflictError, Workspace
from vicode.model.merge import merge_designs
from vicode.store import read_design

_AUTOSAVE_DELAY_S = 1.0


@dataclass(eq=False)
class AutosaveService:
    """Looks after all open designs of a library."""

    library: Library
    recovery: RecoveryStore
    clock: Callable[[], float] = time.time

    def __post_init__(self) -> None:
        """Go on saving by itself what was saved so when the last server ended."""
        noted = self.recovery.autosaved_projects
        for workspace in self.library.workspaces:
            workspace.autosave = str(workspace.folder.resolve()) in noted

    def set_autosave(self, workspace: Workspace, *, is_on: bool) -> None:
        """Save a project by itself, or no more; also after the next start."""
        workspace.autosave = is_on
        # Where nothing can be noted it holds for as long as this server runs.
        with contextlib.suppress(OSError):
            self.recovery.set_autosave(workspace.folder, is_on=is_on)

    def pending_snapshots(self) -> list[JournalSnapshot]:
        """What the journals must be told now."""
        found = (
            self.recovery.next_snapshot(workspace.folder, document.design.component, document.shared)
            for workspace, document in self._open_documents()
        )
        return [snapshot for snapshot in found if snapshot is not None]

    def save_idle_documents(self, idle_s: float = _AUTOSAVE_DELAY_S) -> None:
        """Save what was not touched for a second, in projects that are saved by themselves."""
        for workspace, document in self._open_documents():
            is_resting = self.clock() - document.history.current.at_s > idle_s
            if not workspace.autosave or document.is_saved or document.shared.disk_conflict or not is_resting:
                continue
            try:
                workspace.save(document)
            except DiskConflictError:
                # The header says so, and waits for a person to choose.
                continue
            except (OSError, ValueError) as error:
                _notify_once(document, f"{document.file.name} cannot be saved: {error_reason(error)}")

    def close(self) -> None:
        """End in order: what was done in the last moment is kept, too."""
        self.save_idle_documents(0)
        for snapshot in self.pending_snapshots():
            with contextlib.suppress(OSError):
                self.recovery.write(snapshot)
        self.recovery.close()

    def recoverable(self, workspace: Workspace) -> tuple[RecoverableDesign, ...]:
        """What can be recovered in a project; what the files hold already is forgotten.

        Work on a design whose file cannot be read just now is kept until it can.
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
        """Bring lost work back as one step; returns how often it won over what the file says now.

        Where the file is gone it is made again.

        Raises:
            OSError: It cannot be made.
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


def format_diff(lost: RecoverableDesign) -> str:
    """What lost work had changed in its file, as a unified diff."""
    old, new = lost.base_text.splitlines(), lost.text.splitlines()
    return "\n".join(list(unified_diff(old, new, lineterm="", n=2))[2:])


def _notify_once(document: DocumentSession, text: str) -> None:
    sheet = document.shared
    if sheet.notice.text != text:
        sheet.notice = ChangeNotice(text, DISK_USER, sheet.rev)
        sheet.notify_listeners(DocumentSession(sheet, DISK_USER))
