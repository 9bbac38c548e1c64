"""Output files: compares them with a folder and writes them atomically."""

import errno
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from difflib import unified_diff
from enum import StrEnum
from hashlib import sha256
from pathlib import Path

from vicode.platform import cache_folder, is_running

_TEMPORARY = re.compile(r"\..+\.[0-9a-f]{8}\.tmp")
_TEMPORARY_FOLDER = re.compile(r"vicode-[a-z]+-(?P<process>\d{1,10})-\w+\.tmp")
_MIN_AGE_S = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputFile:
    """A file to write; `path` is relative and separated by slashes; `component` is "" for shared files."""

    path: str
    text: str
    component: str = ""


def cache_path(out: Path, kind: str) -> Path:
    """The path of a JSON file about an output folder; it is outside that folder, because readers do not need it."""
    name = sha256(str(out.resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    return cache_folder() / kind / f"{name}.json"


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
        _write_new(temporary, content.encode("utf-8") if isinstance(content, str) else content, is_durable)
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


def _write_new(file: Path, content: bytes, is_durable: bool) -> None:
    with file.open("xb") as stream:
        stream.write(content)
        stream.flush()
        if is_durable:
            os.fsync(stream.fileno())


def remove_leftovers(folder: Path) -> None:
    """Remove the temporary files in a folder that killed programs left more than a minute ago."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(".tmp") and _TEMPORARY.fullmatch(entry.name):
                with suppress(OSError):
                    _remove_if_old(entry)


def _remove_if_old(entry: "os.DirEntry[str]") -> None:
    if entry.is_file(follow_symlinks=False) and _is_old(entry.stat()):
        Path(entry).unlink()


def _is_old(status: os.stat_result) -> bool:
    return time.time() - status.st_mtime > _MIN_AGE_S


@contextmanager
def temporary_folder(kind: str) -> Iterator[Path]:
    """Make a folder for the time of the context; if the program is killed, a later one removes it."""
    with tempfile.TemporaryDirectory(prefix=f"vicode-{kind}-{os.getpid()}-", suffix=".tmp") as name:
        _remove_abandoned(Path(name))
        yield Path(name)


def _remove_abandoned(own: Path) -> None:
    """Remove the folders of this user beside `own` whose programs have ended."""
    user = own.stat().st_uid
    with suppress(OSError), os.scandir(own.parent) as entries:
        for entry in entries:
            found = _TEMPORARY_FOLDER.fullmatch(entry.name)
            if found is None or not entry.is_dir(follow_symlinks=False):
                continue
            status = entry.stat(follow_symlinks=False)
            if status.st_uid == user and _is_old(status) and not is_running(int(found["process"])):
                with suppress(OSError):
                    shutil.rmtree(entry.path)


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
    """Source files in and below the folders of `paths`, without those of a language, which projects share."""
    folders = sorted({path.rsplit("/", 1)[0] for path in paths if "/" in path})
    shared = {each.split("/")[0] for each in folders if "/" in each}
    packages = [each for each in folders if each not in shared]
    suffixes = {Path(path).suffix for path in paths}
    siblings = {
        file.relative_to(folder).as_posix()
        for package in packages
        for file in (folder / package).rglob("*")
        if file.suffix in suffixes and file.is_file()
    }
    return sorted(siblings)
