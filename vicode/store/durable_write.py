"""Writes project files atomically and durably."""

import contextlib
import errno
import hashlib
import os
from collections.abc import Callable, Iterator
from pathlib import Path

from vicode.output import write_atomically
from vicode.platform import flush_folder, state_folder, take_lock

_LOCK_TIMEOUT_S = 2.0


class FileChangedError(OSError):
    """Another program has changed the file since it was read."""


def replace_text(path: Path, old: str | None, new: str) -> None:
    """Write a file if it still has the text `old` (None: it does not exist), under a lock that all editors take.

    Raises:
        FileChangedError: The file has another text.
        OSError: The file cannot be written; the old file is unchanged.
    """
    content = None if old is None else old.encode("utf-8")

    def replace(temporary: Path, target: Path) -> None:
        """Replace the file if it is unchanged. Writing the new one took a while, so it is compared only now."""
        if content is None and _create(temporary, target):
            return
        if not _has_content(path, content):
            raise _changed(path)
        temporary.replace(target)

    with _lock_folder(path.resolve().parent):
        if not _has_content(path, content):
            raise _changed(path)
        write_text(path, new, replace=replace)


def _changed(path: Path) -> FileChangedError:
    return FileChangedError(errno.EAGAIN, "another program has changed the file", str(path))


def _create(temporary: Path, target: Path) -> bool:
    """Move a new file to a place where there is none; return False if there is one, or no hard links."""
    try:
        os.link(temporary, target)
    except OSError:
        return False
    temporary.unlink()
    return True


def _has_content(path: Path, content: bytes | None) -> bool:
    """Whether a file has a content, also after it was read; None: it does not exist."""
    try:
        with path.open("rb") as stream:
            before = os.fstat(stream.fileno())
            return stream.read() == content and _identity(path.stat()) == _identity(before)
    except FileNotFoundError:
        return content is None


def _identity(status: os.stat_result) -> tuple[int, ...]:
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def write_text(path: Path, text: str, *, replace: Callable[[Path, Path], object] = Path.replace) -> None:
    """Replace a file atomically and flush it to the disk; follows symbolic links and keeps the file mode.

    `replace` is that of `write_atomically`.

    Raises:
        OSError: The file or its folder is read-only, or the disk is full; the old file is unchanged.
    """
    if is_read_only(path):
        # Replacing the file would succeed if its folder is writable.
        raise PermissionError(errno.EACCES, "the file is read-only", str(path))
    if not _may_write(path.resolve().parent):
        # The new file is written to the same folder first.
        raise PermissionError(errno.EACCES, "its folder is read-only", str(path))
    write_atomically(path, text, replace=replace)
    # The rename is durable only after the folder is flushed.
    flush_folder(path.resolve().parent)


@contextlib.contextmanager
def _lock_folder(folder: Path) -> Iterator[None]:
    """Hold the user's lock of a folder, which is no file in it; without a lock where there are none."""
    name, lock = hashlib.sha256(os.fsencode(folder)).hexdigest()[:32], None
    with contextlib.suppress(OSError):
        locks = state_folder() / "locks"
        locks.mkdir(parents=True, exist_ok=True, mode=0o700)
        lock = take_lock(locks / name, _LOCK_TIMEOUT_S)
    try:
        yield
    finally:
        if lock is not None:
            lock.release()


def is_read_only(path: Path) -> bool:
    """Whether the file exists and this user must not write to it."""
    return path.is_file() and not (path.stat().st_mode & 0o222 and _may_write(path))


def _may_write(path: Path) -> bool:
    return not path.exists() or os.access(path, os.W_OK, effective_ids=os.access in os.supports_effective_ids)
