"""Tells which files on disk hold work of a person that a new text would destroy."""

from collections.abc import Iterable, Iterator

from vicode.findings import Finding, Place, rule
from vicode.output import Difference, Status
from vicode.regions import Region, checksum_of, comment_of, find, is_edited, is_sealed, is_touched, without_bodies

_MEND = "take it over into the design, or generate with --force: the file is then kept as {name}.edited"


def find_hand_edits(differences: Iterable[Difference], *, shown: str = "") -> tuple[Finding, ...]:
    """What would be lost; the arguments are those of `find_edits_by_file`."""
    by_file = find_edits_by_file(differences, shown=shown)
    return tuple(finding for findings in by_file.values() for finding in findings)


def find_edits_by_file(differences: Iterable[Difference], *, shown: str = "") -> dict[str, tuple[Finding, ...]]:
    """What would be lost, by the path of the file; files that lose nothing are not in it.

    Args:
        differences: Files on disk and the texts to replace them.
        shown: How people call the folder that they are in.
    """
    found: dict[str, tuple[Finding, ...]] = {}
    for difference in differences:
        if difference.old is None or difference.status is Status.UNCHANGED:
            continue
        file = f"{shown}/{difference.path}" if shown else difference.path
        findings = tuple(_edits_of(difference.old, difference.new or "", file, comment_of(difference.path)))
        if findings:
            found[difference.path] = findings
    return found


def _edits_of(old: str, new: str, file: str, comment: str) -> Iterator[Finding]:
    if not is_sealed(old):
        yield _edited("this file was not generated, and a generated one is to take its place", file, 1)
        return
    found = find(old, comment, file=file)
    if found.findings:
        yield from found.findings
        return
    fresh = {region.id: region for region in find(new, comment).regions}
    for region in found.regions:
        if is_edited(region) and not _is_taken_over(region, fresh.get(region.id)):
            yield _edited(f"the code of region '{region.id}' was edited here", file, region.line)
    if is_touched(old, comment) and without_bodies(old, comment) != without_bodies(new, comment):
        yield _edited("this file was edited outside its marked regions", file, 1)


def _is_taken_over(region: Region, fresh: Region | None) -> bool:
    """Whether the design has the very code already."""
    return fresh is not None and checksum_of(region.body) == checksum_of(fresh.body)


def _edited(message: str, file: str, line: int) -> Finding:
    mend = _MEND.format(name=file.rsplit("/", 1)[-1])
    return Finding(rule=rule("G501"), message=message, mend=mend, place=Place(file=file, line=line, column=1))
