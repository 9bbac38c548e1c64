"""Tells which files on disk hold work of a person that a new text would destroy."""

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

_FIX = "take it over into the design, or generate with --force: the file is then kept as {name}.edited"


def find_hand_edits(differences: Iterable[FileDiff], *, display_folder: str = "") -> tuple[Finding, ...]:
    """What would be lost; the arguments are those of `find_hand_edits_by_file`."""
    by_file = find_hand_edits_by_file(differences, display_folder=display_folder)
    return tuple(finding for findings in by_file.values() for finding in findings)


def find_hand_edits_by_file(
    differences: Iterable[FileDiff], *, display_folder: str = ""
) -> dict[str, tuple[Finding, ...]]:
    """What would be lost, by the path of the file; files that lose nothing are not in it.

    Args:
        differences: Files on disk and the texts to replace them.
        shown: How people call the folder that they are in.
    """
    found: dict[str, tuple[Finding, ...]] = {}
    for difference in differences:
        if difference.old is None or difference.status is FileStatus.UNCHANGED:
            continue
        file = f"{display_folder}/{difference.path}" if display_folder else difference.path
        findings = tuple(_find_edits(difference.old, difference.new or "", file, get_comment_prefix(difference.path)))
        if findings:
            found[difference.path] = findings
    return found


def _find_edits(old: str, new: str, file: str, comment: str) -> Iterator[Finding]:
    if not has_header(old):
        yield _edit_finding("this file was not generated, and a generated one is to take its place", file, 1)
        return
    found = find_regions(old, comment, file=file)
    if found.findings:
        yield from found.findings
        return
    fresh = {region.id: region for region in find_regions(new, comment).regions}
    for region in found.regions:
        if is_edited(region) and not _is_in_design(region, fresh.get(region.id)):
            yield _edit_finding(f"the code of region '{region.id}' was edited here", file, region.line)
    if is_edited_outside_regions(old, comment) and strip_bodies(old, comment) != strip_bodies(new, comment):
        yield _edit_finding("this file was edited outside its marked regions", file, 1)


def _is_in_design(region: Region, fresh: Region | None) -> bool:
    """Whether the design has the very code already."""
    return fresh is not None and compute_checksum(region.body) == compute_checksum(fresh.body)


def _edit_finding(message: str, file: str, line: int) -> Finding:
    mend = _FIX.format(name=file.rsplit("/", 1)[-1])
    return Finding(
        rule=get_rule("G501"), message=message, fix=mend, location=SourceLocation(file=file, line=line, column=1)
    )
