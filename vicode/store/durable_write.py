"""Writes the files of a project so that a crash leaves the old text or the new one, never a half."""

import errno
import os
from pathlib import Path

from vicode.output import write_atomically


def write_text(path: Path, text: str) -> None:
    """Replace a file in one step and see it safely on the disk; links are followed, the mode is kept.

    Raises:
        OSError: Its folder or the file is read-only, or the disk is full; the old file is as it was.
    """
    if is_read_only(path):
        # It could be replaced all the same, as only the folder must be writable for that.
        raise PermissionError(errno.EACCES, "the file is read-only", str(path))
    if not _may_write(path.resolve().parent):
        # A file is replaced by one that is written beside it.
        raise PermissionError(errno.EACCES, "its folder is read-only", str(path))
    write_atomically(path, text)
    folder = os.open(path.resolve().parent, os.O_RDONLY)
    try:
        # The new name is safe only when the folder that holds it is.
        os.fsync(folder)
    finally:
        os.close(folder)


def is_read_only(path: Path) -> bool:
    """Whether there is a file that nobody is meant to change, or not this user."""
    return path.is_file() and not (path.stat().st_mode & 0o222 and _may_write(path))


def _may_write(path: Path) -> bool:
    return not path.exists() or os.access(path, os.W_OK, effective_ids=os.access in os.supports_effective_ids)
