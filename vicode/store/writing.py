"""Writes the files of a project so that a crash leaves the old text or the new one, never a half."""

import errno
import os
from pathlib import Path

from vicode.output import write_atomically


def write_text(path: Path, text: str) -> None:
    """Replace a file in one step and see it safely on the disk; links are followed, the mode is kept.

    Raises:
        OSError: The folder cannot be written, or the file is read-only; the old file is as it was.
    """
    if is_read_only(path):
        # It could be replaced all the same, as only the folder must be writable for that.
        raise PermissionError(errno.EACCES, "the file is read-only", str(path))
    write_atomically(path, text)
    folder = os.open(path.resolve().parent, os.O_RDONLY)
    try:
        # The new name is safe only when the folder that holds it is.
        os.fsync(folder)
    finally:
        os.close(folder)


def is_read_only(path: Path) -> bool:
    """Whether there is a file that nobody is meant to change."""
    return path.is_file() and not path.stat().st_mode & 0o222
