"""Unsaved work that outlives a killed server: a journal a design, outside the project, offered at the next start."""

import contextlib
import fcntl
import hashlib
import json
import os
import secrets
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from vicode.editor.session.document import SharedDocument
from vicode.model.design import Design
from vicode.output import write_atomically
from vicode.store import save_design

STATE_VARIABLE = "VICODE_STATE"
_AUTOSAVED = "autosaved"
_MAX_JOURNAL_BYTES = 20_000_000
_MAX_JOURNALS = 200


def state_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where the editor keeps what outlives it: VICODE_STATE, else `vicode` in the user's state folder."""
    given = environment.get(STATE_VARIABLE)
    if given:
        return Path(given)
    home = environment.get("XDG_STATE_HOME")
    return (Path(home) if home else Path.home() / ".local" / "state") / "vicode"


def open_recovery_store() -> "RecoveryStore":
    """The journals in the state folder; in one for temporary files where nothing else can be written."""
    try:
        return RecoveryStore(state_folder())
    except OSError:
        return RecoveryStore(Path(tempfile.gettempdir()) / f"vicode-state-{os.getuid()}")


@dataclass(frozen=True, slots=True, kw_only=True)
class RecoverableDesign:
    """Unsaved work that a server left behind: `base_text` is what its file held, `text` what the design became."""

    journal: Path
    component: str
    at_s: float
    base_text: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class JournalSnapshot:
    """What is to be written into a journal; no design: nothing is unsaved any more."""

    project: Path
    component: str
    at_s: float
    base_text: str
    design: Design | None


@dataclass(eq=False)
class RecoveryStore:
    """The journals of this server, and those that servers left which are gone."""

    folder: Path
    _own_folder: Path = field(init=False)
    _lock: TextIO = field(init=False)
    _seen: dict[tuple[Path, str], tuple[Design, str]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Make a folder for this server; it is known to be alive by the lock that it holds.

        Raises:
            OSError: Nothing can be written there.
        """
        self._own_folder = self.folder / "unsaved" / secrets.token_hex(8)
        self._own_folder.mkdir(parents=True, mode=0o700)
        self._lock = (self._own_folder / "lock").open("w")
        fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def next_snapshot(self, project: Path, component: str, sheet: SharedDocument) -> JournalSnapshot | None:
        """What a journal must be told of a design, None when it knows."""
        design, key = sheet.history.current.design, (project, component)
        is_saved = design == sheet.saved
        last = self._seen.get(key)
        if (last is None and is_saved) or last == (design, sheet.disk_text):
            return None
        self._seen[key] = (design, sheet.disk_text)
        if is_saved:
            del self._seen[key]
        wanted = None if is_saved else design
        at_s = sheet.history.current.at_s
        return JournalSnapshot(
            project=project, component=component, at_s=at_s, base_text=sheet.disk_text, design=wanted
        )

    def write(self, snapshot: JournalSnapshot) -> None:
        """Bring a journal up to date; slow for large designs, and safe beside the event loop.

        Raises:
            OSError: It cannot be written; it is due again then.
        """
        try:
            self._write(snapshot)
        except OSError:
            self._seen.pop((snapshot.project, snapshot.component), None)
            raise

    def recoverable(self, project: Path) -> tuple[RecoverableDesign, ...]:
        """The unsaved work on a project that was left behind, the newest of each design, by component."""
        wanted, found = str(project.resolve()), dict[str, RecoverableDesign]()
        for journal in self._orphaned_journals():
            lost = _read(journal, wanted)
            if lost is not None and lost.at_s >= (found[lost.component].at_s if lost.component in found else 0):
                found[lost.component] = lost
        return tuple(found[name] for name in sorted(found))

    def discard(self, lost: RecoverableDesign) -> None:
        """Give up what was recovered or discarded."""
        lost.journal.unlink(missing_ok=True)
        self._remove_if_empty(lost.journal.parent)

    def close(self) -> None:
        """End in order: what is still unsaved stays to be recovered."""
        self._lock.close()
        self._remove_if_empty(self._own_folder)

    @property
    def autosaved_projects(self) -> frozenset[str]:
        """The projects that are saved by themselves, as they were noted last."""
        try:
            return frozenset((self.folder / _AUTOSAVED).read_text(encoding="utf-8").splitlines())
        except (OSError, UnicodeDecodeError):
            return frozenset()

    def set_autosave(self, project: Path, *, is_on: bool) -> None:
        """Note for the next servers whether a project is saved by itself.

        Raises:
            OSError: It cannot be written.
        """
        own = frozenset({str(project.resolve())})
        known = self.autosaved_projects
        noted = known | own if is_on else known - own
        write_atomically(self.folder / _AUTOSAVED, "".join(f"{each}\n" for each in sorted(noted)))

    def _write(self, snapshot: JournalSnapshot) -> None:
        file = self._own_folder / _name(snapshot.project, snapshot.component)
        if snapshot.design is None:
            file.unlink(missing_ok=True)
            return
        try:
            text = save_design(snapshot.design, snapshot.base_text)
        except ValueError:
            # Two things of one name, which no file can hold: the journal keeps what it had until that is mended.
            return
        said = {
            "project": str(snapshot.project.resolve()),
            "component": snapshot.component,
            "at": snapshot.at_s,
            "base": snapshot.base_text,
            "text": text,
        }
        write_atomically(file, json.dumps(said))

    def _orphaned_journals(self) -> list[Path]:
        """The journals in folders that no living server holds."""
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
    with contextlib.suppress(OSError), (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    return False


def _read(journal: Path, project: str) -> RecoverableDesign | None:
    """The work in a journal of a project; None for one of another, and for a file that is none."""
    try:
        if journal.stat().st_size > _MAX_JOURNAL_BYTES:
            return None
        said = json.loads(journal.read_text(encoding="utf-8"))
        if said["project"] != project:
            return None
        texts = {name: str(said[name]) for name in ("component", "base", "text")}
        at_s = float(said["at"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return RecoverableDesign(
        journal=journal, component=texts["component"], at_s=at_s, base_text=texts["base"], text=texts["text"]
    )
