"""`vicode docs --watch`: rebuilds the site after every change and serves it on this machine."""

import gc
import sys
import time
import webbrowser
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from vicode.cli.console import describe_os_error, format_findings, print_findings
from vicode.cli.progress import progress_bar
from vicode.docsite.site_server import ReloadBroadcaster, SiteServer
from vicode.services.docs.builder import DocsBuilder, DocsBuildResult, describe_build
from vicode.services.docs.inputs import LoadedSiteInput, load_site_inputs
from vicode.services.file_changes import iter_changes


def watch_docs(
    paths: Sequence[Path], builder: DocsBuilder, *, encoding: str = "", port: int = 0, open_browser: bool = True
) -> int:
    """Build and serve until interrupted; return 2 if files of other tools are in the output folder."""
    news = ReloadBroadcaster()
    with builder:
        watcher = SiteWatcher(paths, builder, news, encoding)
        if not watcher.update(is_first=True):
            return 2
        # Exclude long-lived objects from garbage collection.
        gc.freeze()
        with SiteServer(builder.out, news, port) as server:
            print(f"Serving {server.url}; press Ctrl-C to stop.", flush=True)
            if open_browser:
                webbrowser.open(server.url)
            with suppress(KeyboardInterrupt):
                watcher.run()
    return 0


class SiteWatcher:
    """Rebuilds after changes and publishes the result; on errors, the last good site is kept."""

    def __init__(self, paths: Sequence[Path], sites: DocsBuilder, news: ReloadBroadcaster, encoding: str = "") -> None:
        self._paths, self._builder, self._broadcaster, self._encoding = paths, sites, news, encoding
        self.folders: tuple[Path, ...] = tuple(path if path.is_dir() else path.resolve().parent for path in paths)

    def run(self) -> None:
        while True:
            folders = self.folders
            for _change in iter_changes(folders):
                self.update()
                # The change may have added an include from another folder.
                if folders != self.folders:
                    break

    def update(self, *, is_first: bool = False) -> bool:
        """Rebuild; return False if the output folder contains files of other tools."""
        begun = time.perf_counter()
        try:
            readings = load_site_inputs(self._paths, self._encoding)
        except OSError as error:
            return self._report_problem(describe_os_error(error))
        self.folders = tuple(sorted({*self.folders, *(each for reading in readings for each in reading.folders)}))
        for reading in readings:
            print_findings(reading.read_errors, to_stderr=True, encoding=reading.encoding)
        errors = "".join(format_findings(each.read_errors, each.encoding) for each in readings if each.is_incomplete)
        if errors and not is_first:
            self._report_errors(errors)
            return True
        return self._build(readings, errors, begun, is_first=is_first)

    def _build(self, readings: Sequence[LoadedSiteInput], errors: str, begun: float, *, is_first: bool) -> bool:
        try:
            with progress_bar() as step:
                built = self._builder.build(readings, step)
        except OSError as error:
            if is_first:
                raise
            return self._report_problem(describe_os_error(error))
        if built.foreign:
            self._report_problem(f"{built.foreign} was not written by vicode docs; choose another --out")
            return False
        if built.files:
            self._report_build(built, readings, time.perf_counter() - begun)
        self._broadcaster.publish(built.changed, errors)
        return True

    def _report_problem(self, problem: str) -> bool:
        """Report an OS error; the next change may fix it."""
        print(f"vicode: {problem}", file=sys.stderr, flush=True)
        self._broadcaster.publish((), f"error: {problem}\n")
        return True

    def _report_build(self, built: DocsBuildResult, readings: Sequence[LoadedSiteInput], took_s: float) -> None:
        print(f"{describe_build(built, readings, self._builder.out)}, {took_s:.2f} s", flush=True)

    def _report_errors(self, errors: str) -> None:
        self._broadcaster.publish((), errors)
        print("The site was not updated.", file=sys.stderr, flush=True)
