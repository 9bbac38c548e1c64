"""Keeps work from being lost: journals what is unsaved, saves by itself where that is wanted, offers what was left."""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from difflib import unified_diff

from vicode.editor.session.document import Document
from vicode.editor.session.library import Library
from vicode.editor.session.recovery import Lost, Recovery, Snapshot
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

    def due(self) -> list[Snapshot]:
        """What the journals must be told now."""
        found = (
            self.recovery.due(workspace.folder, document.design.component, document.sheet)
            for workspace, document in self._open()
        )
        return [snapshot for snapshot in found if snapshot is not None]

    def save_rested(self) -> None:
        """Save what was not touched for a second, in projects that are saved by themselves."""
        for workspace, document in self._open():
            is_resting = self.clock() - document.history.present.at_s > _REST_S
            if not workspace.autosave or document.is_saved or document.sheet.clash or not is_resting:
                continue
            # What touches the file's changes, or cannot be written, waits for a person to press Save.
            with contextlib.suppress(ChangedOnDiskError, OSError, ValueError):
                workspace.save(document)

    def lost(self, workspace: Workspace) -> tuple[Lost, ...]:
        """What can be recovered in a project; what the files hold already is forgotten."""
        offered = []
        for lost in self.recovery.lost(workspace.folder):
            document = workspace.document(lost.component)
            mine = read_design(lost.text).design
            if document is None or mine is None or mine == document.design:
                self.recovery.forget(lost)
            else:
                offered.append(lost)
        return tuple(offered)

    def recover(self, workspace: Workspace, lost: Lost, person: str) -> int:
        """Bring lost work back as one step; returns how often it won over what the file says now."""
        document = workspace.document(lost.component)
        base, mine = read_design(lost.base_text).design, read_design(lost.text).design
        if document is None or mine is None:
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
