"""`vicode docs --watch`: builds the site again after every change, and serves it to the browsers of this machine."""

import gc
import os
import sys
import time
import webbrowser
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

from watchfiles import Change, watch

from vicode.cli.opening import BEHAVIORS, DESIGNS
from vicode.cli.printing import describe_os_error, findings_text, print_findings
from vicode.cli.progress import progress
from vicode.cli.sites import Built, Sites, describe
from vicode.cli.subjects import Reading, read_subjects
from vicode.docsite.serving import News, SiteServer

_SUFFIXES = (*BEHAVIORS, *DESIGNS)
# Editors write a file in several steps, and several files at once.
_QUIET_MS, _LONGEST_MS, _LOOK_MS = 40, 400, 500


def watch_sites(paths: Sequence[Path], sites: Sites, *, port: int = 0, opens: bool = True) -> int:
    """Build and serve until it is ended; 2 where files of others stand in the way."""
    news = News()
    with sites:
        watcher = Watcher(paths, sites, news)
        if not watcher.update(is_first=True):
            return 2
        # What is kept from now on need not be looked through for circles again and again.
        gc.freeze()
        with SiteServer(sites.out, news, port) as server:
            print(f"{server.address} shows it, and goes on; Ctrl-C ends it.", flush=True)
            if opens:
                webbrowser.open(server.address)
            with suppress(KeyboardInterrupt):
                watcher.follow()
    return 0


class Watcher:
    """Reads and builds again, and tells what came of it: the last site that could be built stays."""

    def __init__(self, paths: Sequence[Path], sites: Sites, news: News) -> None:
        self._paths, self._sites, self._news = paths, sites, news
        self.folders: tuple[Path, ...] = tuple(path if path.is_dir() else path.resolve().parent for path in paths)

    def follow(self) -> None:
        """Update after every change, until Ctrl-C."""
        while True:
            folders = self.folders
            for _change in changes_in(folders):
                self.update()
                # A behavior may include files of another folder now.
                if folders != self.folders:
                    break

    def update(self, *, is_first: bool = False) -> bool:
        """After a change; whether the folder is ours."""
        begun = time.perf_counter()
        try:
            readings = read_subjects(self._paths)
        except OSError as error:
            return self._stop(describe_os_error(error))
        self.folders = tuple(sorted({*self.folders, *(each for reading in readings for each in reading.folders)}))
        for reading in readings:
            print_findings(reading.unread, to_stderr=True)
        errors = "".join(findings_text(each.unread) for each in readings if each.is_broken)
        if errors and not is_first:
            self._refuse(errors)
            return True
        return self._build(readings, errors, begun, is_first=is_first)

    def _build(self, readings: Sequence[Reading], errors: str, begun: float, *, is_first: bool) -> bool:
        try:
            with progress() as step:
                built = self._sites.build(readings, step)
        except OSError as error:
            if is_first:
                raise
            return self._stop(describe_os_error(error))
        if built.foreign:
            self._stop(f"{built.foreign} is no page of ours; choose another --out")
            return False
        if built.files:
            self._say(built, readings, time.perf_counter() - begun)
        self._news.tell(built.touched, errors)
        return True

    def _stop(self, problem: str) -> bool:
        """What is wrong with the files themselves; the next change may have mended it."""
        print(f"vicode: {problem}", file=sys.stderr, flush=True)
        self._news.tell((), f"error: {problem}\n")
        return True

    def _say(self, built: Built, readings: Sequence[Reading], took_s: float) -> None:
        print(f"{describe(built, readings, self._sites.out)}, {took_s:.2f} s", flush=True)

    def _refuse(self, errors: str) -> None:
        self._news.tell((), errors)
        print("The site stays as it was before this change.", file=sys.stderr, flush=True)


def changes_in(folders: Sequence[Path]) -> Iterator[None]:
    """Comes back each time that a design or a behavior in these folders has changed; ends when a folder is another."""
    with ExitStack() as stack, suppress(FileNotFoundError):
        held = {folder: number for folder in folders if (number := _hold(folder, stack)) is not None}
        wanted = watch(
            *held,
            watch_filter=_is_meant,
            step=_QUIET_MS,
            debounce=_LONGEST_MS,
            rust_timeout=_LOOK_MS,
            yield_on_timeout=True,
        )
        # What changed before the watching began is found by looking once.
        is_first = True
        for changes in wanted:
            if changes or is_first:
                yield
            is_first = is_first and bool(changes)
            # One that was taken away tells nothing any more, nor does the one that is put in its place.
            if held != {folder: number for folder in folders if (number := _number_of(folder)) is not None}:
                return


def _is_meant(_change: Change, path: str) -> bool:
    file = Path(path)
    return file.suffix in _SUFFIXES and not file.name.startswith(".")


def _hold(folder: Path, stack: ExitStack) -> tuple[int, int] | None:
    """The number of a folder, if it is there; as long as it is held open, the one in its place gets another."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        stack.callback(os.close, descriptor)
        return _number_in(os.fstat(descriptor))
    return None


def _number_of(folder: Path) -> tuple[int, int] | None:
    with suppress(OSError):
        return _number_in(folder.stat())
    return None


def _number_in(status: os.stat_result) -> tuple[int, int]:
    return status.st_dev, status.st_ino
