"""Files to write: compared with a folder (new, changed, unchanged, stale), and written so that none is ever half."""

import os
import secrets
import shutil
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import unified_diff
from enum import StrEnum
from pathlib import Path


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputFile:
    """A file to be: `path` is relative, with slashes."""

    path: str
    text: str


class FileStatus(StrEnum):
    """What a folder has to say to a file that should be in it."""

    NEW = "new"
    CHANGED = "changed"
    UNCHANGED = "unchanged"
    STALE = "stale"


@dataclass(frozen=True, slots=True, kw_only=True)
class FileDiff:
    """One file in a folder: `old` as it is on disk, `new` as it should be; None where there is none."""

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
    """Every file against the folder, by path.

    Args:
        files: What should be there.
        folder: Where to look; it need not exist.
        is_ours: Whether a text that stands beside the files was generated, so that it is stale.
        keep: Further paths that are not stale, though this time nothing is written to them.
    """
    wanted = {file.path: file.text for file in files}
    kept = {*wanted, *kept_paths}
    differences = [_compare_one(path, text, _read(folder / path)) for path, text in wanted.items()]
    for path in _list_sibling_sources(kept, folder):
        old = _read(folder / path)
        if path not in kept and old is not None and is_generated(old):
            differences.append(FileDiff(path=path, status=FileStatus.STALE, old=old, new=None))
    return tuple(sorted(differences, key=lambda difference: difference.path))


def apply_diffs(differences: Iterable[FileDiff], folder: Path) -> tuple[Path, ...]:
    """Write what is new or changed, delete what is stale; returns the touched files."""
    touched = []
    for difference in differences:
        path = folder / difference.path
        if difference.status is FileStatus.UNCHANGED:
            continue
        touched.append(path)
        if difference.new is None:
            path.unlink()
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, difference.new)
    return tuple(touched)


def back_up_edited(path: Path) -> Path:
    """Copy a file to NAME.edited beside it, or NAME.edited2 … where that is taken; returns the copy."""
    number = 1
    while (copy := path.with_name(f"{path.name}.edited{number if number > 1 else ''}")).exists():
        number += 1
    shutil.copy2(path, copy)
    return copy


def format_diff(difference: FileDiff) -> str:
    """The change as a unified diff."""
    old, new = difference.old or "", difference.new or ""
    before = f"a/{difference.path}" if difference.old is not None else "/dev/null"
    after = f"b/{difference.path}" if difference.new is not None else "/dev/null"
    return "".join(unified_diff(old.splitlines(keepends=True), new.splitlines(keepends=True), before, after))


def write_atomically(path: Path, content: str | bytes, *, is_durable: bool = True) -> None:
    """Replace a file in one step: a reader, or a crash in the middle, sees the old content or the new one.

    With `is_durable` the new one also outlives a loss of power right after; what can be made again need not wait for that.

    Raises:
        OSError: It cannot be written; the error names this file, which is as it was.
    """
    target = path.resolve()
    temporary = target.with_name(f".{target.name}.{secrets.token_hex(4)}.tmp")
    try:
        _write_new(temporary, content.encode("utf-8") if isinstance(content, str) else content, is_durable=is_durable)
        if target.exists():
            temporary.chmod(target.stat().st_mode & 0o777)
        temporary.replace(target)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _write_new(file: Path, content: bytes, *, is_durable: bool) -> None:
    descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    with os.fdopen(descriptor, "wb") as stream:
        stream.write(content)
        stream.flush()
        if is_durable:
            os.fsync(stream.fileno())


def _compare_one(path: str, new: str, old: str | None) -> FileDiff:
    if old is None:
        return FileDiff(path=path, status=FileStatus.NEW, old=None, new=new)
    status = FileStatus.UNCHANGED if old == new else FileStatus.CHANGED
    return FileDiff(path=path, status=status, old=old, new=new)


def _read(path: Path) -> str | None:
    """The text with plain line ends; None when there is no such file. Bytes that are no UTF-8 are shown as such."""
    try:
        return path.read_text(encoding="utf-8", errors="backslashreplace")
    except (FileNotFoundError, IsADirectoryError, NotADirectoryError):
        return None


def _list_sibling_sources(paths: Iterable[str], folder: Path) -> list[str]:
    """Source files in the folders that hold `paths`, and below them."""
    packages = sorted({path.rsplit("/", 1)[0] for path in paths if "/" in path})
    suffixes = {Path(path).suffix for path in paths}
    found = {
        file.relative_to(folder).as_posix()
        for package in packages
        for file in (folder / package).rglob("*")
        if file.suffix in suffixes and file.is_file()
    }
    return sorted(found)
