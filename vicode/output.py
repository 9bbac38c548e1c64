"""Output files: compares them with a folder and writes them atomically."""

import errno
import fcntl
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from difflib import unified_diff
from enum import StrEnum
from hashlib import sha256
from pathlib import Path

CACHE_VARIABLE = "VICODE_CACHE"
_TEMPORARY = re.compile(r"\..+\.[0-9a-f]{8}\.tmp")
_TEMPORARY_FOLDER = re.compile(r"vicode-[a-z]+-\w+\.tmp")
_MIN_AGE_S = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputFile:
    """A file to write; `path` is relative and separated by slashes; `component` is "" for shared files."""

    path: str
    text: str
    component: str = ""


def cache_path(out: Path, kind: str, environment: Mapping[str, str] = os.environ) -> Path:
    """The path of a JSON file about an output folder; it is outside that folder, because readers do not need it."""
    given, home = environment.get(CACHE_VARIABLE), environment.get("XDG_CACHE_HOME")
    folder = Path(given) if given else (Path(home) if home else Path.home() / ".cache") / "vicode"
    name = sha256(str(out.resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    return folder / kind / f"{name}.json"


class FileStatus(StrEnum):
    """The status of an output file relative to the folder."""

    NEW = "new"
    CHANGED = "changed"
    UNCHANGED = "unchanged"
    STALE = "stale"


@dataclass(frozen=True, slots=True, kw_only=True)
class FileDiff:
    """The texts of a file on disk (`old`) and in the output (`new`); None if it does not exist there."""

    path: str
    status: FileStatus
    old: str | None
    new: str | None


def compare_files(
    files: Iterable[OutputFile],
    folder: Path,
    *,
    kept_paths: Iterable[str] = (),
    is_generated: Callable[[str], bool] = lambda _text: False,
) -> tuple[FileDiff, ...]:
    """Compare output files with a folder; the result is sorted by path.

    Args:
        files: The output files.
        folder: The folder, which need not exist.
        kept_paths: Paths of further files that are not stale.
        is_generated: Whether the text of an existing file is generated: such a file is stale if it is not in `files`.
    """
    texts = {file.path: file.text for file in files}
    kept = {*texts, *kept_paths}
    differences = [_compare_one(path, text, _read(folder / path)) for path, text in texts.items()]
    for path in _list_sibling_sources(kept, folder):
        old = _read(folder / path)
        if path not in kept and old is not None and is_generated(old):
            differences.append(FileDiff(path=path, status=FileStatus.STALE, old=old, new=None))
    return tuple(sorted(differences, key=lambda difference: difference.path))


def require_unchanged(differences: Iterable[FileDiff], folder: Path) -> None:
    """Require that files still have their `old` texts.

    Raises:
        OSError: A file has changed since it was compared.
    """
    for difference in differences:
        path = folder / difference.path
        if _read(path) != difference.old:
            raise OSError(errno.EAGAIN, "it was changed at the same time; run the command again", str(path))


def apply_diffs(differences: Iterable[FileDiff], folder: Path) -> tuple[Path, ...]:
    """Write new and changed files and delete stale ones; returns the paths of these files."""
    written = []
    for difference in differences:
        if difference.status is FileStatus.UNCHANGED:
            continue
        written.append(folder / difference.path)
        path = resolve_below(folder, difference.path)
        if difference.new is None:
            written[-1].unlink()
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, difference.new)
    return tuple(written)


def back_up_edited(path: Path) -> Path:
    """Copy a file to NAME.edited in its folder, or to NAME.edited2 … if that exists; returns the path of the copy."""
    number = 1
    while os.path.lexists(copy := path.with_name(f"{path.name}.edited{number if number > 1 else ''}")):
        number += 1
    shutil.copy2(path, copy)
    return copy


def format_diff(difference: FileDiff) -> str:
    old, new = difference.old or "", difference.new or ""
    before = f"a/{difference.path}" if difference.old is not None else "/dev/null"
    after = f"b/{difference.path}" if difference.new is not None else "/dev/null"
    return "".join(unified_diff(old.splitlines(keepends=True), new.splitlines(keepends=True), before, after))


def resolve_below(folder: Path, path: str | Path) -> Path:
    """The target of a path below a folder: symbolic links are followed, but not out of the folder.

    Raises:
        PermissionError: The path is outside of the folder, or a link leads out of it.
    """
    target = (folder / path).resolve()
    if not target.is_relative_to(folder.resolve()):
        raise PermissionError(errno.EACCES, f"it is outside of {folder}, or a link out of it", str(path))
    return target


def write_atomically(
    path: Path,
    content: str | bytes,
    *,
    is_durable: bool = True,
    replace: Callable[[Path, Path], object] = Path.replace,
) -> None:
    """Replace a file atomically: after a crash it has either the old or the new content.

    A durable write also removes what killed programs left in the folder.

    Args:
        path: The file; symbolic links to existing files are followed.
        content: The new content.
        is_durable: Whether to flush the content to the disk, so that it also survives a power failure.
        replace: Moves the new file to the place of the old one; it may raise an `OSError` that names `path` instead.

    Raises:
        OSError: The file cannot be written; the error names `path`, which is unchanged.
    """
    target = path.resolve()
    if path.is_symlink() and not target.exists():
        # In a folder of a stranger, the file would be anywhere.
        raise OSError(errno.ELOOP, "it is a link to a file that does not exist; delete it", str(path))
    temporary = target.with_name(f".{target.name}.{os.urandom(4).hex()}.tmp")
    try:
        with _write_new(temporary, content.encode("utf-8") if isinstance(content, str) else content, is_durable):
            if target.exists():
                temporary.chmod(target.stat().st_mode & 0o777)
            replace(temporary, target)
        if is_durable:
            remove_leftovers(target.parent)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        if error.errno is None or error.filename == str(path):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


@contextmanager
def _write_new(file: Path, content: bytes, is_durable: bool) -> Iterator[None]:
    """Write a file; while it is open, its lock keeps `remove_leftovers` from removing it."""
    descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    with os.fdopen(descriptor, "wb") as stream:
        with suppress(OSError):
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        stream.write(content)
        stream.flush()
        if is_durable:
            os.fsync(stream.fileno())
        yield


def remove_leftovers(folder: Path) -> None:
    """Remove the temporary files in a folder that killed programs left."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(".tmp") and _TEMPORARY.fullmatch(entry.name) and entry.is_file():
                with suppress(OSError), _locked(entry.path):
                    Path(entry).unlink()


@contextmanager
def temporary_folder(kind: str) -> Iterator[Path]:
    """Make a folder for the time of the context; if the program is killed, a later one removes it."""
    _remove_abandoned(Path(tempfile.gettempdir()))
    with tempfile.TemporaryDirectory(prefix=f"vicode-{kind}-", suffix=".tmp") as name, _locked(name, is_required=False):
        yield Path(name)


def _remove_abandoned(place: Path) -> None:
    with suppress(OSError), os.scandir(place) as entries:
        for entry in entries:
            if not _TEMPORARY_FOLDER.fullmatch(entry.name) or not entry.is_dir(follow_symlinks=False):
                continue
            status = entry.stat(follow_symlinks=False)
            # One that was just made may not be locked yet.
            if status.st_uid == os.geteuid() and time.time() - status.st_mtime > _MIN_AGE_S:
                with suppress(OSError), _locked(entry.path):
                    shutil.rmtree(entry.path)


@contextmanager
def _locked(path: str, *, is_required: bool = True) -> Iterator[None]:
    """Lock a file or folder.

    Raises:
        OSError: It is locked, or the file system has no locks; only if the lock is required.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    try:
        with nullcontext() if is_required else suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    finally:
        os.close(descriptor)


def _compare_one(path: str, new: str, old: str | None) -> FileDiff:
    if old is None:
        return FileDiff(path=path, status=FileStatus.NEW, old=None, new=new)
    status = FileStatus.UNCHANGED if old == new else FileStatus.CHANGED
    return FileDiff(path=path, status=status, old=old, new=new)


def _read(path: Path) -> str | None:
    """The text with line feeds as line breaks, None if the file does not exist. Invalid UTF-8 bytes are escaped.

    Raises:
        OSError: It cannot be read, or is a pipe or device, which might block.
    """
    try:
        mode = path.stat().st_mode
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            raise OSError(errno.EINVAL, "it is not a regular file", str(path))
        return path.read_text(encoding="utf-8", errors="backslashreplace")
    except (FileNotFoundError, IsADirectoryError, NotADirectoryError):
        return None


def _list_sibling_sources(paths: Iterable[str], folder: Path) -> list[str]:
    """Source files in and below the folders of `paths`."""
    packages = sorted({path.rsplit("/", 1)[0] for path in paths if "/" in path})
    suffixes = {Path(path).suffix for path in paths}
    siblings = {
        file.relative_to(folder).as_posix()
        for package in packages
        for file in (folder / package).rglob("*")
        if file.suffix in suffixes and file.is_file()
    }
    return sorted(siblings)
