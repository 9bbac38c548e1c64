"""Builds the sites of `vicode docs`: a single one, or several with a common home page."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from vicode.docsite import (
    Manifest,
    PlannedFile,
    SiteBuilder,
    StoredResults,
    load_manifest,
    manifest_path,
    plan_site_index,
    results_path,
    save_manifest,
    tool_digest,
    write_site,
)
from vicode.findings import count_findings
from vicode.services.docs.build_record import BuildRecord, digest_files, digest_inputs
from vicode.services.docs.inputs import LoadedSiteInput

ProgressCallback = Callable[[str, int, int], None]
"""Called with the name of the site, the number of finished files, and the total."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DocsBuildResult:
    """The result of a build: all files and the changed ones, relative to the output folder.

    `foreign` is an existing file that vicode did not write, "" if there is none; nothing is written then.
    """

    files: tuple[str, ...] = ()
    changed: tuple[str, ...] = ()
    foreign: str = ""


@dataclass(slots=True)
class DocsBuilder:
    """Builds the sites of an output folder. Call `close` when done.

    With `ignores_cache`, the first build renders all pages. `title` is that of the site or of the common home page.
    `source_url` is the address of lines in a repository, with {path} and {line}.
    """

    out: Path
    ignores_cache: bool = False
    is_markdown: bool = False
    title: str = ""
    source_url: str = ""
    _builders: dict[str, "SiteBuilder"] = field(default_factory=dict)

    def build(
        self, readings: Sequence[LoadedSiteInput], step: ProgressCallback = lambda _name, _done, _all: None
    ) -> DocsBuildResult:
        """Build the sites of all readable inputs and delete stale pages."""
        named = {name: each for name, each in _assign_folders(readings).items() if each.site_input is not None}
        plans: dict[str, tuple[PlannedFile, ...]] = {}
        for name, reading in named.items():
            step(reading.name, 0, 0)
            builder = self._builder(name)
            assert reading.site_input is not None
            title = reading.site_input.title if name else self.title or reading.site_input.title
            subject = replace(reading.site_input, title=title, source_url=reading.source_url(self.source_url))
            plans[name] = builder.plan(subject, is_markdown=self.is_markdown)
        if len(readings) > 1:
            subjects = {name: each.site_input for name, each in named.items() if each.site_input}
            plans[""] = plan_site_index(subjects, title=self.title, is_markdown=self.is_markdown)
        built = DocsBuildResult()
        for name, plan in plans.items():
            title = named[name].name if name in named else self.out.name
            built = _merge_results(built, self._write(name, plan, partial(step, title)))
            if built.foreign:
                return built
            if name in self._builders:
                self._builders[name].save_results()
        self.ignores_cache = False
        return built

    def close(self) -> None:
        for builder in self._builders.values():
            builder.close()

    def __enter__(self) -> "DocsBuilder":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def _builder(self, name: str) -> SiteBuilder:
        if name not in self._builders:
            stored = StoredResults(results_path(self.out / name), tool_digest(), is_ignored=self.ignores_cache)
            self._builders[name] = SiteBuilder(stored)
        return self._builders[name]

    def _write(self, name: str, plan: Sequence[PlannedFile], step: Callable[[int, int], None]) -> DocsBuildResult:

        out = self.out / name
        kept = manifest_path(out)
        written = write_site(plan, out, Manifest() if self.ignores_cache else load_manifest(kept), step)
        if written.foreign:
            return DocsBuildResult(foreign=(out / written.foreign[0]).as_posix())
        if written.changed or not kept.is_file():
            save_manifest(written.manifest, kept)
        before = f"{name}/" if name else ""
        return DocsBuildResult(
            files=tuple(before + each.path for each in plan), changed=tuple(before + each for each in written.changed)
        )


def _assign_folders(readings: Sequence[LoadedSiteInput]) -> Mapping[str, LoadedSiteInput]:
    """Assign a unique folder, ignoring case, to each input; a single input is built in the output folder itself."""
    if len(readings) == 1:
        return {"": readings[0]}
    named: dict[str, LoadedSiteInput] = {}
    taken: set[str] = set()
    for each in readings:
        name, number = each.name, 1
        while name.casefold() in taken:
            number += 1
            name = f"{each.name}-{number}"
        taken.add(name.casefold())
        named[name] = each
    return named


def _merge_results(one: DocsBuildResult, other: DocsBuildResult) -> DocsBuildResult:
    return DocsBuildResult(files=one.files + other.files, changed=one.changed + other.changed, foreign=other.foreign)


def record_build(
    built: DocsBuildResult,
    readings: Sequence[LoadedSiteInput],
    *,
    options: Sequence[str],
    paths: Sequence[Path],
    out: Path,
    started_s: float,
) -> BuildRecord | None:
    """The record of a build without errors; None if an input has changed since the build was started."""
    if any(reading.is_incomplete or reading.read_errors for reading in readings):
        return None
    folders = {folder for reading in readings for folder in reading.folders}
    sites = {file.rpartition("/")[0] for file in built.files}
    unchanged = replace(built, changed=())
    try:
        return BuildRecord(
            inputs=digest_inputs(options, paths, folders, out, newest_s=started_s),
            files=digest_files(out, sites),
            folders=tuple(sorted(map(str, folders))),
            sites=tuple(sorted(sites)),
            summary=describe_build(unchanged, readings, out),
            has_findings=any(reading.site_input.findings for reading in readings if reading.site_input),
        )
    except OSError:
        return None


def describe_build(built: DocsBuildResult, readings: Sequence[LoadedSiteInput], out: Path) -> str:
    findings = [each.finding for reading in readings if reading.site_input for each in reading.site_input.findings]
    counts = f"{len(built.files)} files, {len(built.changed)} changed, {count_findings(findings)}"
    home = "index.md" if "index.md" in built.files else "index.html"
    return f"wrote {(out / home).as_posix()}: {counts}"
