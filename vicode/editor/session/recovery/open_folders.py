"""Tells whether another editor has a project folder open, by locked files outside the project."""

import contextlib
import hashlib
import secrets
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.platform import take_lock

if TYPE_CHECKING:
    from filelock import BaseFileLock


@dataclass(eq=False)
class OpenFolders:
    """The folders that this editor has open; `folder` holds one locked file for each editor and open folder."""

    folder: Path
    _own: "dict[Path, BaseFileLock]" = field(init=False, default_factory=dict)

    def has_other_editor(self, project: Path) -> bool:
        """Mark a folder as open in this editor and return whether it is open in another one.

        Raises:
            OSError: `folder` cannot be written.
        """
        key = project.resolve()
        marks = self.folder / hashlib.sha256(str(key).encode()).hexdigest()[:32]
        own = self._own.get(key)
        if own is None or not Path(own.lock_file).exists():
            marks.mkdir(parents=True, exist_ok=True, mode=0o700)
            own = take_lock(marks / secrets.token_hex(8))
            assert own is not None
            self._own[key] = own
        return any(_is_held(mark) for mark in marks.iterdir() if str(mark) != own.lock_file)

    def close(self) -> None:
        """Mark all folders as closed."""
        for own in self._own.values():
            own.release()
            Path(own.lock_file).unlink(missing_ok=True)
        self._own.clear()


def _is_held(mark: Path) -> bool:
    """Whether a running editor holds a mark; marks of editors that were killed are removed."""
    if not mark.exists():
        return False
    lock = take_lock(mark)
    if lock is None:
        return True
    lock.release()
    with contextlib.suppress(OSError):
        mark.unlink()
    return False
