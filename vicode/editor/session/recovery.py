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

from vicode.editor.session.document import Sheet
from vicode.model.design import Design
from vicode.output import write_atomically
from vicode.store import save_design

STATE = "VICODE_STATE"
_AUTOSAVED = "autosaved"
_LARGEST_BYTES = 20_000_000
_MOST_JOURNALS = 200


def state_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where the editor keeps what outlives it: VICODE_STATE, else `vicode` in the user's state folder."""
    given = environment.get(STATE)
    if given:
        return Path(given)
    home = environment.get("XDG_STATE_HOME")
    return (Path(home) if home else Path.home() / ".local" / "state") / "vicode"


def open_recovery() -> "Recovery":
    """The journals in the state folder; in one for temporary files where nothing else can be written."""
    try:
        return Recovery(state_folder())
    except OSError:
        return Recovery(Path(tempfile.gettempdir()) / f"vicode-state-{os.getuid()}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Lost:
    """Unsaved work that a server left behind: `base_text` is what its file held, `text` what the design became."""

    journal: Path
    component: str
    at_s: float
    base_text: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """What is to be written into a journal; no design: nothing is unsaved any more."""

    project: Path
    component: str
    at_s: float
    base_text: str
    design: Design | None


@dataclass(eq=False)
class Recovery:
    """The journals of this server, and those that servers left which are gone."""

    folder: Path
    _own: Path = field(init=False)
    _lock: TextIO = field(init=False)
    _seen: dict[tuple[Path, str], tuple[Design, str]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Make a folder for this server; it is known to be alive by the lock that it holds.

        Raises:
            OSError: Nothing can be written there.
        """
        self._own = self.folder / "unsaved" / secrets.token_hex(8)
        self._own.mkdir(parents=True, mode=0o700)
        self._lock = (self._own / "lock").open("w")
        fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def due(self, project: Path, component: str, sheet: Sheet) -> Snapshot | None:
        """What a journal must be told of a design, None when it knows."""
        design, key = sheet.history.present.design, (project, component)
        is_saved = design == sheet.saved
        last = self._seen.get(key)
        if (last is None and is_saved) or last == (design, sheet.disk_text):
            return None
        self._seen[key] = (design, sheet.disk_text)
        if is_saved:
            del self._seen[key]
        wanted = None if is_saved else design
        at_s = sheet.history.present.at_s
        return Snapshot(project=project, component=component, at_s=at_s, base_text=sheet.disk_text, design=wanted)

    def write(self, snapshot: Snapshot) -> None:
        """Bring a journal up to date; slow for large designs, and safe beside the event loop.

        Raises:
            OSError: It cannot be written; it is due again then.
        """
        try:
            self._write(snapshot)
        except OSError:
            self._seen.pop((snapshot.project, snapshot.component), None)
            raise

    def lost(self, project: Path) -> tuple[Lost, ...]:
        """The unsaved work on a project that was left behind, the newest of each design, by component."""
        wanted, found = str(project.resolve()), dict[str, Lost]()
        for journal in self._left_behind():
            lost = _read(journal, wanted)
            if lost is not None and lost.at_s >= (found[lost.component].at_s if lost.component in found else 0):
                found[lost.component] = lost
        return tuple(found[name] for name in sorted(found))

    def forget(self, lost: Lost) -> None:
        """Give up what was recovered or discarded."""
        lost.journal.unlink(missing_ok=True)
        self._tidy(lost.journal.parent)

    def close(self) -> None:
        """End in order: what is still unsaved stays to be recovered."""
        self._lock.close()
        self._tidy(self._own)

    @property
    def saving_by_themselves(self) -> frozenset[str]:
        """The projects that are saved by themselves, as they were noted last."""
        try:
            return frozenset((self.folder / _AUTOSAVED).read_text(encoding="utf-8").splitlines())
        except (OSError, UnicodeDecodeError):
            return frozenset()

    def note_autosave(self, project: Path, *, is_on: bool) -> None:
        """Note for the next servers whether a project is saved by itself.

        Raises:
            OSError: It cannot be written.
        """
        own = frozenset({str(project.resolve())})
        known = self.saving_by_themselves
        noted = known | own if is_on else known - own
        write_atomically(self.folder / _AUTOSAVED, "".join(f"{each}\n" for each in sorted(noted)))

    def _write(self, snapshot: Snapshot) -> None:
        file = self._own / _name(snapshot.project, snapshot.component)
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

    def _left_behind(self) -> list[Path]:
        """The journals in folders that no living server holds."""
        journals: list[Path] = []
        for folder in (self.folder / "unsaved").iterdir():
            if folder != self._own and _is_abandoned(folder):
                self._tidy(folder)
                journals += folder.glob("*.json")
        return journals[:_MOST_JOURNALS]

    def _tidy(self, folder: Path) -> None:
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


def _read(journal: Path, project: str) -> Lost | None:
    """The work in a journal of a project; None for one of another, and for a file that is none."""
    try:
        if journal.stat().st_size > _LARGEST_BYTES:
            return None
        said = json.loads(journal.read_text(encoding="utf-8"))
        if said["project"] != project:
            return None
        texts = {name: str(said[name]) for name in ("component", "base", "text")}
        at_s = float(said["at"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return Lost(journal=journal, component=texts["component"], at_s=at_s, base_text=texts["base"], text=texts["text"])
