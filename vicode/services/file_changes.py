"""Waits for changes of files in folders, also when a folder is replaced."""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

from watchfiles import Change, watch

from vicode.services.project_loader import DESIGN_SUFFIXES, XABSL_SUFFIXES

_SUFFIXES = (*XABSL_SUFFIXES, *DESIGN_SUFFIXES)
# Editors write files in several steps.
_DEBOUNCE_STEP_MS, _MAX_DEBOUNCE_MS, _POLL_MS = 40, 400, 500


def iter_changes(folders: Sequence[Path], suffixes: Sequence[str] = _SUFFIXES) -> Iterator[None]:
    """Yield after each change of a file with one of the suffixes in these folders; stop when a folder is replaced."""

    def is_watched(_change: Change, path: str) -> bool:
        file = Path(path)
        return file.suffix in suffixes and not file.name.startswith(".")

    with ExitStack() as stack, suppress(FileNotFoundError):
        held = {folder: number for folder in folders if (number := _open_folder(folder, stack)) is not None}
        wanted = watch(
            *held,
            watch_filter=is_watched,
            step=_DEBOUNCE_STEP_MS,
            debounce=_MAX_DEBOUNCE_MS,
            rust_timeout=_POLL_MS,
            yield_on_timeout=True,
        )
        # Yield once at the start for changes before the watch began.
        is_first = True
        for changes in wanted:
            if changes or is_first:
                yield
            is_first = is_first and bool(changes)
            # A deleted folder reports no events, nor does its replacement.
            if held != {folder: number for folder in folders if (number := _folder_id(folder)) is not None}:
                return


def _open_folder(folder: Path, stack: ExitStack) -> tuple[int, int] | None:
    """The identity of a folder, which is opened: while it is open, no other folder gets the same inode."""
    # Windows cannot open folders.
    with suppress(OSError):
        if hasattr(os, "O_DIRECTORY"):
            stack.callback(os.close, os.open(folder, os.O_RDONLY))
    return _folder_id(folder)


def _folder_id(folder: Path) -> tuple[int, int] | None:
    with suppress(OSError):
        return _file_id(folder.stat())
    return None


def _file_id(status: os.stat_result) -> tuple[int, int]:
    return status.st_dev, status.st_ino
