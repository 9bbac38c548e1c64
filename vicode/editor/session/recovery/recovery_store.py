"""Journals of unsaved designs, outside the project, from which work is recovered after a server was killed."""

import contextlib
import hashlib
import json
import secrets
import shutil
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.editor.session.document import SharedDocument
from vicode.model.design import Design
from vicode.output import write_atomically
from vicode.platform import state_folder, take_lock, user_id
from vicode.store import save_design

if TYPE_CHECKING:
    from filelock import BaseFileLock

_MAX_JOURNAL_BYTES = 20_000_000
_MAX_JOURNALS = 200


def open_recovery_store() -> "RecoveryStore":
    """Open the store in the state folder, or in a temporary folder if that cannot be written."""
    try:
        return RecoveryStore(state_folder())
    except OSError:
        return RecoveryStore(Path(tempfile.gettempdir()) / f"vicode-state{user_id()}")


@dataclass(frozen=True, slots=True, kw_only=True)
class RecoverableDesign:
    """Unsaved work left by a server: `base_text` is the text of its file, `text` that of the unsaved design."""

    journal: Path
    component: str
    at_s: float
    base_text: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class JournalSnapshot:
    """The content of a journal; `design` is None if nothing is unsaved and the journal is to be removed."""

    project: Path
    component: str
    at_s: float
    base_text: str
    design: Design | None


@dataclass(eq=False)
class RecoveryStore:
    """The journals of this server and of servers that no longer run.

    Each server holds a lock on its folder while it runs.

    Raises:
        OSError: The folder cannot be written.
    """

    folder: Path
    _own_folder: Path = field(init=False)
    _lock: "BaseFileLock" = field(init=False)
    _seen: dict[tuple[Path, str], tuple[Design, str]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._own_folder = self.folder / "unsaved" / secrets.token_hex(8)
        self._own_folder.mkdir(parents=True, mode=0o700)
        lock = take_lock(self._own_folder / "lock")
        assert lock is not None
        self._lock = lock

    def next_snapshot(self, project: Path, component: str, shared: SharedDocument) -> JournalSnapshot | None:
        """The snapshot to write for a design, None if its journal is up to date."""
        current, key = shared.history.current, (project, component)
        is_saved = current.design == shared.saved
        last = self._seen.get(key)
        if (last is None and is_saved) or last == (current.design, shared.disk_text):
            return None
        self._seen[key] = (current.design, shared.disk_text)
        if is_saved:
            del self._seen[key]
        return JournalSnapshot(
            project=project,
            component=component,
            at_s=current.at_s,
            base_text=shared.disk_text,
            design=None if is_saved else current.design,
        )

    def write(self, snapshot: JournalSnapshot) -> None:
        """Write a journal; slow for large designs, and safe in a worker thread.

        Raises:
            OSError: The journal cannot be written; `next_snapshot` returns it again.
        """
        try:
            self._write(snapshot)
        except OSError:
            self._seen.pop((snapshot.project, snapshot.component), None)
            raise

    def recoverable(self, project: Path) -> tuple[RecoverableDesign, ...]:
        """The newest unsaved work on each design of a project, sorted by component."""
        wanted, found = str(project.resolve()), dict[str, RecoverableDesign]()
        for journal in self._orphaned_journals():
            lost = _read(journal, wanted)
            if lost is not None and lost.at_s >= (found[lost.component].at_s if lost.component in found else 0):
                found[lost.component] = lost
        return tuple(found[name] for name in sorted(found))

    def discard(self, lost: RecoverableDesign) -> None:
        """Remove a journal after its work was recovered or discarded."""
        lost.journal.unlink(missing_ok=True)
        self._remove_if_empty(lost.journal.parent)

    def close(self) -> None:
        """Release the lock; journals of unsaved designs stay for recovery."""
        self._lock.release()
        self._remove_if_empty(self._own_folder)

    def _write(self, snapshot: JournalSnapshot) -> None:
        file = self._own_folder / _name(snapshot.project, snapshot.component)
        if snapshot.design is None:
            file.unlink(missing_ok=True)
            return
        try:
            text = save_design(snapshot.design, snapshot.base_text)
        except ValueError:
            # Duplicate names cannot be saved: the journal keeps its last content until the user fixes them.
            return
        content = {
            "project": str(snapshot.project.resolve()),
            "component": snapshot.component,
            "at": snapshot.at_s,
            "base": snapshot.base_text,
            "text": text,
        }
        write_atomically(file, json.dumps(content))

    def _orphaned_journals(self) -> list[Path]:
        """The journals in folders that no running server has locked."""
        journals: list[Path] = []
        for folder in (self.folder / "unsaved").iterdir():
            if folder != self._own_folder and _is_abandoned(folder):
                self._remove_if_empty(folder)
                journals += folder.glob("*.json")
        return journals[:_MAX_JOURNALS]

    def _remove_if_empty(self, folder: Path) -> None:
        if not any(folder.glob("*.json")):
            shutil.rmtree(folder, ignore_errors=True)


def _name(project: Path, component: str) -> str:
    key = f"{project.resolve()}\n{component}".encode()
    return f"{hashlib.sha256(key).hexdigest()[:32]}.json"


def _is_abandoned(folder: Path) -> bool:
    with contextlib.suppress(OSError):
        lock = take_lock(folder / "lock")
        if lock is not None:
            lock.release()
            return True
    return False


def _read(journal: Path, project: str) -> RecoverableDesign | None:
    """The work in a journal; None if it belongs to another project or is damaged."""
    try:
        if journal.stat().st_size > _MAX_JOURNAL_BYTES:
            return None
        content = json.loads(journal.read_text(encoding="utf-8"))
        if content["project"] != project:
            return None
        texts = {name: str(content[name]) for name in ("component", "base", "text")}
        at_s = float(content["at"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return RecoverableDesign(
        journal=journal, component=texts["component"], at_s=at_s, base_text=texts["base"], text=texts["text"]
    )
