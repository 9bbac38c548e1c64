"""Writes project files atomically and durably."""

import contextlib
import errno
import fcntl
import os
import time
from collections.abc import Iterator
from pathlib import Path

from vicode.output import write_atomically

_LOCK_TIMEOUT_S = 2.0


class FileChangedError(OSError):
    """Another program has changed the file since it was read."""


def replace_text(path: Path, old: str | None, new: str) -> None:
    """Write a file if it still has the text `old` (None: it does not exist), under a lock that all editors take.

    Raises:
        FileChangedError: The file has another text.
        OSError: The file cannot be written; the old file is unchanged.
    """
    with _lock_folder(path.resolve().parent):
        try:
            now = path.read_bytes()
        except FileNotFoundError:
            now = None
        if now != (None if old is None else old.encode("utf-8")):
            raise FileChangedError(errno.EAGAIN, "another program has changed the file", str(path))
        write_text(path, new)


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


@contextlib.contextmanager
def _lock_folder(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which needs no file in it; without a lock if the file system has none."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        deadline_s = time.monotonic() + _LOCK_TIMEOUT_S
        while not _try_lock(descriptor) and time.monotonic() < deadline_s:
            time.sleep(0.001)
        yield
    finally:
        os.close(descriptor)


def _try_lock(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        # Some network file systems have no locks.
        return True
    return True


def is_read_only(path: Path) -> bool:
    """Whether the file exists and this user must not write to it."""
    return path.is_file() and not (path.stat().st_mode & 0o222 and _may_write(path))


def _may_write(path: Path) -> bool:
    return not path.exists() or os.access(path, os.W_OK, effective_ids=os.access in os.supports_effective_ids)
