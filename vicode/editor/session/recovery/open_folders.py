"""Tells whether another editor has a project folder open, by locked files outside the project."""

import contextlib
import fcntl
import hashlib
import secrets
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO


@dataclass(eq=False)
class OpenFolders:
    """The folders that this editor has open; `folder` holds one locked file for each editor and open folder."""

    folder: Path
    _own: dict[Path, TextIO] = field(init=False, default_factory=dict)

    def has_other_editor(self, project: Path) -> bool:
        """Mark a folder as open in this editor and return whether it is open in another one.

        Raises:
            OSError: `folder` cannot be written.
        """
        key = project.resolve()
        marks = self.folder / hashlib.sha256(str(key).encode()).hexdigest()[:32]
        own = self._own.get(key)
        if own is None or not Path(own.name).exists():
            marks.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._own[key] = own = (marks / secrets.token_hex(8)).open("w", encoding="utf-8")
            fcntl.flock(own, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return any(_is_held(mark) for mark in marks.iterdir() if str(mark) != own.name)

    def close(self) -> None:
        """Mark all folders as closed."""
        for own in self._own.values():
            Path(own.name).unlink(missing_ok=True)
            own.close()
        self._own.clear()


def _is_held(mark: Path) -> bool:
    """Whether a running editor holds a mark; marks of editors that were killed are removed."""
    with contextlib.suppress(FileNotFoundError), mark.open("r+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        mark.unlink(missing_ok=True)
    return False
