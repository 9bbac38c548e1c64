"""Writes project files atomically and durably."""

import errno
import os
from pathlib import Path

from vicode.output import write_atomically


def write_text(path: Path, text: str) -> None:
    """Replace a file atomically and flush it to the disk; follows symbolic links and keeps the file mode.

    Raises:
        OSError: The file or its folder is read-only, or the disk is full; the old file is unchanged.
    """
    if is_read_only(path):
        # Replacing the file would succeed if its folder is writable.
        raise PermissionError(errno.EACCES, "the file is read-only", str(path))
    if not _may_write(path.resolve().parent):
        # The new file is written to the same folder first.
        raise PermissionError(errno.EACCES, "its folder is read-only", str(path))
    write_atomically(path, text)
    folder = os.open(path.resolve().parent, os.O_RDONLY)
    try:
        # The rename is durable only after the folder is flushed.
        os.fsync(folder)
    finally:
        os.close(folder)


def is_read_only(path: Path) -> bool:
    """Whether the file exists and this user must not write to it."""
    return path.is_file() and not (path.stat().st_mode & 0o222 and _may_write(path))


def _may_write(path: Path) -> bool:
    return not path.exists() or os.access(path, os.W_OK, effective_ids=os.access in os.supports_effective_ids)
