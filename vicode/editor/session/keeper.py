"""Keeps work from being lost: journals what is unsaved, saves by itself where that is wanted, offers what was left."""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from difflib import unified_diff

from vicode.editor.session.document import Document, News
from vicode.editor.session.library import Library
from vicode.editor.session.people import DISK
from vicode.editor.session.recovery import Lost, Recovery, Snapshot
from vicode.editor.session.wording import reason_of
from vicode.editor.session.workspace import ChangedOnDiskError, Workspace
from vicode.model.merging import merge
from vicode.store import read_design

_REST_S = 1.0


@dataclass(eq=False)
class Keeper:
    """Looks after all open designs of a library."""

    library: Library
    recovery: Recovery
    clock: Callable[[], float] = time.time

    def __post_init__(self) -> None:
        """Go on saving by itself what was saved so when the last server ended."""
        noted = self.recovery.saving_by_themselves
        for workspace in self.library.workspaces:
            workspace.autosave = str(workspace.folder.resolve()) in noted

    def set_autosave(self, workspace: Workspace, *, is_on: bool) -> None:
        """Save a project by itself, or no more; also after the next start."""
        workspace.autosave = is_on
        # Where nothing can be noted it holds for as long as this server runs.
        with contextlib.suppress(OSError):
            self.recovery.note_autosave(workspace.folder, is_on=is_on)

    def due(self) -> list[Snapshot]:
        """What the journals must be told now."""
        found = (
            self.recovery.due(workspace.folder, document.design.component, document.sheet)
            for workspace, document in self._open()
        )
        return [snapshot for snapshot in found if snapshot is not None]

    def save_rested(self, rest_s: float = _REST_S) -> None:
        """Save what was not touched for a second, in projects that are saved by themselves."""
        for workspace, document in self._open():
            is_resting = self.clock() - document.history.present.at_s > rest_s
            if not workspace.autosave or document.is_saved or document.sheet.clash or not is_resting:
                continue
            try:
                workspace.save(document)
            except ChangedOnDiskError:
                # The header says so, and waits for a person to choose.
                continue
            except (OSError, ValueError) as error:
                _tell_once(document, f"{document.file.name} cannot be saved: {reason_of(error)}")

    def close(self) -> None:
        """End in order: what was done in the last moment is kept, too."""
        self.save_rested(0)
        for snapshot in self.due():
            with contextlib.suppress(OSError):
                self.recovery.write(snapshot)
        self.recovery.close()

    def lost(self, workspace: Workspace) -> tuple[Lost, ...]:
        """What can be recovered in a project; what the files hold already is forgotten.

        Work on a design whose file cannot be read just now is kept until it can.
        """
        offered = []
        for lost in self.recovery.lost(workspace.folder):
            document = workspace.document(lost.component)
            mine = read_design(lost.text).design
            if document is not None and mine == document.design:
                self.recovery.forget(lost)
            elif mine is not None and (document is not None or workspace.may_create(lost.component)):
                offered.append(lost)
        return tuple(offered)

    def recover(self, workspace: Workspace, lost: Lost, person: str) -> int:
        """Bring lost work back as one step; returns how often it won over what the file says now.

        Where the file is gone it is made again.

        Raises:
            OSError: It cannot be made.
        """
        document = workspace.document(lost.component)
        base, mine = read_design(lost.base_text).design, read_design(lost.text).design
        if mine is None:
            return 0
        if document is None:
            workspace.create(lost.component, lost.text)
            self.recovery.forget(lost)
            return 0
        merged = merge(base or document.design, mine, document.design)
        Document(document.sheet, person).edit("recover unsaved changes", lambda _design: merged.design)
        self.recovery.forget(lost)
        return len(merged.conflicts)

    def _open(self) -> Iterator[tuple[Workspace, Document]]:
        for workspace in self.library.workspaces:
            for document in workspace.documents:
                yield workspace, document


def difference_of(lost: Lost) -> str:
    """What lost work had changed in its file, as a unified diff."""
    old, new = lost.base_text.splitlines(), lost.text.splitlines()
    return "\n".join(list(unified_diff(old, new, lineterm="", n=2))[2:])


def _tell_once(document: Document, text: str) -> None:
    sheet = document.sheet
    if sheet.news.text != text:
        sheet.news = News(text, DISK, sheet.rev)
        sheet.tell(Document(sheet, DISK))
