"""Replaces several files as one: after a crash, the next command completes the replacement or drops it.

The new texts are written to `.vicode/pending` in the root folder, then a journal that lists their targets. Then
they are moved. A file that another program has changed meanwhile keeps its new content, also if that is days after a
crash.
"""

import contextlib
import errno
import json
import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from hashlib import sha256
from pathlib import Path

from vicode.output import resolve_below, write_atomically
from vicode.platform import take_lock

STATE_FOLDER = ".vicode"
"""Folder of vicode's own files in a root folder; git ignores it."""

_PENDING = "pending"
_JOURNAL = "journal.json"
_BEFORE = "before.json"
"""The hashes of the files that are replaced."""


def replace_files(
    root: Path,
    texts: Mapping[str, str | bytes | None],
    *,
    prepare: Callable[[], AbstractContextManager[object]] = contextlib.nullcontext,
) -> None:
    """Write or delete (None) files below a folder, all of them or none; symbolic links in the folder are followed.

    Args:
        root: The folder; it is created.
        texts: The new texts, or contents, by path relative to `root`.
        prepare: Returns a context that is entered when only the moves are left, and sees an exception if these do not
            happen. It raises an `OSError` if the files must not be replaced.

    Raises:
        OSError: A file cannot be written, or is outside of the folder; the error names it, and all files are unchanged.
            Or another program changed a file in the last moment; the error names it, and only this file is unchanged.
    """
    targets = {path: resolve_below(root, path) for path in texts}
    with _lock(root) as state:
        _complete_found(root, state)
        pending = state / _PENDING
        try:
            journal = _write_pending(pending, texts, targets)
            for target, text in zip(targets.values(), texts.values(), strict=True):
                if text is not None:
                    _require_writable(target)
            before = {path: _hash(target) for path, target in targets.items()}
            write_atomically(pending / _BEFORE, json.dumps(before))
            with prepare():
                write_atomically(pending / _JOURNAL, json.dumps(journal))
        except BaseException:
            shutil.rmtree(pending, ignore_errors=True)
            raise
        changed = _complete(state, journal, targets, before)
    if changed:
        raise OSError(errno.EAGAIN, "it was changed at the same time; run the command again", str(root / changed[0]))


def is_interrupted(root: Path) -> bool:
    """Whether a killed program left a replacement below a folder."""
    return (root / STATE_FOLDER / _PENDING).is_dir()


def complete_interrupted(root: Path) -> None:
    """Complete the replacement that a killed program began below a folder, or drop what it had only prepared."""
    if is_interrupted(root):
        with _lock(root) as state:
            _complete_found(root, state)


@contextlib.contextmanager
def _lock(root: Path) -> Iterator[Path]:
    """The state folder, which only one program changes at a time."""
    state = root / STATE_FOLDER
    if state.is_symlink():
        raise OSError(errno.ELOOP, "expected a folder, found a symbolic link; delete it", str(state))
    if not state.is_dir():
        state.mkdir(parents=True)
        write_atomically(state / ".gitignore", "*\n", is_durable=False)
    lock = None
    # Some network file systems have no locks.
    with contextlib.suppress(OSError):
        lock = take_lock(state / "lock", timeout_s=-1)
    try:
        yield state
    finally:
        if lock is not None:
            lock.release()


def _write_pending(
    pending: Path, texts: Mapping[str, str | bytes | None], targets: Mapping[str, Path]
) -> dict[str, str | None]:
    """Write the new texts; return the journal: the names in `pending` (None to delete) by path."""
    pending.mkdir()
    journal: dict[str, str | None] = {}
    for number, (path, text) in enumerate(texts.items()):
        journal[path] = None if text is None else str(number)
        if text is not None:
            file = pending / str(number)
            write_atomically(file, text)
            if targets[path].exists():
                file.chmod(targets[path].stat().st_mode & 0o777)
    return journal


def _complete_found(root: Path, state: Path) -> None:
    """Complete what another program left, perhaps one of a stranger: nothing outside of the folder is touched.

    Raises:
        OSError: The journal is not one of vicode.
    """
    pending = state / _PENDING
    if pending.is_symlink():
        raise OSError(errno.ELOOP, "expected a folder, found a symbolic link; delete it", str(pending))
    journal = _read_journal(pending)
    targets = {path: (root / path).resolve() for path in journal}
    for path, target in targets.items():
        if not target.is_relative_to(root.resolve()) or ".git" in path.casefold().split("/"):
            raise PermissionError(
                errno.EACCES, f"{pending} would replace it, outside of {root}; delete that folder", path
            )
    _complete(state, journal, targets, _read_hashes(pending))


def _read_hashes(pending: Path) -> dict[str, object]:
    try:
        hashes = json.loads((pending / _BEFORE).read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return hashes if isinstance(hashes, dict) else {}


def _read_journal(pending: Path) -> dict[str, str | None]:
    file = pending / _JOURNAL
    if not file.is_file():
        return {}
    try:
        journal = json.loads(file.read_text("utf-8"))
    except (ValueError, RecursionError):
        journal = None
    if not isinstance(journal, dict) or not all(
        "\0" not in path and (name is None or (isinstance(name, str) and name.isdecimal()))
        for path, name in journal.items()
    ):
        raise OSError(errno.EINVAL, f"it is no journal of vicode; delete {pending}", str(file))
    return journal


def _complete(
    state: Path, journal: Mapping[str, str | None], targets: Mapping[str, Path], before: Mapping[str, object]
) -> list[str]:
    """Move the files; return the paths of those that another program wrote at the same time, which are kept."""
    pending = state / _PENDING
    changed = []
    for path, name in journal.items():
        source = None if name is None else pending / name
        # Without a source, the file was moved before a crash.
        is_due = source is None or source.exists()
        if is_due and path in before and _hash(targets[path]) != before[path]:
            changed.append(path)
        else:
            _move(source, targets[path])
    if pending.is_dir():
        # The journal goes first: without it, the rest means nothing.
        (pending / _JOURNAL).unlink(missing_ok=True)
        shutil.rmtree(pending)
    return changed


def _hash(file: Path) -> str | None:
    """A hash of the content; None if there is no regular file."""
    return sha256(file.read_bytes()).hexdigest() if file.is_file() else None


def _move(source: Path | None, target: Path) -> None:
    if source is None:
        target.unlink(missing_ok=True)
    elif source.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            source.replace(target)
        except OSError as error:
            if error.errno != errno.EXDEV:
                raise
            write_atomically(target, source.read_bytes())


def _require_writable(target: Path) -> None:
    """Raise an error that names the obstacle, before anything is moved."""
    for folder in target.parents:
        if folder.is_dir():
            if not os.access(folder, os.W_OK):
                raise PermissionError(errno.EACCES, "its folder is read-only", str(target))
            break
        if folder.exists():
            raise NotADirectoryError(errno.ENOTDIR, "expected a folder, found a file", str(folder))
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "expected a file, found a folder", str(target))
