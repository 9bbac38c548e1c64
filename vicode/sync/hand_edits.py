"""Finds edits in generated files that generation would overwrite."""

from collections.abc import Iterable, Iterator

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.output import FileDiff, FileStatus
from vicode.regions import (
    Region,
    compute_checksum,
    find_regions,
    get_comment_prefix,
    has_header,
    is_edited,
    is_edited_outside_regions,
    strip_bodies,
)

_FIX = "copy the edit into the design, or generate with --force, which keeps the file as {name}.edited"


def find_hand_edits(differences: Iterable[FileDiff], *, display_folder: str = "") -> tuple[Finding, ...]:
    """Find all edits; for the arguments see `find_hand_edits_by_file`."""
    by_file = find_hand_edits_by_file(differences, display_folder=display_folder)
    return tuple(finding for findings in by_file.values() for finding in findings)


def find_hand_edits_by_file(
    differences: Iterable[FileDiff], *, display_folder: str = ""
) -> dict[str, tuple[Finding, ...]]:
    """Find all edits by the path of the file; files without edits are left out.

    Args:
        differences: Files on disk and their new texts.
        display_folder: The folder of the files as findings show it.
    """
    edits: dict[str, tuple[Finding, ...]] = {}
    for difference in differences:
        if difference.old is None or difference.status is FileStatus.UNCHANGED:
            continue
        file = f"{display_folder}/{difference.path}" if display_folder else difference.path
        findings = tuple(_find_edits(difference.old, difference.new or "", file, get_comment_prefix(difference.path)))
        if findings:
            edits[difference.path] = findings
    return edits


def _find_edits(old: str, new: str, file: str, comment: str) -> Iterator[Finding]:
    if not has_header(old):
        yield _edit_finding("this file was not generated; generation would replace it", file, 1)
        return
    parsed = find_regions(old, comment, file=file)
    if parsed.findings:
        yield from parsed.findings
        return
    new_regions = {region.id: region for region in find_regions(new, comment).regions}
    for region in parsed.regions:
        if is_edited(region) and not _is_in_design(region, new_regions.get(region.id)):
            yield _edit_finding(f"the code of region '{region.id}' was edited here", file, region.line)
    if is_edited_outside_regions(old, comment) and strip_bodies(old, comment) != strip_bodies(new, comment):
        yield _edit_finding("this file was edited outside its regions", file, 1)


def _is_in_design(region: Region, new_region: Region | None) -> bool:
    """Whether the design already contains the edited code."""
    return new_region is not None and compute_checksum(region.body) == compute_checksum(new_region.body)


def _edit_finding(message: str, file: str, line: int) -> Finding:
    fix = _FIX.format(name=file.rsplit("/", 1)[-1])
    location = SourceLocation(file=file, line=line, column=1)
    return Finding(rule=get_rule("G501"), message=message, fix=fix, location=location)
